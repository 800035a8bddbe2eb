#include "picture/canvas.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <regex>

#include "core/error.hpp"
#include "format/json_files.hpp"
#include "picture/recording.hpp"

namespace recoil {
namespace {

constexpr double points_of_a_pixel = 0.5;  // in PDF

void set_colour(cairo_t* pen, Rgb c, double alpha) {
  cairo_set_source_rgba(pen, c.r / 255.0, c.g / 255.0, c.b / 255.0, alpha);
}

void clip_to(cairo_t* pen, const PixelRect& r) {
  cairo_rectangle(pen, r.x0, r.y0, r.x1 - r.x0, r.y1 - r.y0);
  cairo_clip(pen);
}

/// Settings of the pen that hold until the end of the scope. It begins with an empty path, which is none of
/// the settings: a text leaves the point at its end there.
struct Scope {
  cairo_t* pen;
  explicit Scope(const Canvas& canvas) : pen(canvas.recording().pen) {
    cairo_save(pen);
    cairo_new_path(pen);
  }
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;
  ~Scope() { cairo_restore(pen); }
};

/// The part of the segment inside the rectangle, as a range of its parameter (Liang and Barsky, 1984).
bool clip_segment(Point2 a, Point2 b, const PixelRect& r, double& t0, double& t1) {
  t0 = 0, t1 = 1;
  const double d[4] = {a.x - b.x, b.x - a.x, a.y - b.y, b.y - a.y};
  const double q[4] = {a.x - r.x0, r.x1 - a.x, a.y - r.y0, r.y1 - a.y};
  for (int k = 0; k < 4; ++k) {
    if (d[k] == 0) {
      if (q[k] < 0) return false;
    } else if (d[k] < 0) {
      t0 = std::max(t0, q[k] / d[k]);
    } else {
      t1 = std::min(t1, q[k] / d[k]);
    }
  }
  return t0 <= t1;
}

Point2 between(Point2 a, Point2 b, double t) { return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; }

/// Adds the line to the path. Cairo's coordinates end at 2^23 pixels, so what lies far outside is cut off.
void add_path(cairo_t* pen, const Polyline& line, const PixelRect& visible) {
  const auto finite = [](Point2 p) { return std::isfinite(p.x) && std::isfinite(p.y); };
  bool down = false;  // the pen stands at line[k - 1]
  for (std::size_t k = 1; k < line.size(); ++k) {
    const Point2 a = line[k - 1], b = line[k];
    double t0 = 0, t1 = 1;
    if (!finite(a) || !finite(b) || !clip_segment(a, b, visible, t0, t1)) {
      down = false;
      continue;
    }
    const Point2 from = between(a, b, t0), to = between(a, b, t1);
    if (!down || t0 > 0) cairo_move_to(pen, from.x, from.y);
    cairo_line_to(pen, to.x, to.y);
    down = t1 == 1;
  }
}

/// An image as Cairo's, which takes 4 bytes a pixel.
cairo_surface_t* surface_of(const Image& image) {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height);
  require_drawn(cairo_surface_status(surface));
  unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int j = 0; j < image.height; ++j) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(j) * stride);
    for (int i = 0; i < image.width; ++i) {
      const Rgb c = image.at(i, j);
      row[i] = static_cast<std::uint32_t>(c.r) << 16 | static_cast<std::uint32_t>(c.g) << 8 | c.b;
    }
  }
  cairo_surface_mark_dirty(surface);
  return surface;
}

/// Draws everything recorded on another surface.
void replay(const Canvas& canvas, const Canvas::Recording& target, double scale) {
  require_drawn(cairo_status(canvas.recording().pen));
  cairo_scale(target.pen, scale, scale);
  cairo_set_source_surface(target.pen, canvas.recording().surface, 0, 0);
  cairo_paint(target.pen);
  require_drawn(cairo_status(target.pen));
}

