#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/approach.hpp"
#include "app/check/checks.hpp"
#include "config/geometry.hpp"
#include "config/shape/slabs.hpp"
#include "core/error.hpp"
#include "material/eos/isentrope.hpp"
#include "material/hugoniot.hpp"

namespace recoil::app {

namespace {

using config::Body;
using config::Case;

bool moves(const Body& b, const Case& c) {
  return std::ranges::find(c.loads, b.name, &config::Load::body) != c.loads.end() ||
         b.velocity != config::Vector{} || b.spin != config::Vector{} || b.radial_velocity != 0 ||
         b.velocity_field.is_given() || !b.velocity_history.empty() || !b.detonation.points.empty() ||
         b.pressure.value_or(0) != 0;
}

double distance_of(const Body& b, const config::Vector& x, const config::Domain& domain) {
  switch (config::dimension(domain.geometry)) {
    case 1:
      return config::distance_to(b.shape, config::first_components<1>(x), domain);
    case 2:
      return config::distance_to(b.shape, config::first_components<2>(x), domain);
    default:
      return config::distance_to(b.shape, config::first_components<3>(x), domain);
  }
}

double speed_of(const Body& b) { return std::hypot(b.velocity[0], b.velocity[1], b.velocity[2]); }

/// Where the velocity of the faster one of two bodies stands.
config::Place place_of_velocity(const LoadedCase& loaded, const Approach& p) {
  const Body &a = loaded.contents.bodies[p.first], &b = loaded.contents.bodies[p.second];
  const Body& faster = speed_of(a) >= speed_of(b) ? a : b;
  return place_of(loaded, "body." + faster.name + ".velocity", faster.place);
}

/// Whether the impact state of two bodies exists at this closing velocity.
bool reachable(const Body& a, const Body& b, const Material& first, const Material& second, double closing) {
  try {
    if (a.rigid || b.rigid)
      shock_at_velocity(a.rigid ? second : first, closing);
    else
      match_impact(first, second, closing);
    return true;
  } catch (const PhysicsError&) {
    return false;
  }
}

void check_speed(LoadedCase& loaded, const Approach& p) {
  const Body &a = loaded.contents.bodies[p.first], &b = loaded.contents.bodies[p.second];
  const Material &first = loaded.materials[p.first], &second = loaded.materials[p.second];
  if ((a.rigid && b.rigid) || reachable(a, b, first, second, p.closing)) return;
  double lo = 0, hi = p.closing;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (lo + hi);
    (reachable(a, b, first, second, middle) ? lo : hi) = middle;
  }
  std::string ends;
  for (const auto& [body, material] : {std::pair(&a, &first), std::pair(&b, &second)})
    if (!body->rigid)
      ends += fmt::format("{}that of '{}' ends at a particle velocity of {:.3g} km/s",
                          ends.empty() ? "" : ", ", body->material, largest_velocity(*material) * 1e-3);
  loaded.found.error(
      place_of_velocity(loaded, p),
      fmt::format("'{}' and '{}' meet at {:.4g} km/s: beyond the range of the equation of state ({})", a.name,
                  b.name, p.closing * 1e-3, ends),
      fmt::format("at most about {:.3g} km/s; is the unit right?", lo * 1e-3));
}

/// There is no contact between rigid bodies.
void check_rigid_pair(LoadedCase& loaded, const Approach& p) {
  const Body &a = loaded.contents.bodies[p.first], &b = loaded.contents.bodies[p.second];
  if (!a.rigid || !b.rigid) return;
  loaded.found.warning(
      place_of_velocity(loaded, p),
      fmt::format("the rigid bodies '{}' and '{}' meet at {:.4g} us: they will pass through each other",
                  a.name, b.name, p.time * 1e6),
      "only bodies with a material push others: give one of them a material, or end the run before");
}

/// Whether one of the bodies moves towards an edge that it may come back from, or come in again.
bool may_come_back(const config::Domain& domain, const Body& a, const Body& b) {
  const auto only_goes_along = [](const Body& body, int axis) {
    return body.velocity[axis] == 0 && body.spin == config::Vector{} && body.radial_velocity == 0 &&
           !body.velocity_field.is_given() && body.velocity_history.empty();
  };
  for (int d = 0; d < config::dimension(domain.geometry); ++d)
    for (const config::Boundary end : domain.boundary[d])
      if (end != config::Boundary::outflow && !(only_goes_along(a, d) && only_goes_along(b, d))) return true;
  return false;
}

void check_parting(LoadedCase& loaded, const std::vector<Approach>& all) {
  const Case& c = loaded.contents;
  const auto meets = [&](int body) {
    return std::any_of(all.begin(), all.end(), [&](const Approach& p) {
      return p.meeting == Meeting::close && (p.first == body || p.second == body);
    });
  };
  for (const Approach& p : all) {
    if (p.meeting != Meeting::part || meets(p.first) || meets(p.second)) continue;
    const Body &a = c.bodies[p.first], &b = c.bodies[p.second];
    if (may_come_back(c.domain, a, b)) continue;
    if (c.contact.between(a.name, b.name).mode == config::ContactChoice::Mode::bonded) continue;
    loaded.found.warning(place_of_velocity(loaded, p),
                         fmt::format("'{}' and '{}' fly apart from the start", a.name, b.name),
                         "turn the velocity round if they shall meet");
  }
}

/// Whether a body has matter in the cells at the axis, or in the one at the centre.
bool reaches_axis(const Body& b, const Case& c) {
  const double dx = c.mesh.finest;
  if (!config::has_radius(c.domain.geometry) || c.domain.lo[0] > 0) return false;
  if (c.domain.geometry == config::Geometry::spherical) return distance_of(b, {0.5 * dx, 0, 0}, c.domain) < 0;
  const auto rows = static_cast<int>(std::ceil((c.domain.hi[1] - c.domain.lo[1]) / dx - 0.5));
  for (int j = 0; j < rows; ++j)
    if (distance_of(b, {0.5 * dx, c.domain.lo[1] + (j + 0.5) * dx, 0}, c.domain) < 0) return true;
  return false;
}

/// Along r matter at the axis has nowhere to come from or go to.
void check_axis(LoadedCase& loaded) {
  for (const Body& b : loaded.contents.bodies)
    if (!b.rigid && !b.takes_up_fragments() && b.velocity[0] != 0 && reaches_axis(b, loaded.contents))
      loaded.found.warning(
          place_of(loaded, "body." + b.name + ".velocity", b.place),
          fmt::format("'{}' reaches the {}, where matter cannot move along r: its velocity {} it", b.name,
                      config::dimension(loaded.contents.domain.geometry) == 1 ? "centre" : "axis",
                      b.velocity[0] > 0 ? "tears a hole into" : "presses together"),
          "velocity-field = { r = \"100*m/s * r/(4*mm)\" } grows from 0");
}

/// Points that light nothing, or only after the end of the run.
void check_lighting(LoadedCase& loaded, const Body& b) {
  const Case& c = loaded.contents;
  const config::Place place = place_of(loaded, "body." + b.name + ".detonation", b.place);
  if (b.detonation.time >= c.time.end)
    loaded.found.warning(place,
                         fmt::format("'{}' is lit at {:.4g} us, but the run ends at {:.4g} us", b.name,
                                     b.detonation.time * 1e6, c.time.end * 1e6),
                         "light it earlier, or let time.end be later");
  for (const config::Vector& point : b.detonation.points) {
    const double away = distance_of(b, point, c.domain);
    if (away > c.mesh.finest)
      loaded.found.warning(place,
                           fmt::format("'{}' is lit at a point {:.4g} mm outside of it", b.name, away * 1e3),
                           "the front runs from there all the same, and arrives accordingly later; move the "
                           "point if it shall not");
  }
}

/// Only explosives detonate, and only the conservative scheme knows how, moves a body by its history, or
/// parts fragments.
void check_drives(LoadedCase& loaded) {
  const Case& c = loaded.contents;
  for (std::size_t m = 0; m < c.bodies.size(); ++m) {
    const Body& b = c.bodies[m];
    const std::string path = "body." + b.name;
    const bool lit = !b.detonation.points.empty(),
               explosive = std::holds_alternative<Jwl>(loaded.materials[m].eos);
    if (lit && !explosive)
      loaded.found.error(place_of(loaded, path + ".detonation", b.place),
                         fmt::format("'{}' is lit, but {} is no explosive", b.name,
                                     b.rigid ? "a rigid body" : fmt::format("'{}'", b.material)),
                         "explosives have an equation of state of kind \"jwl\": `recoil material list`");
    if (!lit && explosive && !b.rigid)
      loaded.found.warning(b.place,
                           fmt::format("'{}' is an explosive that nothing lights: it stays cold", b.name),
                           fmt::format("e.g. detonation = {{ points = [{{ {} = \"0 mm\" }}] }} in [{}]",
                                       config::axes_of(c.domain.geometry).front(), path));
    if (lit && explosive) check_lighting(loaded, b);
    if (b.takes_up_fragments() && !b.rigid && is_gas(loaded.materials[m].eos))
      loaded.found.error(b.fragments_place,
                         fmt::format("'{}' is a gas, which leaves no fragments", b.fragments_of),
                         "take out this body");
    for (const auto& [key, given] :
         {std::pair("detonation", lit), std::pair("velocity-history", !b.velocity_history.empty()),
          std::pair("fragments-of", b.takes_up_fragments())})
      if (given && c.method.scheme != "conservative")
        loaded.found.error(place_of(loaded, path + "." + key, b.place),
                           fmt::format("'{}' needs method.scheme = \"conservative\"", key),
                           "remove method.scheme");
  }
}

}  // namespace

