#pragma once

#include <string>

#include "picture/space/scene.hpp"

namespace recoil::app {

/// Reads a plane of space from its equation: "z=1mm", "x+y=0mm", "2x-0.5z=3mm".
/// @throws InputError that names the option.
SpacePlane read_plane(const std::string& text, const char* option);

/// The axis that the plane is across; -1: it is oblique.
int axis_across(const SpacePlane& plane);

}  // namespace recoil::app
