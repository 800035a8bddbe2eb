#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace recoil::config {

/// What to do about two files of one name.
inline constexpr const char* rename_one = "rename one: a run keeps a copy of each in its folder";

/// Adds a file to those of which a run keeps a copy, once.
/// @return what is wrong: another file has the same name; empty: nothing.
std::string keep_file(std::vector<std::filesystem::path>& files, const std::filesystem::path& file);

}  // namespace recoil::config
