#pragma once

#include <string>

#include "picture/axis.hpp"
#include "picture/canvas.hpp"

namespace recoil {

/// Colours and sizes that all pictures share.
struct PictureStyle {
  Rgb page{255, 255, 255};
  Rgb ink{32, 34, 38};         ///< text, frames
  Rgb soft_ink{96, 100, 108};  ///< second-rank text
  Rgb grid{228, 231, 235};
  Rgb void_space{236, 239, 243};  ///< where there is no matter
  double text = 18;               ///< em of labels [pixels]
  double title = 21;
};
inline constexpr PictureStyle kPictureStyle{};

/// The rectangle in which data are drawn, with its two axes.
struct Frame {
  PixelRect area;
  AxisScale x, y;
  Ticks x_ticks, y_ticks;
  std::string x_title, y_title;

  /// Place of a value pair in the picture; NaN where a logarithm has none.
  Point2 pixel(double x_value, double y_value) const;
};

/// Light lines at the marks, drawn before the data.
void draw_grid(Canvas& canvas, const Frame& frame);

/// Edge, marks, labels and titles, drawn after the data.
void draw_axes(Canvas& canvas, const Frame& frame);

/// Room that labels and title of the vertical axis take on the left [pixels].
double left_margin(const Ticks& y_ticks);

/// Room that labels and title of the horizontal axis take below [pixels].
double bottom_margin();

/// The heading above `area`: `title` bold on the left, `note` (e.g. the time) on the right, or below the
/// title where one line has no room for both. Takes up to 62 pixels.
void draw_heading(Canvas& canvas, const PixelRect& area, const std::string& title, const std::string& note);

}  // namespace recoil
