#pragma once

#include <vector>

#include "config/case.hpp"
#include "config/table.hpp"

namespace recoil::config {

/// What holds between bodies where they meet: the table [contact].
Contact read_contact(const Node& node, const std::vector<Body>& bodies, Diagnostics& out);

}  // namespace recoil::config
