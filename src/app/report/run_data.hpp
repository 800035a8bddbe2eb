#pragma once

#include <filesystem>

#include "app/load_case.hpp"
#include "app/report/page_data.hpp"

namespace recoil::app {

/// All that a page tells of a run but its fields: summary, events, tables, curves to compare them with,
/// materials, the case. What a run that was stopped has not written is null.
Json run_data(const std::filesystem::path& run, const LoadedCase& loaded, Blocks& blocks);

}  // namespace recoil::app
