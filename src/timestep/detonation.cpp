#include "timestep/detonation.hpp"

#include <algorithm>
#include <cstddef>

namespace recoil {

template <int Dim>
ExactSum detonate(const State<Dim>& state, Body<Dim>& body, int slot, double now) {
  using C = Components<Dim>;
  const DetonationFront<Dim>& front = *body.detonation;
  const Grid<Dim>& grid = state.grid(slot);
  BodyBlock<Dim>& b = body.at(slot);
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = grid.layout();
  const std::size_t n = b.volume.size();
  ExactSum released;
  for_each(b.reach, [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
    const double mass = b.contents[C::rho * n + k];
    double& burnt = b.contents[C::ep * n + k];
    if (!(mass > 0) || burnt >= mass) return;
    const double passed = (now - front.arrival(grid.centre(i))) * front.velocity / (front_cells * grid.dx);
    const double fresh = mass * std::clamp(0.5 + passed, 0.0, 1.0) - burnt;
    if (!(fresh > 0)) return;
    burnt += fresh;
    b.contents[C::energy * n + k] += front.energy * fresh;
    released += front.energy * fresh;
  });
  return released;
}

template ExactSum detonate<1>(const State<1>&, Body<1>&, int, double);
template ExactSum detonate<2>(const State<2>&, Body<2>&, int, double);
template ExactSum detonate<3>(const State<3>&, Body<3>&, int, double);

}  // namespace recoil
