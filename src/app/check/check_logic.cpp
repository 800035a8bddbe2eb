#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "app/check/checks.hpp"
#include "app/check/count_text.hpp"
#include "app/check/estimate.hpp"
#include "app/load_case.hpp"
#include "config/geometry.hpp"
#include "problem/overlaps.hpp"
#include "problem/shape.hpp"
#include "state/body.hpp"

namespace recoil::app {

namespace {

using config::Body;
using config::Case;
using config::Gauge;

/// Cells across the thinnest part that a body needs before its waves keep their plateau: with 20 a flyer
/// leaves 5 % too slowly, with 4 a third.
constexpr double cells_needed = 20;

/// The same for shapes whose thickness is only sampled, of their thinnest part: a wedge has a thin end on
/// purpose.
constexpr double least_cells = 4;

/// Thinner rigid bodies that lie askew let matter past: in some cells no node lies between their two sides. A
/// band of 1.2 cells at slope 1/6 bears all of its contact, one of 0.9 cells 90 %, one of 0.5 cells half.
constexpr double rigid_cells_needed = 1.2;

void check_rigid_thickness(LoadedCase& loaded, const Body& body, double t) {
  if (along_mesh(body.shape) || t >= rigid_cells_needed * loaded.contents.mesh.finest) return;
  loaded.found.warning(
      body.shape.place,
      fmt::format(
          "rigid body '{}' is {:.3g} cells thick: surfaces that lie askew to the mesh then bear only part of "
          "the contact, and matter can leak past; about {:.1f} cells are needed",
          body.name, t / loaded.contents.mesh.finest, rigid_cells_needed),
      fmt::format("make it thicker, or finest = \"{:.3g} mm\"", t / rigid_cells_needed * 1e3));
}

void check_thickness(LoadedCase& loaded) {
  const Case& c = loaded.contents;
  for (const Body& body : c.bodies) {
    if (body.takes_up_fragments()) continue;
    const bool plain = thickness(body.shape, c.domain) < 1e300;
    const double t = plain || body.rigid ? thickness(body.shape, c.domain) : least_thickness(body.shape, c);
    const double needed = plain ? cells_needed : least_cells;
    if (body.rigid) check_rigid_thickness(loaded, body, t);
    if (body.rigid || t > (needed - 1e-6) * c.mesh.finest || t < 0.999 * c.mesh.finest) continue;
    const double cure = rounded_down(t / needed, 3);  // so that it is enough
    const double cost = std::pow(c.mesh.finest / cure, 1 + config::dimension(c.domain.geometry));
    loaded.found.warning(body.shape.place,
                         fmt::format("'{}' is {:.3g} cells thick; about {:.0f} are needed", body.name,
                                     t / c.mesh.finest, needed),
                         fmt::format("finest = \"{:.3g} mm\" gives {:.0f}, for {} times the time", cure * 1e3,
                                     needed, count_text(cost, 2)));
  }
}

/// A gauge of a kind that says where it must be: on the surface of its body, or inside.
template <int Dim, class Kind>
void check_place(const Gauge& g, const Kind& kind, LoadedCase& loaded) {
  const Case& c = loaded.contents;
  const auto body =
      std::find_if(c.bodies.begin(), c.bodies.end(), [&](const Body& b) { return b.name == kind.body; });
  if (body == c.bodies.end()) return;
  if (body->takes_up_fragments())
    return loaded.found.error(
        g.place, fmt::format("gauge '{}' measures '{}', which begins empty", g.name, kind.body),
        fmt::format("measure '{}': its gauges count its fragments", body->fragments_of));
  const auto distance = signed_distance<Dim>(body->shape, c.domain);
  const Vec<Dim> at = config::first_components<Dim>(kind.at);
  const double away = distance(at);
  if (Kind::on_surface && std::abs(away) > c.mesh.finest)
    loaded.found.error(g.place,
                       fmt::format("gauge '{}' is not on the surface of '{}' but {:.4g} mm {} it", g.name,
                                   kind.body, std::abs(away) * 1e3, away > 0 ? "outside" : "below"),
                       "move `at` onto the surface; for a place inside use kind = \"point\"");
  if (!Kind::on_surface && away > 0)
    loaded.found.warning(
        g.place,
        fmt::format("gauge '{}' lies {:.4g} mm outside of '{}' at the start", g.name, away * 1e3, kind.body),
        "it records nothing until the body comes there");
  if constexpr (requires { kind.direction; }) {  // which leads out of the body
    const Vec<Dim> step = 2 * c.mesh.finest * config::first_components<Dim>(kind.direction);
    if (!(distance(at + step) > distance(at - step)))
      loaded.found.error(place_of(loaded, "gauge." + g.name + ".direction", g.place),
                         fmt::format("the direction of gauge '{}' leads into '{}'", g.name, kind.body),
                         "turn it round: it leads out of the surface");
  }
}

/// A rigid body has a place and a velocity, but no state of matter.
void check_is_matter(const Gauge& g, const std::string& name, LoadedCase& loaded) {
  for (const Body& body : loaded.contents.bodies)
    if (body.name == name && body.rigid)
      loaded.found.error(place_of(loaded, "gauge." + g.name + ".body", g.place),
                         fmt::format("gauge '{}' measures matter, but '{}' is a rigid body", g.name, name),
                         "kind = \"body\" has its place and velocity, kind = \"contact\" the forces on it");
}

template <int Dim>
void check_gauges(LoadedCase& loaded) {
  for (const Gauge& g : loaded.contents.gauges)
    std::visit(
        [&]<class Kind>(const Kind& kind) {
          if constexpr (requires { kind.body; } && !std::is_same_v<Kind, config::BodyGauge>)
            check_is_matter(g, kind.body, loaded);
          if constexpr (requires { kind.on_surface; }) check_place<Dim>(g, kind, loaded);
        },
        g.kind);
}

/// A body of which no cell's middle lies inside would not be there.
void check_places(LoadedCase& loaded) {
  const Case& c = loaded.contents;
  const std::vector<double> cells = cells_of_bodies(c);
  for (std::size_t m = 0; m < c.bodies.size(); ++m) {
    const Body& body = c.bodies[m];
    if (body.takes_up_fragments()) continue;
    const double t = least_thickness(body.shape, c);
    if (!body.rigid && t < 0.999 * c.mesh.finest)
      loaded.found.error(body.shape.place,
                         fmt::format("'{}' is thinner than a cell: {:.3g} mm, {:.2g} cells", body.name,
                                     t * 1e3, t / c.mesh.finest),
                         fmt::format("finest = \"{:.3g} mm\" gives {:.0f} cells, the least that makes sense",
                                     t / least_cells * 1e3, least_cells));
    else if (cells[m] == 0)
      loaded.found.error(body.shape.place, fmt::format("nothing of '{}' lies in the domain", body.name),
                         "move it, make the domain larger, or use smaller cells");
  }
}

}  // namespace

config::Place place_of(const LoadedCase& loaded, const std::string& dotted, const config::Place& otherwise) {
  const config::Node* node = loaded.document.find(dotted);
  return node ? node->place : otherwise;
}

void check_logic(LoadedCase& loaded) {
  const Case& c = loaded.contents;
  if (c.bodies.size() > most_bodies)
    return loaded.found.error(c.bodies[most_bodies].place,
                              fmt::format("{} bodies, at most {} are possible", c.bodies.size(), most_bodies),
                              "bodies that never meet may be one: kind = \"union\" or \"lattice\"");
  check_size(loaded);
  if (loaded.too_large) return;  // all that follows looks at its cells
  if (loaded.found.has_errors()) return;
  check_steps(loaded);
  check_levels(loaded);
  check_output(loaded);
  find_overlaps(c, loaded.found);
  check_places(loaded);
  check_thickness(loaded);
  check_edges(loaded);
  switch (config::dimension(c.domain.geometry)) {
    case 1:
      check_gauges<1>(loaded);
      break;
    case 2:
      check_gauges<2>(loaded);
      break;
    default:
      check_gauges<3>(loaded);
  }
  check_velocity_fields(loaded);
  check_loads(loaded);
  check_materials(loaded);
  check_gases(loaded);
  if (!loaded.found.has_errors()) check_motion(loaded);  // shocks in matter that exists
  if (!loaded.found.has_errors()) check_tension(loaded);
}

}  // namespace recoil::app