void check_motion(LoadedCase& loaded) {
  check_drives(loaded);
  const Case& c = loaded.contents;
  if (std::all_of(c.bodies.begin(), c.bodies.end(), [](const Body& b) { return b.rigid; })) {
    loaded.found.error(
        c.bodies.front().place, "all bodies are rigid: there is no matter to compute",
        fmt::format("give one of them a material, e.g. material = \"copper/ofhc-johnson-cook\" "
                    "in place of rigid = true in [body.{}]",
                    c.bodies.front().name));
    return;
  }
  if (std::ranges::none_of(c.bodies, [&c](const Body& b) { return moves(b, c); })) {
    loaded.found.error(
        c.bodies.front().place,
        "nothing moves: no body has a velocity, a spin, a radial-velocity, a velocity-field, a pressure, a "
        "detonation or a load",
        fmt::format("e.g. velocity = {{ {} = \"450 m/s\" }} in [body.{}]",
                    config::axes_of(c.domain.geometry).back(), c.bodies.front().name));
    return;
  }
  const std::vector<Approach> all = find_approaches(c);
  for (const Approach& p : first_meetings(all))
    if (p.time < c.time.end) check_speed(loaded, p), check_rigid_pair(loaded, p);
  check_parting(loaded, all);
  check_axis(loaded);
}

}  // namespace recoil::app
