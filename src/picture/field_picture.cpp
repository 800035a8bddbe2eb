#include "picture/field_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/error.hpp"
#include "picture/colour_key.hpp"
#include "picture/frame.hpp"

namespace recoil {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

constexpr double kLeastWidth = 480;  // of a picture, for its heading [pixels]
constexpr double kNarrow = 520;      // a field that leaves its heading too little room [pixels]

/// Everything decided before the first line.
struct Layout {
  int width = 0, height = 0;
  Frame frame;
  ColourKey key;
};

/// Size of the field in the picture within the room left, at equal scales on both axes if asked for.
Point2 fitted(const FieldPicture& p, double room_x, double room_y) {
  if (!p.equal_aspect) return {std::floor(room_x), std::floor(room_y)};
  const double size_x = p.mirror ? 2 * (p.x0 + p.nx * p.dx) : p.nx * p.dx, size_y = p.ny * p.dy;
  const double scale = std::min(room_x / size_x, room_y / size_y);
  return {std::max(60.0, std::round(size_x * scale)), std::max(40.0, std::round(size_y * scale))};
}

/// Labels of a mirrored axis show the distance from the axis on both sides.
void drop_minus(Ticks& ticks) {
  for (auto& label : ticks.labels)
    if (label.starts_with("\u2212")) label.erase(0, std::string("\u2212").size());
}

/// A key on the right, or below a field that is wide and low.
void place_key(const FieldPicture& p, Layout& l) {
  const Frame& f = l.frame;
  l.key = {colours_of(p.values, {p.map, p.range, p.log, p.categories}), p.label,
           p.equal_aspect && (f.x.hi - f.x.lo) / p.x_scale > 2.2 * (f.y.hi - f.y.lo) / p.y_scale};
}

Layout layout_of(const FieldPicture& p) {
  Layout l;
  Frame& f = l.frame;
  const double x1 = (p.x0 + p.nx * p.dx) * p.x_scale;
  f.x = {p.mirror ? -x1 : p.x0 * p.x_scale, x1};
  f.y = {p.y0 * p.y_scale, (p.y0 + p.ny * p.dy) * p.y_scale};
  f.x_title = p.x_title;
  f.y_title = p.y_title;
  place_key(p, l);
  const double top = p.title.empty() && p.note.empty() ? 24 : 62;
  f.y_ticks = nice_ticks(f.y, 5);
  const double left = std::ceil(left_margin(f.y_ticks) + 8);
  const double right = l.key.horizontal ? 36 : key_width(l.key);
  const double below =
      bottom_margin() + (l.key.horizontal ? 10 + key_height(l.key, p.max_width - left - right) : 0);
  const Point2 size = fitted(p, p.max_width - left - right, p.max_height - top - below);
  const double beside = std::floor(0.5 * std::max(0.0, kLeastWidth - left - size.x - right));
  f.area = {left + beside, top, left + beside + size.x, top + size.y};
  // A small picture gets fewer marks; never so many labels that the left margin would change much.
  f.y_ticks = nice_ticks(f.y, std::clamp(static_cast<int>(size.y / 75), 3, 8));
  f.x_ticks = nice_ticks(f.x, std::clamp(static_cast<int>(size.x / 110), 2, 10));
  if (p.mirror) drop_minus(f.x_ticks);
  if (!p.y_labels) f.y_ticks = {};
  l.width = static_cast<int>(f.area.x1 + right + beside);
  l.height = static_cast<int>(f.area.y1 + below);
  return l;
}

/// Above the field, or above the whole picture where the field is narrow.
PixelRect heading_place(const Layout& l) {
  PixelRect place = l.frame.area;
  if (place.x1 - place.x0 < kNarrow) place.x0 = 14, place.x1 = l.width - 14.0;
  return place;
}

/// Cell-centred values, read at any place.
struct Sampler {
  const FieldPicture& p;

  double cell(const std::vector<double>& values, int i, int j) const {
    const int ii = std::clamp(i, 0, p.nx - 1), jj = std::clamp(j, 0, p.ny - 1);
    return values[static_cast<std::size_t>(ii) +
                  static_cast<std::size_t>(p.nx) * static_cast<std::size_t>(jj)];
  }

  /// Linear between the four nearest centres, of which those without a value do not count.
  double linear(const std::vector<double>& values, double u, double v) const {
    const int i = static_cast<int>(std::floor(u - 0.5)), j = static_cast<int>(std::floor(v - 0.5));
    const double s = u - 0.5 - i, t = v - 0.5 - j;
    double sum = 0, weight = 0;
    for (int b = 0; b < 2; ++b)
      for (int a = 0; a < 2; ++a) {
        const double w = (a != 0 ? s : 1 - s) * (b != 0 ? t : 1 - t) + 1e-12;
        const double value = cell(values, i + a, j + b);
        if (std::isnan(value)) continue;
        sum += w * value;
        weight += w;
      }
    return weight > 0 ? sum / weight : kNothing;
  }

  /// The nearest cell that has a value, two cells away at most.
  double nearest(double u, double v) const {
    const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
    double best = kNothing, least = 1e30;
    for (int b = -2; b <= 2; ++b)
      for (int a = -2; a <= 2; ++a) {
        const double value = cell(p.values, i + a, j + b);
        const double distance = std::hypot(i + a + 0.5 - u, j + b + 0.5 - v);
        if (!std::isnan(value) && distance < least) least = distance, best = value;
      }
    return best;
  }

