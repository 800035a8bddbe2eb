#include "app/check/case_marks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "problem/starting_velocity.hpp"

namespace recoil::app {

namespace {

double size_of(const config::Vector& v) { return std::hypot(v[0], v[1], v[2]); }

/// Of contact gauges only those of a part of the contact.
bool has_place(const config::Gauge& g) {
  const auto* contact = std::get_if<config::ContactGauge>(&g.kind);
  return contact == nullptr || contact->radius > 0;
}

/// Velocity of a body at the start at a place.
template <int Dim>
std::function<config::Vector(const config::Vector&)> velocity_of(const config::Case& c,
                                                                 const config::Body& body) {
  return [u = starting_velocity<Dim>(body, c.domain, c.mesh.finest)](const config::Vector& x) {
    const Vec<Dim> here = u(config::first_components<Dim>(x));
    config::Vector velocity{};
    for (int d = 0; d < Dim; ++d) velocity[static_cast<std::size_t>(d)] = here[d];
    return velocity;
  };
}

std::function<config::Vector(const config::Vector&)> velocity_in_any(const config::Case& c,
                                                                     const config::Body& body) {
  switch (config::dimension(c.domain.geometry)) {
    case 1:
      return velocity_of<1>(c, body);
    case 2:
      return velocity_of<2>(c, body);
    default:
      return velocity_of<3>(c, body);
  }
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

bool has_velocity_field(const config::Case& c, const StartMotion& motion) {
  return c.bodies[motion.body].velocity_field.is_given();
}

std::vector<StartArrow> field_arrows(const config::Case& c, const StartMotion& motion,
                                     const std::vector<config::Vector>& places) {
  constexpr double slow = 0.1;  // of the fastest: such an arrow is as short as its head
  const auto velocity = velocity_in_any(c, c.bodies[motion.body]);
  std::vector<StartArrow> arrows;
  for (const config::Vector& x : places) arrows.push_back({x, velocity(x), ""});
  if (arrows.empty()) return arrows;
  const auto fastest =
      std::ranges::max_element(arrows, {}, [](const StartArrow& a) { return size_of(a.velocity); });
  const double speed = size_of(fastest->velocity);
  fastest->label = fmt::format("{}: {:.4g} m/s here", motion.label, speed);
  std::erase_if(arrows,
                [&](const StartArrow& a) { return a.label.empty() && size_of(a.velocity) < slow * speed; });
  return arrows;
}

std::vector<std::array<int, 2>> spread_inside(int nx, int ny, const std::function<bool(int, int)>& inside) {
  constexpr int along = 7;
  std::vector<std::array<int, 2>> all;
  std::array<int, 2> lo{nx, ny}, hi{-1, -1};
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      if (inside(i, j)) {
        all.push_back({i, j});
        lo = {std::min(lo[0], i), std::min(lo[1], j)}, hi = {std::max(hi[0], i), std::max(hi[1], j)};
      }
  const std::array<int, 2> size{hi[0] - lo[0] + 1, hi[1] - lo[1] + 1};
  const int stride = std::max(1, std::max(size[0], size[1]) / along);
  const auto left_out = [&](const std::array<int, 2>& p) {
    for (std::size_t d = 0; d < 2; ++d) {
      const int step = std::min(stride, size[d]);  // rows and columns lie in the middle of the size
      if ((p[d] - lo[d] - (size[d] % step) / 2) % step != step / 2) return true;
    }
    return false;
  };
  std::erase_if(all, left_out);
  return all;
}

}  // namespace recoil::app
