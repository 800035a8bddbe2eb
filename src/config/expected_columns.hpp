#pragma once

#include "config/diagnostics.hpp"
#include "config/gauge/gauge.hpp"
#include "config/section/expect.hpp"

namespace recoil::config {

/// Reports an expectation of a gauge that names a column which the gauge does not have, no value of it, or
/// compares it with a value of another dimension: before the run, not at its end.
void check_expected_column(const Expectation& expected, const Gauge& gauge, Diagnostics& out);

}  // namespace recoil::config
