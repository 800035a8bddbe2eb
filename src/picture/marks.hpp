#pragma once

#include <string>
#include <vector>

#include "picture/canvas.hpp"

namespace recoil {

/// What stands at a place of a picture [pixels]: a dot, such as a gauge, or an arrow, such as a velocity.
struct Mark {
  Point2 at{};
  Point2 way{};  ///< of the arrow; shorter than 8 pixels: a dot in a ring (it points at the viewer or away)
  std::string label{};
  bool arrow = false;
  bool behind = false;  ///< other things are in front of it: drawn hollow
};

/// Length of the arrow of the fastest body [pixels].
inline constexpr double kLongestArrow = 96;

/// Draws them with their labels, which stay inside of `area` and, where there is room, do not lie over each
/// other.
void draw_marks(Canvas& canvas, const std::vector<Mark>& marks, const PixelRect& area);

}  // namespace recoil
