#pragma once

#include <string>
#include <vector>

#include "config/declare/common_keys.hpp"

namespace recoil::config {

struct PullbackGauge {
  std::string body;
  Vector at{};       // m
  double every = 0;  // s; 0: every step

  static constexpr const char* kind = "pullback";
  static constexpr const char* doc =
      "What velocimetry of a free surface tells of a spall. The pull-back is the fall of the surface "
      "velocity "
      "from its peak to the minimum behind it, known once the record has risen again by a tenth of the fall; "
      "with the density rho0 and the bulk sound speed c0 of the body's material at rest, the spall strength "
      "is rho0 c0 pullback/2 and the strain rate that of the unloading, over 2 c0 (Antoun et al., Spall "
      "Fracture, Springer 2003, ch. 4).";
  static constexpr bool on_surface = true;  // where `at` must lie at the start
  static Entries<PullbackGauge> keys() {
    return {body_key("body", &PullbackGauge::body, watched_body),
            place_key("at", &PullbackGauge::at, "the point of the surface at the start"),
            every_key(&PullbackGauge::every, every_record)};
  }
  static std::vector<Column> columns() {
    return {{"pullback", "m/s", "fall of the velocity; NaN until the record has risen again"},
            {"spall-strength", "GPa", "rho0 c0 pullback/2"},
            {"strain-rate", "1/s", "slope between 0.1 and 0.9 of the fall, over 2 c0"},
            {"peak-velocity", "m/s", "largest so far"},
            {"peak-time", "us", "of it"},
            {"minimum-velocity", "m/s", "lowest behind the peak"},
            {"minimum-time", "us", "of it"},
            {"scab-thickness", "mm", "from the surface, along its normal, to the first failed cell"},
            {"ringing-thickness", "mm", "c_L/2 times the period between the next two maxima"}};
  }
};

}  // namespace recoil::config
