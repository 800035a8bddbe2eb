#pragma once

#include <filesystem>
#include <vector>

#include "picture/field_plane.hpp"

namespace recoil::app {

/// The dumps of the fields of a run.
struct RunDumps {
  std::vector<ChosenDump> whole;               // in order
  std::vector<std::filesystem::path> damaged;  // cut off: a page is made without them
};

/// @param run its folder; one without fields has none.
RunDumps dumps_of(const std::filesystem::path& run);

}  // namespace recoil::app
