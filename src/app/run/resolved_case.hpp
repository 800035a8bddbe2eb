#pragma once

#include <string>

#include "app/load_case.hpp"

namespace recoil::app {

/// The case as it is computed: every value in SI, defaults and materials included, each with a remark where
/// it comes from (a line of the case, --set, or default). Reads back as a case of its own.
std::string resolved_text(const LoadedCase& loaded);

}  // namespace recoil::app
