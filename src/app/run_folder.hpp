#pragma once

#include <filesystem>

#include "app/load_case.hpp"

namespace recoil::app {

/// Makes the folder of a run ready and writes case.toml and case.resolved.toml. What an earlier run left
/// there is removed. @throws InputError where it holds a finished run and not `force`, or files that are not
/// of a run; EnvironmentError where the disk refuses.
void prepare_run_folder(const std::filesystem::path& folder, const LoadedCase& loaded, bool force);

}  // namespace recoil::app
