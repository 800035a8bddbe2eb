#pragma once

#include "config/case.hpp"
#include "config/diagnostics.hpp"

namespace recoil {

/// Reports bodies that overlap (by more than 1e-6 of a cell): where and how deep. One error per pair, at the
/// later body. Looks at the cells of the case's mesh.
void find_overlaps(const config::Case& c, config::Diagnostics& out);

}  // namespace recoil
