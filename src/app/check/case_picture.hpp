#pragma once

#include <filesystem>

#include "config/case.hpp"

namespace recoil::app {

/// Draws the bodies of a case at the start; of a 3d case the plane through the middle of its z axis.
/// @param file .png, .svg or .pdf. @throws InputError for another suffix.
void draw_case(const config::Case& c, const std::filesystem::path& file);

}  // namespace recoil::app