  /// The value at (u, v), in cells from the lower left corner; NaN where nothing is.
  double at(double u, double v) const {
    const double own = cell(p.values, static_cast<int>(std::floor(u)), static_cast<int>(std::floor(v)));
    if (p.level_set.empty()) {
      if (std::isnan(own) || !p.interpolate) return own;
      return linear(p.values, u, v);
    }
    const double phi = linear(p.level_set, u, v);
    if (!(phi < 0)) return kNothing;
    const double value = p.interpolate ? linear(p.values, u, v) : own;
    return std::isnan(value) ? nearest(u, v) : value;
  }
};

/// Colours of the field: each pixel is the mean of a few samples, so that edges are smooth.
void paint_field(Canvas& canvas, const FieldPicture& p, const Layout& l) {
  const Sampler sampler{p};
  const PixelRect a = l.frame.area;
  Image image(p.detail * static_cast<int>(a.x1 - a.x0), p.detail * static_cast<int>(a.y1 - a.y0));
  const double beside_axis = p.mirror ? p.x0 / p.dx : 0;  // cells between the axis and the first one
  const double half = beside_axis + p.nx;
  const double cells_x = half * (p.mirror ? 2 : 1) / image.width, cells_y = 1.0 * p.ny / image.height;
  const int n = std::clamp(static_cast<int>(std::ceil(1.5 * std::max(cells_x, cells_y))), 3, 6);
  for (int j = 0; j < image.height; ++j)
    for (int i = 0; i < image.width; ++i) {
      int sum[3] = {0, 0, 0};
      for (int k = 0; k < n * n; ++k) {
        const int column = k % n, row = k / n;
        const double x = (i + (column + 0.5) / n) * cells_x - (p.mirror ? half : 0);
        const double u = std::abs(x) - beside_axis;
        const double v = (image.height - j - (row + 0.5) / n) * cells_y;
        const Rgb c = l.key.colours.at(u < 0 ? kNothing : sampler.at(u, v));
        sum[0] += c.r, sum[1] += c.g, sum[2] += c.b;
      }
      const auto mean = [n](int s) { return static_cast<unsigned char>((s + n * n / 2) / (n * n)); };
      image.set(i, j, {mean(sum[0]), mean(sum[1]), mean(sum[2])});
    }
  draw_image(canvas, image, a);
}

void draw_outlines(Canvas& canvas, const FieldPicture& p, const Layout& l,
                   const std::vector<Outline>& outlines, const Stroke& stroke) {
  std::vector<Polyline> lines;
  for (const double side : {1.0, -1.0}) {
    if (side < 0 && !p.mirror) break;
    for (const auto& outline : outlines) {
      Polyline& line = lines.emplace_back();
      for (const Point2& q : outline.points)
        line.push_back(l.frame.pixel(side * q.x * p.x_scale, q.y * p.y_scale));
      if (outline.closed && !line.empty()) line.push_back(line.front());
    }
  }
  draw_polylines(canvas, lines, stroke, l.frame.area);
}

std::vector<Mark> placed_marks(const FieldPicture& p, const Frame& frame) {
  double fastest = 0;
  for (const Mark& m : p.marks) fastest = std::max(fastest, std::hypot(m.way.x, m.way.y));
  const double scale = fastest > 0 ? kLongestArrow / fastest : 0;
  std::vector<Mark> marks = p.marks;
  for (Mark& m : marks) {
    m.at = frame.pixel(m.at.x * p.x_scale, m.at.y * p.y_scale);
    m.way = {scale * m.way.x, -scale * m.way.y};
  }
  return marks;
}

void check(const FieldPicture& p) {
  require(p.nx > 0 && p.ny > 0 && p.dx > 0 && p.dy > 0, "a field picture has cells of positive size");
  const std::size_t count = static_cast<std::size_t>(p.nx) * static_cast<std::size_t>(p.ny);
  require(p.values.size() == count, "a field picture has nx * ny values");
  require(p.detail > 0, "a field picture has samples");
  require(p.level_set.empty() || p.level_set.size() == count, "a level set has nx * ny values");
}

}  // namespace

Canvas field_picture(const FieldPicture& picture) {
  check(picture);
  const Layout l = layout_of(picture);
  Canvas canvas(l.width, l.height, kPictureStyle.page);
  paint_field(canvas, picture, l);
  draw_outlines(canvas, picture, l, picture.mesh_lines,
                {.colour = {40, 44, 52}, .width = 1.0, .alpha = 0.28});
  draw_outlines(canvas, picture, l, picture.outlines, {.colour = {24, 26, 30}, .width = 2.2});
  draw_outlines(canvas, picture, l, picture.references, {.colour = {240, 110, 30}, .width = 1.8});
  draw_axes(canvas, l.frame);
  draw_marks(canvas, placed_marks(picture, l.frame), l.frame.area);
  draw_key(canvas, l.key, l.frame.area, bottom_margin() + 10);
  draw_heading(canvas, heading_place(l), picture.title, picture.note);
  return canvas;
}

}  // namespace recoil
