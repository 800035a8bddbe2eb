#pragma once

#include <cstddef>
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

}  // namespace recoil::app
