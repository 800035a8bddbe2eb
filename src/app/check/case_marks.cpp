#include "app/check/case_marks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <variant>

namespace recoil::app {

namespace {

double size_of(const config::Vector& v) { return std::hypot(v[0], v[1], v[2]); }

/// Of contact gauges only those of a part of the contact.
bool has_place(const config::Gauge& g) {
  const auto* contact = std::get_if<config::ContactGauge>(&g.kind);
  return contact == nullptr || contact->radius > 0;
}

}  // namespace

std::vector<GaugePlace> gauge_places(const config::Case& c) {
  std::vector<GaugePlace> places;
  for (const config::Gauge& g : c.gauges)
    std::visit(
        [&](const auto& kind) {
          if constexpr (requires { kind.at; })
            if (has_place(g)) places.push_back({g.name, kind.at});
          if constexpr (requires { kind.to; }) places.push_back({g.name + ", end", kind.to});
        },
        g.kind);
  return places;
}

std::vector<StartMotion> start_motions(const config::Case& c) {
  std::vector<StartMotion> motions;
  for (std::size_t m = 0; m < c.bodies.size(); ++m) {
    const config::Body& body = c.bodies[m];
    const bool driven = !body.velocity_history.empty();
    const config::Vector velocity = driven ? body.velocity_history.front().velocity : body.velocity;
    std::vector<std::string> parts;
    if (const double speed = size_of(velocity); speed > 0) parts.push_back(fmt::format("{:.4g} m/s", speed));
    if (driven) parts.emplace_back("driven");
    if (const double spin = size_of(body.spin); spin > 0) parts.push_back(fmt::format("{:.4g} rad/s", spin));
    if (body.radial_velocity != 0)
      parts.push_back(fmt::format("{:.4g} m/s {}", std::abs(body.radial_velocity),
                                  body.radial_velocity > 0 ? "outwards" : "inwards"));
    if (body.velocity_field.is_given()) parts.emplace_back("by formulas");
    if (!parts.empty()) motions.push_back({m, velocity, fmt::format("{}", fmt::join(parts, ", "))});
  }
  return motions;
}

}  // namespace recoil::app
