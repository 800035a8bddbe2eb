#pragma once

#include <string>
#include <vector>

#include "config/declare/common_keys.hpp"

namespace recoil::config {

struct FragmentsGauge {
  std::string body;
  double smaller_than = 0;  // m; 0: two cells of the finest level
  double every = 0;         // s; 0: every step

  static constexpr const char* kind = "fragments";
  static constexpr const char* doc =
      "The pieces into which a body has broken. Every record looks at all cells: `every` should not be 0 in "
      "a "
      "long run.";
  static Entries<FragmentsGauge> keys() {
    return {body_key("body", &FragmentsGauge::body, watched_body),
            {.name = "smaller-than",
             .member = &FragmentsGauge::smaller_than,
             .unit = "m",
             .positive = true,
             .optional = true,
             .doc = "pieces with a smaller equivalent diameter are counted apart; without it two cells",
             .example = R"("0.5 mm")"},
            every_key(&FragmentsGauge::every, every_record)};
  }
  static std::vector<Column> columns() {
    using enum Column::Each;
    return {{"count", "1", "pieces at least as large as `smaller-than`"},
            {"largest-mass", "mass", "of the heaviest piece"},
            {"largest-velocity", "m/s", "of the heaviest piece", axis},
            {"small-count", "1", "smaller pieces"},
            {"small-mass", "mass", "of the smaller pieces"},
            {"rubble-mass", "mass", "of failed matter with voids that belongs to no piece"}};
  }
};

}  // namespace recoil::config
