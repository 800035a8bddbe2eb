#pragma once

#include <string>
#include <vector>

#include "config/document.hpp"

namespace recoil::config {

/// Applies `PATH=VALUE` changes from the command line, e.g. "mesh.finest=0.1mm": the value is TOML or bare
/// text. The new values have places in a text called "--set", one line each, so that what is wrong with them
/// (unknown keys too) is reported by the readers like any other mistake. Paths below names that the user
/// chooses (body.NAME, gauge.NAME, material.NAME) must lead to one that the document has; a whole table adds
/// one (gauge.NAME={...}).
void apply_overrides(Document& document, const std::vector<std::string>& overrides, Diagnostics& out);

}  // namespace recoil::config
