#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "picture/image.hpp"

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

/// A drawing of fixed size. It is recorded as lines, text and images, and becomes pixels only where the
/// format of a file or `rendered` needs them.
class Canvas {
 public:
  /// @throws InternalError for an empty or absurd size [pixels].
  Canvas(int width, int height, Rgb page);
  ~Canvas();
  Canvas(Canvas&&) noexcept;
  Canvas& operator=(Canvas&&) noexcept;

  int width() const { return width_; }
  int height() const { return height_; }
  /// The whole picture.
  PixelRect bounds() const { return {0, 0, 1.0 * width_, 1.0 * height_}; }

  /// What Cairo has recorded (picture/recording.hpp).
  struct Recording;
  Recording& recording() const { return *recording_; }

 private:
  int width_ = 0, height_ = 0;
  std::unique_ptr<Recording> recording_;
};

/// Fills a rectangle; edges between pixels are antialiased.
void fill_rect(Canvas& canvas, const PixelRect& rect, Rgb colour, double alpha = 1.0);

/// Draws the edge of a rectangle, `width` pixels of which half lies inside.
void draw_frame(Canvas& canvas, const PixelRect& rect, Rgb colour, double width = 1.0);

/// Draws lines, antialiased, inside `clip` only. Where the lines cross each other they cover once, so
/// half transparent lines have no darker knots. A line breaks at points that are not finite.
void draw_polylines(Canvas& canvas, std::span<const Polyline> lines, const Stroke& stroke,
                    const PixelRect& clip);
void draw_polyline(Canvas& canvas, const Polyline& line, const Stroke& stroke, const PixelRect& clip);

/// Fills what the closed line goes around.
void fill_polygon(Canvas& canvas, const Polyline& corners, Rgb colour);

/// Fills a circle, antialiased.
void fill_circle(Canvas& canvas, Point2 centre, double radius, Rgb colour, const PixelRect& clip);

/// Stretches the image over a rectangle; its pixels stay sharp.
void draw_image(Canvas& canvas, const Image& image, const PixelRect& place);

/// The picture as pixels.
Image rendered(const Canvas& canvas);

enum class PictureFormat { png, svg, pdf };

/// The format that the suffix of a file names, in any case of letters. @throws InputError for another suffix.
PictureFormat picture_format(const std::filesystem::path& file);

/// The bytes of the file. A pixel is half a point (1/144 inch) in PDF and a pixel in SVG. The same drawing
/// gives the same bytes: no date is written. @throws EnvironmentError where Cairo fails.
std::string encoded(const Canvas& canvas, PictureFormat format);

/// Writes the file, in the format that its suffix names, in one step (see write_atomically).
/// @throws InputError for another suffix, EnvironmentError.
void write_picture(const std::filesystem::path& file, const Canvas& canvas);

}  // namespace recoil
