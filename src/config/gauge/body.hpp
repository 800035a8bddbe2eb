#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "config/declare/common_keys.hpp"
#include "config/declare/reading.hpp"

namespace recoil::config {

struct BodyGauge {
  std::string body;
  double every = 0;    // s; 0: every step
  bool rigid = false;  // whether the body is

  static constexpr const char* kind = "body";
  static constexpr const char* doc =
      "Sums over a whole body. One that moves as prescribed has no mass: what needs one is NaN.";
  static Entries<BodyGauge> keys() {
    return {body_key("body", &BodyGauge::body, watched_body), every_key(&BodyGauge::every, every_record)};
  }
  void check(const TableReading& reading) {
    rigid = std::ranges::find(reading.in.rigid_bodies, body) != reading.in.rigid_bodies.end();
  }
  /// How many of the last columns are not written.
  std::size_t switched_off() const { return rigid ? 0 : 1; }
  static std::vector<Column> columns() {
    using enum Column::Each;
    return {{"velocity", "m/s", "mean by mass; of a rigid body that of its `position`", axis},
            {"position", "mm", "of the centre of mass; without a mass, of the centroid at the start", axis},
            {"lowest", "mm", "end of its extent", axis},
            {"highest", "mm", "the other end", axis},
            {"mass", "mass", "of the body"},
            {"kinetic", "energy", "kinetic energy"},
            {"internal", "energy", "internal energy"},
            {"plastic-strain", "1", "largest"},
            {"failed-mass", "mass", "of matter that has failed"},
            {"spin", "rad/s", "of a rigid body (planar, 3d)", turn}};
  }
};

}  // namespace recoil::config
