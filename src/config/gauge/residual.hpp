#pragma once

#include <string>
#include <vector>

#include "config/declare/common_keys.hpp"

namespace recoil::config {

struct ResidualGauge {
  std::string body;
  Vector at{};         // m, on the plane
  Vector direction{};  // unit vector, to the side that counts
  double every = 0;    // s; 0: every step

  static constexpr const char* kind = "residual";
  static constexpr const char* doc =
      "The part of a body that has passed a plane: what is left of a projectile behind a plate, debris, what "
      "ricochets.";
  static Entries<ResidualGauge> keys() {
    return {body_key("body", &ResidualGauge::body, watched_body),
            place_key("at", &ResidualGauge::at, "a point of the plane"),
            {.name = "direction",
             .member = &ResidualGauge::direction,
             .required = true,
             .rule = Rule::direction,
             .doc = "normal to the plane, to the side that counts",
             .example = "{ x = 1 }"},
            every_key(&ResidualGauge::every, every_record)};
  }
  static std::vector<Column> columns() {
    using enum Column::Each;
    return {{"velocity", "m/s", "mean by mass; NaN while nothing has passed", axis},
            {"speed", "m/s", "of that mean; in axisymmetric along z"},
            {"mass", "mass", "of cells whose middle lies beyond the plane"},
            {"kinetic", "energy", "of them"},
            {"angle", "deg",
             "between the mean velocity and `direction`: of a ricochet 90 deg less its exit angle"}};
  }
};

}  // namespace recoil::config
