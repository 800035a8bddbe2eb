#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <variant>
#include <vector>

#include "app/check/checks.hpp"
#include "problem/shape.hpp"
#include "problem/start.hpp"

namespace recoil::app {

namespace {

constexpr double most_cells = 1e6;
constexpr double same_pressure = 1e-6;

const IdealGas* gas_of(const LoadedCase& loaded, std::size_t m) {
  return loaded.contents.bodies[m].rigid ? nullptr : std::get_if<IdealGas>(&loaded.materials[m].eos);
}

/// Whether body m ends somewhere where nothing else begins.
template <int Dim>
bool is_free_somewhere(const config::Case& c, std::size_t m) {
  const Grid<Dim> grid = make_grid<Dim>(c);
  std::vector<std::function<double(const Vec<Dim>&)>> distance;
  for (const config::Body& body : c.bodies) distance.push_back(signed_distance<Dim>(body.shape, c.domain));
  double total = 1;
  for (int d = 0; d < Dim; ++d) total *= grid.cells[d];
  const int stride = static_cast<int>(std::max(1.0, std::ceil(std::pow(total / most_cells, 1.0 / Dim))));
  Box<Dim> points;
  for (int d = 0; d < Dim; ++d) points.hi[d] = (grid.cells[d] + stride - 1) / stride;
  bool found = false;
  for_each(points, [&](const Index<Dim>& i) {
    if (found) return;
    Index<Dim> at;
    for (int d = 0; d < Dim; ++d) at[d] = i[d] * stride + stride / 2;
    const Vec<Dim> x = grid.centre(at);
    const double away = distance[m](x);
    if (!(away > 0.5 * grid.dx && away < (0.5 + stride) * grid.dx)) return;
    for (const auto& other : distance)
      if (other(x) < 0.5 * grid.dx && &other != &distance[m]) return;
    found = true;
  });
  return found;
}

/// Pressures of gases are measured from that at rest: gases that rest at different ones have no common zero.
void check_pressures(LoadedCase& loaded) {
  const IdealGas* first = nullptr;
  for (std::size_t m = 0; m < loaded.materials.size(); ++m) {
    const IdealGas* gas = gas_of(loaded, m);
    if (!gas) continue;
    if (!first) first = gas;
    if (std::fabs(gas->p0 - first->p0) > same_pressure * first->p0)
      loaded.found.error(
          loaded.contents.bodies[m].material_place,
          fmt::format("gases at rest at {:.6g} Pa and at {:.6g} Pa in one case", first->p0, gas->p0),
          "their pressures are measured from that at rest, which must be the same");
  }
}

bool has_free_surface(const config::Case& c, std::size_t m) {
  switch (config::dimension(c.domain.geometry)) {
    case 1:
      return is_free_somewhere<1>(c, m);
    case 2:
      return is_free_somewhere<2>(c, m);
    default:
      return is_free_somewhere<3>(c, m);
  }
}

}  // namespace

void check_gases(LoadedCase& loaded) {
  check_pressures(loaded);
  const config::Case& c = loaded.contents;
  for (std::size_t m = 0; m < loaded.materials.size(); ++m) {
    const IdealGas* gas = gas_of(loaded, m);
    if (!gas || gas->p_inf > 0) continue;
    if (has_free_surface(c, m))
      loaded.found.warning(
          c.bodies[m].shape.place, fmt::format("the gas '{}' has a free surface", c.bodies[m].name),
          fmt::format(
              "empty space presses on it with the {:.4g} kPa of its rest, as still air would; for a gas "
              "that must not part with its neighbours let bodies or the domain enclose it",
              gas->p0 * 1e-3));
  }
}

}  // namespace recoil::app
