#pragma once

#include "app/load_case.hpp"
#include "app/report/page_data.hpp"

namespace recoil::app {

/// Every material of a case once: name, title, the bodies of it, its models with their constants in SI,
/// sources.
Json materials_json(const LoadedCase& loaded);

/// What the case and its materials cite, as a list of `key`, `text` for people and `bibtex`.
Json sources_json(const LoadedCase& loaded);

}  // namespace recoil::app
