#pragma once

#include <string>
#include <vector>

#include "app/load_case.hpp"

namespace recoil::app {

/// The case as it is computed: every value in SI, defaults and materials included, each with a remark where
/// it comes from (a line of the case, --set, or default), and the changes of the command line at its head.
/// Reads back as a case of its own.
std::string resolved_text(const LoadedCase& loaded);

/// The changes of the command line that a resolved case names: "mesh.finest=0.1mm".
std::vector<std::string> changes_of(const std::string& resolved);

}  // namespace recoil::app
