#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>

#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/run/checkpoint_folder.hpp"
#include "app/run/standing.hpp"
#include "core/error.hpp"
#include "format/block_file.hpp"

namespace recoil::app {

namespace {

namespace fs = std::filesystem;

/// What the newest checkpoint is worth; nothing where there is none.
std::string resume_text(const fs::path& folder) {
  const auto all = checkpoints_of(folder);
  if (all.empty()) return "it has left no checkpoint to go on from; a new run takes its place\n";
  const fs::path& newest = all.back();
  try {
    const double time = checkpoint_text(BlockFile(newest).head().text).time;
    return fmt::format("`recoil resume {}` goes on from its last checkpoint, {} at {:.6g} us\n",
                       folder.string(), newest.filename().string(), time * 1e6);
  } catch (const InputError& e) {
    return fmt::format(
        "its last checkpoint {} cannot be used ({}); `recoil resume {} --from` takes an earlier one\n",
        newest.filename().string(), e.what(), folder.string());
  }
}

/// A run is killed between two writes, or cannot write any more: then its last words are all that is known.
std::string text_of(const Standing& s, const std::string& folder) {
  const std::string where = fmt::format("{:.6g} of {:.6g} us, step {}", s.time_us, s.end_us, s.step);
  if (s.state == "running")
    return fmt::format("{}: running at {}, dt {:.4g} ns, {:.0f} s so far, about {:.0f} s left\n", folder,
                       where, s.dt_ns, s.wall_s, s.left_s);
  if (s.state == "interrupted")
    return fmt::format(
        "{}: interrupted (killed, or ended by an error of the machine such as a full disk) beyond {}, "
        "which it had reached after {:.3g} s\n",
        folder, where, s.wall_s);
  return fmt::format("{}: {} at {}, after {:.3g} s\n", folder, s.state, where, s.wall_s);
}

}  // namespace

int status(const StatusOptions& options) {
  const fs::path folder = options.folder, file = folder / "status.json";
  for (;;) {
    const Standing s = standing_of(folder);
    if (!fs::exists(file))
      fmt::print("{}: {}\n", options.folder,
                 s.state == "starting" ? "starting" : "interrupted before its first step");
    else
      fmt::print("{}", text_of(s, options.folder));
    if (s.state == "interrupted" || s.state == "stopped") fmt::print("{}", resume_text(folder));
    std::fflush(stdout);
    if (!options.watch || (s.state != "running" && s.state != "starting")) return exit_finished;
    std::this_thread::sleep_for(std::chrono::seconds(2));
  }
}

}  // namespace recoil::app
