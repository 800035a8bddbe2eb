#pragma once

#include <cstddef>
#include <filesystem>

namespace recoil {

/// Cuts a table of a resumed run, whose first column is `time [us]`, back to the rows of `last` [s], the last
/// ones before the checkpoint. @throws InputError where the file has fewer of them than `rows`, or cannot be
/// read; EnvironmentError.
void cut_back(const std::filesystem::path& table, double last, std::size_t rows = 1);

}  // namespace recoil