/// Takes Cairo's output to a string; the type is Cairo's cairo_write_func_t.
cairo_status_t append(void* to, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

std::string encoded_pdf(const Canvas& canvas) {
  std::string bytes;
  const Canvas::Recording target(cairo_pdf_surface_create_for_stream(
      append, &bytes, points_of_a_pixel * canvas.width(), points_of_a_pixel * canvas.height()));
  cairo_pdf_surface_set_metadata(target.surface, CAIRO_PDF_METADATA_CREATE_DATE, nullptr);
  replay(canvas, target, points_of_a_pixel);
  cairo_surface_finish(target.surface);
  require_drawn(cairo_surface_status(target.surface));
  return bytes;
}

/// Cairo numbers surfaces from the start of the program; here they count from 1, so that a drawing gives the
/// same bytes whatever was drawn before. None of our texts is in the file, so every such name is Cairo's.
std::string with_own_numbers(const std::string& svg) {
  static const std::regex name("([\"#](?:surface|image))([0-9]+)");
  std::map<std::string, std::size_t> numbers;
  std::string out;
  auto rest = svg.begin();
  for (auto at = std::sregex_iterator(svg.begin(), svg.end(), name); at != std::sregex_iterator(); ++at) {
    const std::size_t number = numbers.try_emplace((*at)[2].str(), numbers.size() + 1).first->second;
    out.append(rest, (*at)[1].second);
    out += std::to_string(number);
    rest = (*at)[2].second;
  }
  return out.append(rest, svg.end());
}

std::string encoded_svg(const Canvas& canvas) {
  std::string bytes;
  const Canvas::Recording target(
      cairo_svg_surface_create_for_stream(append, &bytes, canvas.width(), canvas.height()));
  cairo_svg_surface_set_document_unit(target.surface, CAIRO_SVG_UNIT_PX);
  replay(canvas, target, 1);
  cairo_surface_finish(target.surface);
  require_drawn(cairo_surface_status(target.surface));
  return with_own_numbers(bytes);
}

std::string encoded_png(const Canvas& canvas) {
  std::string bytes;
  const Canvas::Recording target(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, canvas.width(), canvas.height()));
  replay(canvas, target, 1);
  require_drawn(cairo_surface_write_to_png_stream(target.surface, append, &bytes));
  return bytes;
}

}  // namespace

void require_drawn(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw EnvironmentError(fmt::format("cannot draw the picture: {}", cairo_status_to_string(status)));
}

Canvas::Canvas(int width, int height, Rgb page) : width_(width), height_(height) {
  require(width > 0 && height > 0 && width <= 32767 && height <= 32767, "size of a picture in 1..32767");
  const cairo_rectangle_t extent{0, 0, 1.0 * width, 1.0 * height};
  recording_ =
      std::make_unique<Recording>(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &extent));
  require_drawn(cairo_status(recording_->pen));
  cairo_set_line_cap(recording_->pen, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(recording_->pen, CAIRO_LINE_JOIN_ROUND);
  set_colour(recording_->pen, page, 1);
  cairo_paint(recording_->pen);
}

Canvas::~Canvas() = default;
Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;

void fill_rect(Canvas& canvas, const PixelRect& r, Rgb colour, double alpha) {
  const Scope scope(canvas);
  set_colour(scope.pen, colour, alpha);
  cairo_rectangle(scope.pen, r.x0, r.y0, r.x1 - r.x0, r.y1 - r.y0);
  cairo_fill(scope.pen);
}

void draw_frame(Canvas& canvas, const PixelRect& r, Rgb colour, double width) {
  const Scope scope(canvas);
  set_colour(scope.pen, colour, 1);
  cairo_set_line_width(scope.pen, width);
  cairo_set_line_join(scope.pen, CAIRO_LINE_JOIN_MITER);
  cairo_rectangle(scope.pen, r.x0, r.y0, r.x1 - r.x0, r.y1 - r.y0);
  cairo_stroke(scope.pen);
}

