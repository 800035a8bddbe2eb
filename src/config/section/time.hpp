#pragma once

#include <optional>

#include "config/declare/entry.hpp"

namespace recoil::config {

struct TimeChoice {
  double end = 0;                  // s
  double cfl = 0.9;                //
  std::optional<double> fixed_dt;  // s

  static constexpr const char* doc = "How long, and in which steps.";
  static Entries<TimeChoice> keys() {
    return {{.name = "end",
             .member = &TimeChoice::end,
             .unit = "s",
             .positive = true,
             .required = true,
             .doc = "time at which the run ends; it starts at 0",
             .example = R"("10 us")"},
            {.name = "cfl",
             .member = &TimeChoice::cfl,
             .most = 1,
             .positive = true,
             .doc = "length of a step as a fraction of the largest stable one",
             .example = "0.9",
             .when = [](const TimeChoice& t) { return !t.fixed_dt.has_value(); }},
            {.name = "fixed-dt",
             .member = &TimeChoice::fixed_dt,
             .unit = "s",
             .positive = true,
             .doc = "the same step all the time, instead of cfl",
             .example = R"("1 ns")"}};
  }
  void check(const TableReading& reading) const;
};

}  // namespace recoil::config
