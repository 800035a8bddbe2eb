#pragma once

#include <vector>

#include "config/keys.hpp"
#include "format/run_units.hpp"
#include "gauge/time_series.hpp"

namespace recoil {

/// Declared columns as they are written in a geometry: one for each axis, stress component or turn, with
/// the units of sums.
std::vector<SeriesColumn> column_list(const std::vector<config::Column>& declared, const RunUnits& units);

}  // namespace recoil
