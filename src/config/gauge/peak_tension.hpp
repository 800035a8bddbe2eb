#pragma once

#include <string>
#include <vector>

#include "config/declare/common_keys.hpp"

namespace recoil::config {

struct PeakTensionGauge {
  std::string body;
  double every = 0;  // s; 0: every step

  static constexpr const char* kind = "peak-tension";
  static constexpr const char* doc =
      "The largest tension that a body has borne so far, in cells that hold at least 0.3 of it; it looks at "
      "all "
      "of them in every step.";
  static Entries<PeakTensionGauge> keys() {
    return {body_key("body", &PeakTensionGauge::body, watched_body),
            every_key(&PeakTensionGauge::every, every_record)};
  }
  static std::vector<Column> columns() {
    using enum Column::Each;
    return {{"stress", "GPa", "largest principal stress so far, positive in tension"},
            {"time", "us", "of it"},
            {"position", "mm", "of the middle of its cell", axis},
            {"pressure", "GPa", "lowest so far, negative in tension"},
            {"pressure-time", "us", "of it"},
            {"pressure-position", "mm", "of the middle of its cell", axis}};
  }
};

}  // namespace recoil::config
