#pragma once

#include <string>
#include <vector>

#include "config/declare/common_keys.hpp"

namespace recoil::config {

struct PointGauge {
  std::string body;
  Vector at{};       // m
  double every = 0;  // s; 0: every step

  static constexpr const char* kind = "point";
  static constexpr const char* doc =
      "The state of a body in the cell that holds a point; NaN where the body is not there.";
  static constexpr bool on_surface = false;  // `at` must lie inside
  static Entries<PointGauge> keys() {
    return {body_key("body", &PointGauge::body, watched_body),
            place_key("at", &PointGauge::at, "where it is; it does not move"),
            every_key(&PointGauge::every, every_record)};
  }
  static std::vector<Column> columns() {
    using enum Column::Each;
    return {{"pressure", "GPa", "positive in compression"},
            {"velocity", "m/s", "of the matter", axis},
            {"stress", "GPa", "components, positive in tension", stress},
            {"density", "kg/m3", "of the matter"},
            {"von-mises", "GPa", "equivalent stress"},
            {"plastic-strain", "1", "equivalent"},
            {"temperature", "K", "of the matter"}};
  }
};

}  // namespace recoil::config
