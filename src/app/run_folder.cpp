#include "app/run_folder.hpp"

#include <fmt/format.h>

#include "app/resolved_case.hpp"
#include "core/error.hpp"
#include "format/json_files.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

/// Everything that a run leaves behind, and nothing else is ever removed.
constexpr const char* traces[] = {
    "case.toml",   "case.resolved.toml", "run.log", "status.json", "summary.json",
    "history.csv", "events.csv",         "gauges",  "fields",      "crash"};

void refuse_foreign(const fs::path& folder) {
  if (fs::is_empty(folder) || fs::exists(folder / "case.resolved.toml") || fs::exists(folder / "status.json"))
    return;
  throw InputError(fmt::format("the folder {} holds files, but no run\n   = help: choose another one with -o",
                               folder.string()));
}

}  // namespace

void prepare_run_folder(const fs::path& folder, const LoadedCase& loaded, bool force) {
  try {
    if (fs::exists(folder) && !fs::is_directory(folder))
      throw InputError(fmt::format("{} is a file, not a folder", folder.string()));
    if (fs::exists(folder / "summary.json") && !force)
      throw InputError(
          fmt::format("the folder {} holds a finished run\n   = help: --force replaces it, -o chooses "
                      "another folder",
                      folder.string()));
    if (fs::exists(folder)) refuse_foreign(folder);
    for (const char* name : traces) fs::remove_all(folder / name);
    fs::create_directories(folder);
    write_atomically(folder / "case.toml", loaded.document.text);
    write_atomically(folder / "case.resolved.toml", resolved_text(loaded));
  } catch (const fs::filesystem_error& e) {
    throw EnvironmentError(fmt::format("the folder {} cannot be used: {}", folder.string(), e.what()));
  }
}

}  // namespace recoil::app
