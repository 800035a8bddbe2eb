#pragma once

#include <vector>

#include "config/declare/reading.hpp"
#include "config/shape/outline.hpp"

namespace recoil::config {

/// Reports corners whose outline crosses itself, or encloses nothing: which side is inside is not known then.
void check_simple_outline(const std::vector<Corner>& corners, const TableReading& reading, const Key& key);

}  // namespace recoil::config
