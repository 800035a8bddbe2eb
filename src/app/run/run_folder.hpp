#pragma once

#include <filesystem>

#include <string>

#include "app/load_case.hpp"

namespace recoil::app {

/// @throws InputError for a file, and for a folder that holds files which are not of a run.
void refuse_foreign(const std::filesystem::path& folder);

/// Holds the folder of a run for this process, as long as it lives: no other run writes there meanwhile.
class RunLock {
 public:
  /// @param folder made where it does not exist. @throws InputError where another process holds it;
  /// EnvironmentError where the disk refuses.
  explicit RunLock(const std::filesystem::path& folder);
  ~RunLock();
  RunLock(RunLock&& other) noexcept;
  /// Whether some process holds a folder.
  static bool is_held(const std::filesystem::path& folder);
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

 private:
  int file_ = -1;
};

/// Makes the folder of a run ready and writes case.toml and case.resolved.toml. What an earlier run left
/// there is removed. @throws InputError where it holds a finished or interrupted run and not `force`, or
/// files that are not of a run; EnvironmentError where the disk refuses.
void prepare_run_folder(const std::filesystem::path& folder, const LoadedCase& loaded, bool force);

/// Writes case.resolved.toml, of the case as it is computed from now on.
void write_resolved_case(const std::filesystem::path& folder, const LoadedCase& loaded);

}  // namespace recoil::app
