#pragma once

#include <array>
#include <string_view>

#include "config/diagnostics.hpp"
#include "config/gauge/gauge.hpp"
#include "config/section/expect.hpp"

namespace recoil::config {

/// What makes one number of a column of a record: "gauge.NAME.COLUMN.reduction@argument"
/// (record/quantities.cpp). Where none is named but there is an argument it is "at".
struct Reduction {
  std::string_view name;
  bool keeps_unit;  // of the column
};
inline constexpr std::array<Reduction, 12> reductions{{{"at", true},
                                                       {"peak", true},
                                                       {"last", true},
                                                       {"max", true},
                                                       {"min", true},
                                                       {"mean", true},
                                                       {"rms", true},
                                                       {"error", true},
                                                       {"pullback", true},
                                                       {"slope", false},
                                                       {"arrival", false},
                                                       {"until", false}}};
/// Null: there is none of that name.
constexpr const Reduction* find_reduction(std::string_view name) {
  for (const Reduction& r : reductions)
    if (r.name == name) return &r;
  return nullptr;
}

/// Reports an expectation of a gauge that names a column which the gauge does not have, no value of it, or
/// compares it with a value of another dimension: before the run, not at its end.
void check_expected_column(const Expectation& expected, const Gauge& gauge, Diagnostics& out);

}  // namespace recoil::config
