#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "config/declare/common_keys.hpp"

namespace recoil::config {

struct PointGauge {
  std::string body;
  Vector at{};           // m
  double every = 0;      // s; 0: every step
  bool follows = false;  // the matter

  static constexpr const char* kind = "point";
  static constexpr const char* doc =
      "The state of a body at a point, linear between the centres of its cells, one-sided at a surface; NaN "
      "where the body is not.";
  static constexpr bool on_surface = false;  // `at` must lie inside
  static Entries<PointGauge> keys() {
    return {body_key("body", &PointGauge::body, watched_body),
            place_key("at", &PointGauge::at, "where it is, or at the start was"),
            {.name = "follows",
             .member = &PointGauge::follows,
             .doc = "the point moves with the matter; else it stays",
             .example = "true"},
            every_key(&PointGauge::every, every_record)};
  }
  /// How many of the last columns are not written.
  std::size_t switched_off() const { return follows ? 0 : 1; }
  static std::vector<Column> columns() {
    using enum Column::Each;
    return {{"pressure", "GPa", "positive in compression"},
            {"velocity", "m/s", "of the matter", axis},
            {"stress", "GPa", "components, positive in tension", stress},
            {"density", "kg/m3", "of the matter"},
            {"von-mises", "GPa", "equivalent stress"},
            {"plastic-strain", "1", "equivalent"},
            {"temperature", "K", "of the matter"},
            {"molten", "1", "part that is molten"},
            {"position", "mm", "of a point that follows the matter", axis}};
  }
};

}  // namespace recoil::config
