#pragma once

#include <filesystem>

#include "app/load_case.hpp"
#include "app/report/page_data.hpp"

namespace recoil::app {

/// Curves to draw over a gauge, each with `kind` ("reference" or "prediction"), `label`, `column` of the
/// gauge, `x` and `y` in the units of the gauge: the references that expectations name (from the folder of
/// the run, where a copy lies) and what one-dimensional wave theory predicts of plates.
Json comparisons(const config::Gauge& gauge, const LoadedCase& loaded, const std::filesystem::path& run);

}  // namespace recoil::app
