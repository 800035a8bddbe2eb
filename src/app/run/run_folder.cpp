#include "app/run/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>
#include <utility>

#include "app/data_folder.hpp"
#include "app/run/checkpoint_folder.hpp"
#include "app/run/resolved_case.hpp"
#include "config/geometry.hpp"
#include "core/error.hpp"
#include "format/json_files.hpp"
#include "picture/space/surface_net.hpp"
#include "problem/shape.hpp"
#include "record/quantities.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

/// Everything that a run leaves behind, and nothing else is ever removed.
constexpr const char* traces[] = {"case.toml",   "case.resolved.toml", "run.log",
                                  "status.json", "summary.json",       "quantities.csv",
                                  "history.csv", "events.csv",         "gauges",
                                  "fields",      "fragments.csv",      "crash",
                                  "checkpoints", "report.html",        "open_in_paraview.py"};

constexpr const char* paraview_script = "open_in_paraview.py";
constexpr const char* lock_name = ".lock";

bool holds_nothing(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename() != lock_name) return false;
  return true;
}

/// Whether a run here was stopped or killed, and left a checkpoint to go on from.
bool was_interrupted(const fs::path& folder) {
  return !fs::exists(folder / "summary.json") && !checkpoints_of(folder).empty();
}

/// What the case reads, and the curves that expectations compare with, so that the folder is complete by
/// itself.
void copy_file_into(const fs::path& folder, const fs::path& file) {
  const fs::path copy = folder / file.filename();
  if (fs::exists(copy) && fs::equivalent(file, copy)) return;  // of the same folder
  fs::copy_file(file, copy, fs::copy_options::overwrite_existing);
}

/// It stands beside the templates, as data of the program; where RECOIL_DATA names a folder of materials only
/// there is none.
void copy_paraview_script(const fs::path& folder) {
  const fs::path script = templates_folder() / paraview_script;
  if (fs::exists(script)) copy_file_into(folder, script);
}

/// Surfaces of the rigid bodies at the start, which dumps have no cells of, for ParaView: fields/rigid_N.stl,
/// N their number in the dumps. In cells of mesh.finest, or of a 128th of the domain's longest side.
void write_rigid_surfaces(const fs::path& folder, const config::Case& c) {
  if (c.domain.geometry != config::Geometry::space) return;
  const SpaceBox box{config::first_components<3>(c.domain.lo), config::first_components<3>(c.domain.hi)};
  const Vec<3> extent = box.hi - box.lo;
  const double width = std::max(c.mesh.finest, std::max({extent[0], extent[1], extent[2]}) / 128);
  for (std::size_t m = 0; m < c.bodies.size(); ++m) {
    if (!c.bodies[m].rigid) continue;
    fs::create_directories(folder / "fields");
    const auto surface = surface_net(signed_distance<3>(c.bodies[m].shape, c.domain), box, width);
    write_atomically(folder / "fields" / fmt::format("rigid_{}.stl", m),
                     stl_bytes(surface, c.bodies[m].name));
  }
}

void copy_files(const fs::path& folder, const LoadedCase& loaded) {
  for (const fs::path& file : loaded.contents.files) copy_file_into(folder, file);
  for (const config::Expectation& e : loaded.contents.expect) {
    const auto named = reference_curve_of(e.quantity);
    if (!named || named->file.has_parent_path() || !fs::exists(loaded.folder / named->file)) continue;
    copy_file_into(folder, loaded.folder / named->file);
  }
}

/// Whether the run of a folder says that it is under way.
bool says_running(const fs::path& folder) {
  std::ifstream in(folder / "status.json");
  const auto j = nlohmann::json::parse(in, nullptr, false);
  return j.is_object() && j.value("state", "") == "running";
}

/// Locks a file in a folder for this process alone. is_held() holds the lock for an instant; a run that was
/// stopped, and does not say that it is running, may still be closing its files: it has two seconds for that.
/// @returns whether it has it.
bool lock_soon(int file, const fs::path& folder) {
  constexpr std::chrono::milliseconds pause{20};
  constexpr int instant = 3, longest = 100;  // pauses
  for (int i = 0; i < longest; ++i, std::this_thread::sleep_for(pause)) {
    if (flock(file, LOCK_EX | LOCK_NB) == 0) return true;
    if (i >= instant && says_running(folder)) return false;
  }
  return false;
}

}  // namespace

void refuse_foreign(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder))
    throw InputError(
        fmt::format("{} is a file, not a folder\n   = help: choose another one with -o", folder.string()));
  if (holds_nothing(folder) || fs::exists(folder / "case.resolved.toml") ||
      fs::exists(folder / "status.json"))
    return;
  throw InputError(fmt::format("the folder {} holds files, but no run\n   = help: choose another one with -o",
                               folder.string()));
}

RunLock::RunLock(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw EnvironmentError(fmt::format("the folder {} cannot be made: {}", folder.string(), error.message()));
  const fs::path name = folder / lock_name;
  file_ = open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0)
    throw EnvironmentError(fmt::format("{} cannot be written: {}", name.string(), std::strerror(errno)));
  if (!lock_soon(file_, folder)) {
    close(file_);
    throw InputError(
        fmt::format("another run is writing to the folder {}\n   = help: wait for it, stop it, or "
                    "choose another folder with -o; `recoil status {}` shows how far it is",
                    folder.string(), folder.string()));
  }
}

bool RunLock::is_held(const fs::path& folder) {
  // For reading, so that those may ask who may not write there.
  const int file = open((folder / lock_name).c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool held = flock(file, LOCK_SH | LOCK_NB) != 0;
  close(file);
  return held;
}

RunLock::~RunLock() {
  if (file_ >= 0) close(file_);
}

RunLock::RunLock(RunLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

void write_resolved_case(const fs::path& folder, const LoadedCase& loaded) {
  write_atomically(folder / "case.resolved.toml", resolved_text(loaded));
}

void prepare_run_folder(const fs::path& folder, const LoadedCase& loaded, bool force) {
  try {
    refuse_foreign(folder);
    if (fs::exists(folder / "summary.json") && !force)
      throw InputError(
          fmt::format("the folder {} holds a finished run\n   = help: --force replaces it, -o chooses "
                      "another folder",
                      folder.string()));
    if (was_interrupted(folder) && !force)
      throw InputError(
          fmt::format("the folder {} holds an interrupted run\n   = help: `recoil resume {}` goes on with "
                      "it, --force replaces it, -o chooses another folder",
                      folder.string(), folder.string()));
    const std::string resolved = resolved_text(loaded);
    for (const char* name : traces) fs::remove_all(folder / name);
    fs::create_directories(folder);
    write_atomically(folder / "case.toml", loaded.document.text);
    write_atomically(folder / "case.resolved.toml", resolved);
    copy_files(folder, loaded);
    copy_paraview_script(folder);
    write_rigid_surfaces(folder, loaded.contents);
  } catch (const fs::filesystem_error& e) {
    throw EnvironmentError(fmt::format("the folder {} cannot be used: {}", folder.string(), e.what()));
  }
}

}  // namespace recoil::app
