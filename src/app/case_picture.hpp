#pragma once

#include <filesystem>

#include "config/case.hpp"

namespace recoil::app {

/// Draws the bodies of a case at the start as a PNG; of a 3d case the plane through the middle of its z axis.
void draw_case(const config::Case& c, const std::filesystem::path& png);

}  // namespace recoil::app
