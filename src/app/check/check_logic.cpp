#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "app/check/estimate.hpp"
#include "app/load_case.hpp"
#include "config/geometry.hpp"
#include "material/lint.hpp"
#include "problem/shape.hpp"
#include "problem/start.hpp"

namespace recoil::app {

namespace {

using config::Body;
using config::Case;
using config::Gauge;

/// Cells across the thinnest part that a body needs before its waves keep their plateau: with 20 a flyer
/// leaves 5 % too slowly, with 4 a third.
constexpr double cells_needed = 20;

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
    const double t = thickness(body.shape, c.domain);
    if (body.rigid) check_rigid_thickness(loaded, body, t);
    if (body.rigid || t > (cells_needed - 1e-6) * c.mesh.finest) continue;
    const double cure = t / cells_needed;
    const double cost = std::pow(c.mesh.finest / cure, 1 + config::dimension(c.domain.geometry));
    loaded.found.warning(body.shape.place,
                         fmt::format("'{}' is {:.3g} cells thick; about {:.0f} are needed", body.name,
                                     t / c.mesh.finest, cells_needed),
                         fmt::format("finest = \"{:.3g} mm\" gives {:.0f}, for {:.2g} times the time",
                                     cure * 1e3, cells_needed, cost));
  }
}

/// A gauge of a kind that says where it must be: on the surface of its body, or inside.
template <int Dim, class Kind>
void check_place(const Gauge& g, const Kind& kind, LoadedCase& loaded) {
  const Case& c = loaded.contents;
  const auto body =
      std::find_if(c.bodies.begin(), c.bodies.end(), [&](const Body& b) { return b.name == kind.body; });
  if (body == c.bodies.end()) return;
  const double away = signed_distance<Dim>(body->shape, c.domain)(config::first_components<Dim>(kind.at));
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
}

template <int Dim>
void check_gauges(LoadedCase& loaded) {
  for (const Gauge& g : loaded.contents.gauges)
    std::visit(
        [&](const auto& kind) {
          if constexpr (requires { kind.on_surface; }) check_place<Dim>(g, kind, loaded);
        },
        g.kind);
}

void check_places(LoadedCase& loaded) {
  const Case& c = loaded.contents;
  const std::vector<double> cells = cells_of_bodies(c);
  for (std::size_t m = 0; m < c.bodies.size(); ++m)
    if (cells[m] == 0)
      loaded.found.error(c.bodies[m].shape.place,
                         fmt::format("nothing of '{}' lies in the domain", c.bodies[m].name),
                         "move it, make the domain larger, or use smaller cells");
}

void check_materials(LoadedCase& loaded) {
  std::set<std::string> seen;
  for (std::size_t m = 0; m < loaded.materials.size(); ++m) {
    const Body& body = loaded.contents.bodies[m];
    if (body.rigid || !seen.insert(body.material).second) continue;
    for (const Suspicion& s : lint(loaded.materials[m]))
      loaded.found.warning(body.material_place, fmt::format("material '{}': {}", body.material, s.message),
                           s.help);
  }
}

}  // namespace

void check_logic(LoadedCase& loaded) {
  const Case& c = loaded.contents;
  find_overlaps(c, loaded.found);
  check_places(loaded);
  check_thickness(loaded);
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
  check_materials(loaded);
}

}  // namespace recoil::app
