#pragma once

#include <string>
#include <vector>

#include "config/declare/common_keys.hpp"

namespace recoil::config {

struct SurfaceVelocityGauge {
  std::string body;
  Vector at{};       // m
  double every = 0;  // s; 0: every step

  static constexpr const char* kind = "surface-velocity";
  static constexpr const char* doc =
      "The velocity of a point of a surface; the point moves along the normal of the surface. Velocities are "
      "means over steps: a record is of the middle of its step, the last one of the end of the run.";
  static constexpr bool on_surface = true;  // where `at` must lie at the start
  static Entries<SurfaceVelocityGauge> keys() {
    return {body_key("body", &SurfaceVelocityGauge::body, watched_body),
            place_key("at", &SurfaceVelocityGauge::at, "the point of the surface at the start"),
            every_key(&SurfaceVelocityGauge::every, every_record)};
  }
  static std::vector<Column> columns() {
    using enum Column::Each;
    return {{"velocity", "m/s", "along the outward normal"},
            {"velocity", "m/s", "of the surface", axis},
            {"position", "mm", "of the point", axis}};
  }
};

}  // namespace recoil::config
