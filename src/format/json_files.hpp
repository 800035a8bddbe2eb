#pragma once

#include <filesystem>
#include <string_view>

namespace recoil {

/// Replaces the file at `path` by `text` so that a reader (or a crash at any moment) sees either the old
/// contents or the new ones, never a part: written to a temporary name beside it, synced, renamed.
/// Meant for the small files of a run (status.json, summary.json, pictures).
/// @throws EnvironmentError where the disk refuses.
void write_atomically(const std::filesystem::path& path, std::string_view text);

/// The temporary name that belongs to `path`, in the same folder and unique to this process.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Syncs the finished file `temporary` to disk and gives it its final name. @throws EnvironmentError.
void sync_and_rename(const std::filesystem::path& temporary, const std::filesystem::path& path);

}  // namespace recoil
