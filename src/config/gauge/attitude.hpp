#pragma once

#include <string>
#include <vector>

#include "config/declare/common_keys.hpp"

namespace recoil::config {

struct AttitudeGauge {
  std::string body;
  double every = 0;  // s; 0: every step

  static constexpr const char* kind = "attitude";
  static constexpr const char* doc = "Where a body points, and how it turns, in the plane of x and y.";
  static std::vector<Geometry> only_in() { return {Geometry::planar, Geometry::space}; }
  static Entries<AttitudeGauge> keys() {
    return {body_key("body", &AttitudeGauge::body, watched_body),
            every_key(&AttitudeGauge::every, every_record)};
  }
  static std::vector<Column> columns() {
    return {{"inclination", "deg", "of the axis of the whole body, from the x axis"},
            {"inclination.front-half", "deg", "of the axis of the matter ahead of the centre of mass"},
            {"inclination.front-third", "deg", "of the axis of the foremost third"},
            {"course", "deg", "direction of the velocity of the centre of mass"},
            {"speed", "m/s", "of the centre of mass"},
            {"head.x", "m/s", "mean velocity of the foremost third"},
            {"head.y", "m/s", "mean velocity of the foremost third"},
            {"spin", "rad/s", "angular momentum over moment of inertia"}};
  }
};

}  // namespace recoil::config
