#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "app/check/checks.hpp"
#include "app/check/sampled_cells.hpp"
#include "core/error.hpp"
#include "problem/loads.hpp"
#include "problem/shape.hpp"
#include "problem/start.hpp"

namespace recoil::app {

namespace {

constexpr int most_places = 200, instants = 100;  // that are asked

/// Places near the surface of a body at the start, spread over all of it.
template <int Dim>
std::vector<Vec<Dim>> surface_places(const config::Case& c, const config::Body& body) {
  const Grid<Dim> grid = make_grid<Dim>(c);
  const auto distance = signed_distance<Dim>(body.shape, c.domain);
  std::vector<Vec<Dim>> all;
  for_each_sampled_cell(grid, [&](const Vec<Dim>& x, double width) {
    if (std::abs(distance(x)) <= 0.5000001 * width) all.push_back(x);  // also of a surface on a face
  });
  const std::size_t apart = std::max<std::size_t>(1, all.size() / most_places);
  std::vector<Vec<Dim>> some;
  for (std::size_t k = 0; k < all.size(); k += apart) some.push_back(all[k]);
  return some;
}

/// The largest pressure of a load, whatever its sign, on its body at the start [Pa].
/// @throws PhysicsError where it is not finite.
template <int Dim>
double largest_pressure(const config::Case& c, std::size_t load, const config::Body& body) {
  const SurfaceLoad<Dim> acting = surface_loads<Dim>(c)[load];
  double largest = 0;
  for (const Vec<Dim>& x : surface_places<Dim>(c, body))
    for (int n = 0; n < instants; ++n)
      largest = std::max(
          largest, std::abs(acting.pressure(x, c.time.end * n / instants, c.time.end * (n + 1) / instants)));
  return largest;
}

double largest_pressure_in_any(const config::Case& c, std::size_t load, const config::Body& body) {
  switch (config::dimension(c.domain.geometry)) {
    case 1:
      return largest_pressure<1>(c, load, body);
    case 2:
      return largest_pressure<2>(c, load, body);
    default:
      return largest_pressure<3>(c, load, body);
  }
}

}  // namespace

void check_loads(LoadedCase& loaded) {
  const config::Case& c = loaded.contents;
  for (std::size_t n = 0; n < c.loads.size(); ++n) {
    const config::Load& load = c.loads[n];
    if (c.method.scheme != "conservative")
      loaded.found.error(load.place, "a load needs method.scheme = \"conservative\"", "remove method.scheme");
    const auto body = std::ranges::find(c.bodies, load.body, &config::Body::name);
    if (body == c.bodies.end() || body->takes_up_fragments()) continue;  // which begins empty
    try {
      if (largest_pressure_in_any(c, n, *body) == 0)
        loaded.found.warning(load.place,
                             fmt::format("the load '{}' is zero on all of '{}' until the end of the run",
                                         load.name, load.body),
                             "compare its places with those of the shape, and its times with time.end");
    } catch (const PhysicsError& e) {
      loaded.found.error(load.place, e.what(),
                         fmt::format("e.g. write {} > 0*mm ? ... : 0*GPa, or t > 0*us ? ... : 0*GPa",
                                     config::axes_of(c.domain.geometry).front()));
    }
  }
}

}  // namespace recoil::app
