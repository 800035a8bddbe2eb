#pragma once

#include <string>

#include "picture/field_plane.hpp"
#include "picture/line_chart.hpp"
#include "picture/space/field_scene.hpp"

namespace recoil::app {

/// A field along the line of --along, "0mm,1mm:9mm,1mm", over the distance from its beginning, two values a
/// cell.
/// @param mirror whether x < 0 is the mirror image of x > 0.
/// @throws InputError for another text, and where there is no matter along it.
LineChart line_in_plane(const FieldPlane& plane, const std::string& along, const std::string& title,
                        const std::string& time, bool mirror);

/// Whether the line is one of space: "0mm,0mm,1mm:9mm,0mm,1mm".
bool is_line_in_space(const std::string& along);

/// The same along a line of space.
LineChart line_in_space(const FieldScene& scene, const std::string& along, const std::string& title,
                        const std::string& time);

}  // namespace recoil::app
