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

/// Asks for the velocity in cells of the body, as the start of a run does.
template <int Dim>
void ask(const config::Case& c, const config::Body& body) {
  const Grid<Dim> grid = make_grid<Dim>(c);
  const auto distance = signed_distance<Dim>(body.shape, c.domain);
  const auto velocity = starting_velocity<Dim>(body, c.domain, grid.dx);
  double total = 1;
  for (int d = 0; d < Dim; ++d) total *= grid.cells[d];
  const int stride = static_cast<int>(std::max(1.0, std::ceil(std::pow(total / most_asked, 1.0 / Dim))));
  Box<Dim> places;
  for (int d = 0; d < Dim; ++d) places.hi[d] = (grid.cells[d] + stride - 1) / stride;
  for_each(places, [&](const Index<Dim>& i) {
    Index<Dim> cell;
    for (int d = 0; d < Dim; ++d) cell[d] = std::min(i[d] * stride + stride / 2, grid.cells[d] - 1);
    if (const Vec<Dim> x = grid.centre(cell); distance(x) < 0.5 * grid.dx) velocity(x);
  });
}

}  // namespace

void check_velocity_fields(LoadedCase& loaded) {
  const config::Case& c = loaded.contents;
  for (const config::Body& body : c.bodies) {
    if (!body.velocity_field.is_given()) continue;
    try {
      switch (config::dimension(c.domain.geometry)) {
        case 1:
          ask<1>(c, body);
          break;
        case 2:
          ask<2>(c, body);
          break;
        default:
          ask<3>(c, body);
      }
    } catch (const InputError& e) {
      const std::string said = e.what();
      loaded.found.error(place_of(loaded, "body." + body.name + ".velocity-field", body.place),
                         said.substr(said.find("the velocity-field")), "e.g. write x > 0 ? ... : 0*m/s");
    }
  }
}

}  // namespace recoil::app
