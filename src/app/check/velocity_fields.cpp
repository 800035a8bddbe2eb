#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/check/checks.hpp"
#include "app/check/sampled_cells.hpp"
#include "core/error.hpp"
#include "problem/shape.hpp"
#include "problem/start.hpp"
#include "problem/starting_velocity.hpp"

namespace recoil::app {

namespace {

/// Asks for the velocity in cells of the body, as the start of a run does. @returns the largest speed.
template <int Dim>
double fastest(const config::Case& c, const config::Body& body) {
  const Grid<Dim> grid = make_grid<Dim>(c);
  const auto distance = signed_distance<Dim>(body.shape, c.domain);
  const auto velocity = starting_velocity<Dim>(body, c.domain, grid.dx);
  double speed = 0;
  for_each_sampled_cell(grid, [&](const Vec<Dim>& x, double) {
    if (distance(x) < 0.5 * grid.dx) speed = std::max(speed, norm(velocity(x)));
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
