#pragma once

#include <limits>

namespace recoil {

/// A number that does not exist: that of a gauge with nothing to measure, of a cell without matter, of an
/// empty field of a table. What is computed from it is nothing as well.
inline constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

}  // namespace recoil
