#pragma once

#include <vector>

#include "config/case.hpp"
#include "config/diagnostics.hpp"
#include "config/document.hpp"

namespace recoil::config {

/// Reads the checks of an [expect] table: "quantity" = { value = "0.695 us", within = "3 %" }, { at-most =
/// ... }, { at-least = ... }, or true / false.
std::vector<Expectation> read_expectations(const Node& table, Diagnostics& out);

/// The same of a whole file such as expected.toml: its [expect], or without one everything at its top.
std::vector<Expectation> read_expectations(const Document& document, Diagnostics& out);

}  // namespace recoil::config
