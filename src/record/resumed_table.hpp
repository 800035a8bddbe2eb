#pragma once

#include <filesystem>

namespace recoil {

/// Cuts a table of a resumed run, whose first column is `time [us]`, back to the row of `last` [s], the last
/// one before the checkpoint. @throws InputError where the file lacks that row, or cannot be read;
/// EnvironmentError.
void cut_back(const std::filesystem::path& table, double last);

}  // namespace recoil
