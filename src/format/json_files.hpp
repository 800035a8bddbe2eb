#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace recoil {

/// Replaces the file at `path` by `text` so that a reader (or a crash at any moment) sees either the old
/// contents or the new ones, never a part: written to a temporary name beside it, synced, renamed.
/// Meant for the small files of a run (status.json, summary.json, pictures).
/// @throws EnvironmentError where the disk refuses.
void write_atomically(const std::filesystem::path& path, std::string_view text);

/// The contents of a file; nothing where it cannot be read.
std::string text_of(const std::filesystem::path& path);

/// The temporary name that belongs to `path`, in the same folder and unique to this process.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Makes a file of so many bytes at `path` and removes it again: whether the disk has room for it.
/// @throws EnvironmentError where it has not.
void take_room(const std::filesystem::path& path, std::uintmax_t bytes);

/// Syncs the finished file `temporary` to disk and gives it its final name. @throws EnvironmentError.
void sync_and_rename(const std::filesystem::path& temporary, const std::filesystem::path& path);

}  // namespace recoil
