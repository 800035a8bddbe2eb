#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/check/checks.hpp"
#include "core/error.hpp"
#include "problem/shape.hpp"
#include "problem/start.hpp"
#include "problem/starting_velocity.hpp"

namespace recoil::app {

namespace {

constexpr double most_asked = 1e5;  // cells

/// Asks for the velocity in cells of the body, as the start of a run does. @returns the largest speed.
template <int Dim>
double fastest(const config::Case& c, const config::Body& body) {
  const Grid<Dim> grid = make_grid<Dim>(c);
  const auto distance = signed_distance<Dim>(body.shape, c.domain);
  const auto velocity = starting_velocity<Dim>(body, c.domain, grid.dx);
  double total = 1;
  for (int d = 0; d < Dim; ++d) total *= grid.cells[d];
  const int stride = static_cast<int>(std::max(1.0, std::ceil(std::pow(total / most_asked, 1.0 / Dim))));
  double speed = 0;
  Box<Dim> places;
  for (int d = 0; d < Dim; ++d) places.hi[d] = (grid.cells[d] + stride - 1) / stride;
  for_each(places, [&](const Index<Dim>& i) {
    Index<Dim> cell;
    for (int d = 0; d < Dim; ++d) cell[d] = std::min(i[d] * stride + stride / 2, grid.cells[d] - 1);
    if (const Vec<Dim> x = grid.centre(cell); distance(x) < 0.5 * grid.dx)
      speed = std::max(speed, norm(velocity(x)));
  });
  return speed;
}

/// The largest speed that the formulas of a body give it. @throws InputError where they have no finite value.
double fastest_of_field(const config::Case& c, config::Body body) {
  body.velocity = body.spin = {};
  body.radial_velocity = 0;
  switch (config::dimension(c.domain.geometry)) {
    case 1:
      return fastest<1>(c, body);
    case 2:
      return fastest<2>(c, body);
    default:
      return fastest<3>(c, body);
  }
}

}  // namespace

void check_velocity_fields(LoadedCase& loaded) {
  const config::Case& c = loaded.contents;
  for (const config::Body& body : c.bodies) {
    if (!body.velocity_field.is_given()) continue;
    const config::Place place = place_of(loaded, "body." + body.name + ".velocity-field", body.place);
    try {
      if (fastest_of_field(c, body) == 0)
        loaded.found.warning(place,
                             fmt::format("the velocity-field of '{}' is zero in the whole body", body.name),
                             "compare the places in its formulas with those of the shape");
    } catch (const InputError& e) {
      const std::string said = e.what();
      loaded.found.error(
          place, said.substr(said.find("the velocity-field")),
          fmt::format("e.g. write {} > 0 ? ... : 0*m/s", config::axes_of(c.domain.geometry).back()));
    }
  }
}

}  // namespace recoil::app
