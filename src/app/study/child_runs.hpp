#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/load_case.hpp"

/// Many runs for one command: each a process of its own, in a folder of its own.
namespace recoil::app {

/// Calls task(k) once for every k below `items`, so many at a time. After an exception, or a request to stop,
/// nothing more is begun; the first exception is thrown again. @param jobs 0: one for each processor.
void share_work(std::size_t items, int jobs, const std::function<void(std::size_t)>& task);

/// A run that is wanted.
struct ChildRun {
  std::filesystem::path case_file, folder;
  std::vector<std::string> overrides;  // PATH=VALUE
  std::string resolved;                // the case as it will be computed
  int threads = 1;                     // 0: as `recoil run` chooses
};

/// The same, with everything that can be known to be wrong found. @throws InputError, EnvironmentError.
ChildRun checked_run(const std::filesystem::path& case_file, const std::vector<std::string>& overrides,
                     const std::filesystem::path& folder);

/// Whether a folder holds what the case, as it will be computed, leaves at its start.
bool is_of_case(const std::filesystem::path& folder, const std::string& resolved);

/// What became of it.
struct ChildResult {
  int exit = 0;
  bool reused = false;  // it had been finished before
  std::string verdict;  // of summary.json; "failed" of a run without results
  std::string problem;  // why there are no results; empty: there are, or it was not begun
  bool begun() const { return !verdict.empty(); }
};

/// Whether a request to stop came before all of these were done.
bool cut_short(const std::vector<ChildResult>& results);

/// What has become of the runs of a command that was asked to stop: how many are done, how many stopped with
/// a checkpoint, how many were not begun. @param how the command goes on.
std::string told_stopped(const std::vector<ChildResult>& results, const std::string& how);

/// What to say of a run that ended without results: its exit code, its first error and where its log is.
std::string why_no_results(int code, const std::filesystem::path& log);

/// Runs it, unless its folder holds the same run of the same version: a finished one is left alone, an
/// interrupted one goes on from its checkpoint. What it prints goes to FOLDER.log. After a request to stop
/// nothing is begun.
ChildResult run_or_reuse(const ChildRun& run);

/// Finds quantities that no run of the case can tell. @param option that named them. @throws InputError.
void check_named(const std::vector<std::string>& quantities, const LoadedCase& loaded, const char* option);

/// Makes a folder for results. @throws EnvironmentError.
void make_folder(const std::filesystem::path& folder);

}  // namespace recoil::app
