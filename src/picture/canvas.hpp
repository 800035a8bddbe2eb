#pragma once

#include <span>
#include <vector>

#include "picture/png.hpp"

namespace recoil {

/// A place in a picture [pixels], x to the right, y downwards, (0, 0) the upper left corner; or a place
/// in a plane [m] where said so.
struct Point2 {
  double x = 0, y = 0;
  friend bool operator==(const Point2&, const Point2&) = default;
};

/// The rectangle [x0, x1] x [y0, y1] in pixels, x0 <= x1, y0 <= y1.
struct PixelRect {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

using Polyline = std::vector<Point2>;

/// How a line is drawn: ends and corners are round.
struct Stroke {
  Rgb colour{0, 0, 0};
  double width = 1.5;          ///< pixels
  double alpha = 1.0;          ///< 1 covers fully
  std::vector<double> dash{};  ///< lengths on, off, on, off ... [pixels]; empty: solid
};

/// The whole picture as a rectangle.
PixelRect bounds(const Image& image);

/// Fills a rectangle; edges between pixels are antialiased. Parts outside the picture are left out.
void fill_rect(Image& image, const PixelRect& rect, Rgb colour, double alpha = 1.0);

/// Draws the edge of a rectangle, `width` pixels to each side of which half lies inside.
void draw_frame(Image& image, const PixelRect& rect, Rgb colour, double width = 1.0);

/// Draws lines, antialiased, inside `clip` only. Where the lines cross each other they cover once, so
/// half transparent lines have no darker knots. A line breaks at points that are not finite.
void draw_polylines(Image& image, std::span<const Polyline> lines, const Stroke& stroke,
                    const PixelRect& clip);
void draw_polyline(Image& image, const Polyline& line, const Stroke& stroke, const PixelRect& clip);

/// Fills a circle, antialiased.
void fill_circle(Image& image, Point2 centre, double radius, Rgb colour, const PixelRect& clip);

}  // namespace recoil
