#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "config/case.hpp"

namespace recoil::app {

/// A gauge at its place, or one end of its line.
struct GaugePlace {
  std::string name;
  config::Vector at{};  // m
};

/// Of the gauges that have a place; those of whole bodies have none.
std::vector<GaugePlace> gauge_places(const config::Case& c);

/// How a body moves at the start, for a picture.
struct StartMotion {
  std::size_t body = 0;
  config::Vector velocity{};  // m/s
  std::string label;          // "450 m/s, 2000 rad/s"
};

/// Of the bodies that move.
std::vector<StartMotion> start_motions(const config::Case& c);

/// One of the arrows that show how a body moves at the start.
struct StartArrow {
  config::Vector at{}, velocity{};  // m, m/s
  std::string label;
};

/// Whether the velocity of a body needs more arrows than one.
bool has_velocity_field(const config::Case& c, const StartMotion& motion);

/// Arrows by the whole velocity of a body at the start, formulas included, at those places [m] where it is
/// not slow beside the others. The fastest has the label, with its speed.
std::vector<StartArrow> field_arrows(const config::Case& c, const StartMotion& motion,
                                     const std::vector<config::Vector>& places);

/// Some points (i, j) of those of a picture of nx * ny that lie inside of something, in rows and columns;
/// about seven along its longer side.
std::vector<std::array<int, 2>> spread_inside(int nx, int ny, const std::function<bool(int, int)>& inside);

}  // namespace recoil::app
