#pragma once

#include <filesystem>
#include <string>

namespace recoil::app {

/// Where a run stood when it wrote status.json last.
struct Standing {
  std::string state;  // "starting", "running", "stopped", "failed", "finished"; "interrupted" was killed
  double time_us = 0, end_us = 0, dt_ns = 0, wall_s = 0, left_s = 0;
  long step = 0;
};

/// @throws InputError for a folder that holds no run, or a status.json that cannot be read.
Standing standing_of(const std::filesystem::path& run);

}  // namespace recoil::app
