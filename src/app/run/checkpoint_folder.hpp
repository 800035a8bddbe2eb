#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/load_case.hpp"
#include "format/block_file.hpp"

/// The checkpoints of a run: checkpoints/000123.h5, numbered by the step.
namespace recoil::app {

/// What a checkpoint says of the case that it belongs to.
struct CheckpointText {
  std::string version;
  std::string case_file;                    // absolute, as it was given
  std::vector<std::string> overrides;       // of the command line
  std::map<std::string, std::string> keys;  // of the case, with all defaults: "mesh.finest" -> "..."
  double time = 0;                          // of the state [s]
};

CheckpointText describe(const LoadedCase& loaded, const std::vector<std::string>& overrides);
std::string to_json(const CheckpointText& text);
/// @throws InputError for a text that is not one.
CheckpointText checkpoint_text(const std::string& json);

/// The file for a checkpoint after this step.
std::filesystem::path checkpoint_file(const std::filesystem::path& run, long step);
/// Those that a run has left, the oldest first.
std::vector<std::filesystem::path> checkpoints_of(const std::filesystem::path& run);
/// Removes all but the newest `keep`, and what a run has left that was killed while it wrote one.
void remove_old_checkpoints(const std::filesystem::path& run, int keep);

/// The keys of a case that differ from those that a checkpoint was made with although a run cannot go on with
/// other values: all but the end of the run, its outputs, gauges and expectations, and its title.
std::vector<std::string> changed_keys(const CheckpointText& then, const CheckpointText& now);
/// Why a run cannot go on from a checkpoint, and what helps; empty: it can.
std::string refusal(const CheckpointText& then, const CheckpointText& now);

}  // namespace recoil::app