void draw_polylines(Canvas& canvas, std::span<const Polyline> lines, const Stroke& stroke,
                    const PixelRect& clip) {
  const Scope scope(canvas);
  clip_to(scope.pen, clip);
  const double margin = 1000;  // cuts far outside keep the dashes of what is seen
  const PixelRect visible{clip.x0 - margin, clip.y0 - margin, clip.x1 + margin, clip.y1 + margin};
  for (const Polyline& line : lines) add_path(scope.pen, line, visible);
  set_colour(scope.pen, stroke.colour, stroke.alpha);
  cairo_set_line_width(scope.pen, stroke.width);
  if (!stroke.dash.empty())
    cairo_set_dash(scope.pen, stroke.dash.data(), static_cast<int>(stroke.dash.size()), 0);
  cairo_stroke(scope.pen);
}

void draw_polyline(Canvas& canvas, const Polyline& line, const Stroke& stroke, const PixelRect& clip) {
  draw_polylines(canvas, std::span(&line, 1), stroke, clip);
}

void fill_polygon(Canvas& canvas, const Polyline& corners, Rgb colour) {
  const Scope scope(canvas);
  set_colour(scope.pen, colour, 1);
  for (const Point2& p : corners) cairo_line_to(scope.pen, p.x, p.y);
  cairo_fill(scope.pen);
}

void fill_circle(Canvas& canvas, Point2 centre, double radius, Rgb colour, const PixelRect& clip) {
  const Scope scope(canvas);
  clip_to(scope.pen, clip);
  set_colour(scope.pen, colour, 1);
  cairo_arc(scope.pen, centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
  cairo_fill(scope.pen);
}

void draw_image(Canvas& canvas, const Image& image, const PixelRect& place) {
  const Scope scope(canvas);
  clip_to(scope.pen, place);
  cairo_surface_t* pixels = surface_of(image);
  cairo_translate(scope.pen, place.x0, place.y0);
  cairo_scale(scope.pen, (place.x1 - place.x0) / image.width, (place.y1 - place.y0) / image.height);
  cairo_set_source_surface(scope.pen, pixels, 0, 0);
  cairo_pattern_set_filter(cairo_get_source(scope.pen), CAIRO_FILTER_NEAREST);
  cairo_paint(scope.pen);
  cairo_surface_destroy(pixels);  // the recording holds it
}

Image rendered(const Canvas& canvas) {
  const Canvas::Recording target(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, canvas.width(), canvas.height()));
  replay(canvas, target, 1);
  cairo_surface_flush(target.surface);
  const unsigned char* data = cairo_image_surface_get_data(target.surface);
  const int stride = cairo_image_surface_get_stride(target.surface);
  Image image(canvas.width(), canvas.height());
  for (int j = 0; j < image.height; ++j) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(data + static_cast<std::ptrdiff_t>(j) * stride);
    for (int i = 0; i < image.width; ++i)
      image.set(i, j,
                {static_cast<unsigned char>(row[i] >> 16 & 255),
                 static_cast<unsigned char>(row[i] >> 8 & 255), static_cast<unsigned char>(row[i] & 255)});
  }
  return image;
}

PictureFormat picture_format(const std::filesystem::path& file) {
  std::string suffix = file.extension().string();
  std::ranges::transform(suffix, suffix.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (suffix == ".png") return PictureFormat::png;
  if (suffix == ".svg") return PictureFormat::svg;
  if (suffix == ".pdf") return PictureFormat::pdf;
  throw InputError(
      fmt::format("error: '{}' has no suffix of a picture format\n   = help: end it in .png, .svg or .pdf",
                  file.string()));
}

std::string encoded(const Canvas& canvas, PictureFormat format) {
  switch (format) {
    case PictureFormat::png:
      return encoded_png(canvas);
    case PictureFormat::svg:
      return encoded_svg(canvas);
    case PictureFormat::pdf:
      return encoded_pdf(canvas);
  }
  throw InternalError("unknown format of pictures");
}

void write_picture(const std::filesystem::path& file, const Canvas& canvas) {
  write_atomically(file, encoded(canvas, picture_format(file)));
}

}  // namespace recoil
