#pragma once

#include <string>
#include <vector>

#include "config/declare/common_keys.hpp"

namespace recoil::config {

struct BodyGauge {
  std::string body;
  double every = 0;  // s; 0: every step

  static constexpr const char* kind = "body";
  static constexpr const char* doc = "Sums over a whole body.";
  static Entries<BodyGauge> keys() {
    return {body_key("body", &BodyGauge::body, watched_body), every_key(&BodyGauge::every, every_record)};
  }
  static std::vector<Column> columns() {
    using enum Column::Each;
    return {{"velocity", "m/s", "mean by mass", axis},
            {"position", "mm", "of the centre of mass", axis},
            {"lowest", "mm", "end of its extent", axis},
            {"highest", "mm", "the other end", axis},
            {"mass", "mass", "of the body"},
            {"kinetic", "energy", "kinetic energy"},
            {"internal", "energy", "internal energy"},
            {"plastic-strain", "1", "largest"},
            {"failed-mass", "mass", "of matter that has failed"}};
  }
};

}  // namespace recoil::config
