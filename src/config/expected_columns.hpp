#pragma once

#include <array>
#include <string>
#include <string_view>

#include "config/diagnostics.hpp"
#include "config/gauge/gauge.hpp"
#include "config/section/expect.hpp"

namespace recoil::config {

/// What makes one number of a column of a record: "gauge.NAME.COLUMN.reduction@argument"
/// (record/quantities.cpp). Where none is named but there is an argument it is "at".
inline constexpr std::array<std::string_view, 12> reductions{
    "at", "peak", "last", "max", "min", "mean", "rms", "error", "pullback", "slope", "arrival", "until"};
constexpr bool is_reduction(std::string_view name) {
  for (const std::string_view known : reductions)
    if (known == name) return true;
  return false;
}

/// Reports an expected value that is not of the dimension of `unit`, which results have it in; "1": of a pure
/// number.
void check_dimension(const Expectation& expected, const std::string& unit, Diagnostics& out);

/// Reports an expectation of a gauge that names a column which the gauge does not have, or no value of it:
/// before the run, not at its end.
void check_expected_column(const Expectation& expected, const Gauge& gauge, Diagnostics& out);

}  // namespace recoil::config
