#include "gauge/contact_fields.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "gauge/level_set_slope.hpp"

namespace recoil {

namespace {

constexpr double least_slip = 1e-5;  // of the bulk speed of sound
constexpr double opposed = -0.7;     // cosine between normals of surfaces that face each other

/// Traction and state of the surface of body m in a cell, from the contacts there.
template <int Dim>
void look_up(const State<Dim>& state, int slot, int m, int cell, SurfaceContact& found) {
  const double limit = least_slip * bulk_sound_speed(state.bodies[m].material);
  for (const Contact<Dim>& c : state.contacts[slot]) {
    if (c.cell != cell || !(c.first == m || (c.second == m && !c.one_sided))) continue;
    found.traction = c.traction;
    if (norm(c.slip) > limit)
      found.state = ContactState::slipping;
    else if (found.state == ContactState::free)
      found.state = ContactState::touching;
  }
}

}  // namespace

template <int Dim>
std::vector<std::uint32_t> have_touched(const State<Dim>& state, const parallel::World& world) {
  const int n = state.count();
  std::vector<std::int64_t> met(static_cast<std::size_t>(n * (n - 1) / 2));
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    const auto& pairs = state.ledger[slot].pairs;
    for (std::size_t p = 0; p < pairs.size(); ++p) met[p] += pairs[p].exchanged.is_zero() ? 0 : 1;
  }
  world.sum(met);
  std::vector<std::uint32_t> touched(static_cast<std::size_t>(n));
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) {
      if (met[pair_number(a, b, n)] == 0) continue;
      touched[a] |= 1U << b;
      touched[b] |= 1U << a;
    }
  return touched;
}

template <int Dim>
SurfaceContact surface_contact(const State<Dim>& state, int slot, int m, int cell, std::uint32_t touched) {
  SurfaceContact c;
  const Body<Dim>& body = state.bodies[m];
  const BodyBlock<Dim>& b = body.at(slot);
  const double dx = state.grid().dx;
  look_up(state, slot, m, cell, c);
  const Index<Dim> i = state.mesh.block(slot).cells.lo + state.grid().layout().index(cell);
  Index<Dim> beyond = i;
  for (int d = 0; d < Dim; ++d) ++beyond[d];
  const Window<Dim> window(state.mesh, slot, 1, Box<Dim>{i, beyond});
  const Vec<Dim> n = level_set_slope(window, body, i, dx, far_cells * dx);
  double nearest = far_cells * dx;
  for (int q = 0; q < state.count(); ++q) {
    const Body<Dim>& other = state.bodies[q];
    if (q == m || !other.present(slot)) continue;
    const double there = other.at(slot).phi[cell];
    if (!(there < far_cells * dx)) continue;
    nearest = std::min(nearest, there);
    const Vec<Dim> k = level_set_slope(window, other, i, dx, far_cells * dx);
    const bool facing = dot(n, k) < opposed * norm(n) * norm(k);
    if (c.state == ContactState::free && facing && (touched >> q & 1U) != 0) c.state = ContactState::opened;
  }
  c.gap = nearest < far_cells * dx ? b.phi[cell] + nearest : std::numeric_limits<double>::quiet_NaN();
  return c;
}

#define RECOIL_INSTANTIATE(Dim)                                                                     \
  template std::vector<std::uint32_t> have_touched<Dim>(const State<Dim>&, const parallel::World&); \
  template SurfaceContact surface_contact<Dim>(const State<Dim>&, int, int, int, std::uint32_t);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
