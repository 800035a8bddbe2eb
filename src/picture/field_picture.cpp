#include "picture/field_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/error.hpp"
#include "picture/frame.hpp"
#include "picture/text.hpp"

namespace recoil {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr double kBarWidth = 24, kBarGap = 26;
constexpr int kColours = 1024;

/// Everything decided before the first pixel.
struct Layout {
  int width = 0, height = 0;
  Frame frame;
  AxisScale colours;
  Ticks colour_ticks;
  bool bar_below = false;
  PixelRect bar;
};

AxisScale colour_scale(const FieldPicture& p) {
  Range range;
  if (p.range) {
    range.include(p.range->first);
    range.include(p.range->second);
    return axis_around(range, 0);
  }
  for (const double v : p.values) range.include(v);
  if (p.map == ColourMap::diverging && !range.empty()) {  // the pale middle means zero
    const double largest = std::max(std::abs(range.lo), std::abs(range.hi));
    range = {-largest, largest};
  }
  return axis_around(range, 0);
}

/// Size of the field in the picture within the room left, at equal scales on both axes if asked for.
Point2 fitted(const FieldPicture& p, double room_x, double room_y) {
  if (!p.equal_aspect) return {std::floor(room_x), std::floor(room_y)};
  const double size_x = p.nx * p.dx * (p.mirror ? 2 : 1), size_y = p.ny * p.dy;
  const double scale = std::min(room_x / size_x, room_y / size_y);
  return {std::max(60.0, std::round(size_x * scale)), std::max(40.0, std::round(size_y * scale))};
}

/// Labels of a mirrored axis show the distance from the axis on both sides.
void drop_minus(Ticks& ticks) {
  for (auto& label : ticks.labels)
    if (label.starts_with("\u2212")) label.erase(0, std::string("\u2212").size());
}

void place_bar(Layout& l, double side_room) {
  const PixelRect a = l.frame.area;
  if (l.bar_below) {
    const double w = std::min(0.72 * (a.x1 - a.x0), 620.0), x = std::floor(0.5 * (a.x0 + a.x1 - w));
    l.bar = {x, a.y1 + bottom_margin() + 10, x + std::floor(w), a.y1 + bottom_margin() + 10 + kBarWidth};
    l.height = static_cast<int>(l.bar.y1 + bottom_margin() - 2);
    l.width = static_cast<int>(a.x1 + 36);
  } else {
    l.bar = {a.x1 + kBarGap, a.y0, a.x1 + kBarGap + kBarWidth, a.y1};
    l.height = static_cast<int>(a.y1 + bottom_margin());
    l.width = static_cast<int>(a.x1 + side_room);
  }
}

Layout layout_of(const FieldPicture& p) {
  Layout l;
  l.colours = colour_scale(p);
  Frame& f = l.frame;
  const double x1 = (p.x0 + p.nx * p.dx) * p.x_scale;
  f.x = {p.mirror ? -x1 : p.x0 * p.x_scale, x1};
  f.y = {p.y0 * p.y_scale, (p.y0 + p.ny * p.dy) * p.y_scale};
  f.x_title = p.x_title;
  f.y_title = p.y_title;
  l.bar_below = p.equal_aspect && (f.x.hi - f.x.lo) / p.x_scale > 2.2 * (f.y.hi - f.y.lo) / p.y_scale;

  const double top = p.title.empty() && p.note.empty() ? 24 : 62;
  f.y_ticks = nice_ticks(f.y, 5);
  l.colour_ticks = nice_ticks(l.colours, 6);
  double widest = 0;
  for (const auto& label : l.colour_ticks.labels)
    widest = std::max(widest, text_width(label, kPictureStyle.text));
  const double side_room =
      l.bar_below ? 36 : std::ceil(kBarGap + kBarWidth + 16 + widest + 16 + kPictureStyle.text + 12);
  const double below = bottom_margin() + (l.bar_below ? bottom_margin() + kBarWidth + 8 : 0);
  const double left = std::ceil(left_margin(f.y_ticks) + 8);
  const Point2 size = fitted(p, p.max_width - left - side_room, p.max_height - top - below);
  f.area = {left, top, left + size.x, top + size.y};
  // A small picture gets fewer marks; never so many labels that the left margin would change much.
  f.y_ticks = nice_ticks(f.y, std::clamp(static_cast<int>(size.y / 75), 3, 8));
  f.x_ticks = nice_ticks(f.x, std::clamp(static_cast<int>(size.x / 110), 2, 10));
  if (p.mirror) drop_minus(f.x_ticks);
  l.colour_ticks = nice_ticks(l.colours, l.bar_below ? 6 : std::clamp(static_cast<int>(size.y / 80), 2, 8));
  place_bar(l, side_room);
  return l;
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
void paint_field(Image& image, const FieldPicture& p, const Layout& l) {
  const auto table = colour_table(p.map, kColours);
  const Sampler sampler{p};
  const PixelRect a = l.frame.area;
  const double cells_x = p.nx * (p.mirror ? 2.0 : 1.0) / (a.x1 - a.x0), cells_y = p.ny / (a.y1 - a.y0);
  const int n = std::clamp(static_cast<int>(std::ceil(1.5 * std::max(cells_x, cells_y))), 3, 6);
  for (int j = static_cast<int>(a.y0); j < static_cast<int>(a.y1); ++j)
    for (int i = static_cast<int>(a.x0); i < static_cast<int>(a.x1); ++i) {
      int sum[3] = {0, 0, 0};
      for (int k = 0; k < n * n; ++k) {
        const double u = (i + (k % n + 0.5) / n - a.x0) * cells_x - (p.mirror ? p.nx : 0);
        const double v = (a.y1 - j - (k / n + 0.5) / n) * cells_y;
        const double value = sampler.at(std::abs(u), v);
        const Rgb c =
            std::isnan(value) ? kPictureStyle.void_space : colour_at(table, l.colours.fraction(value));
        sum[0] += c.r, sum[1] += c.g, sum[2] += c.b;
      }
      const auto mean = [n](int s) { return static_cast<unsigned char>((s + n * n / 2) / (n * n)); };
      image.set(i, j, {mean(sum[0]), mean(sum[1]), mean(sum[2])});
    }
}

void draw_outlines(Image& image, const FieldPicture& p, const Layout& l, const std::vector<Outline>& outlines,
                   const Stroke& stroke) {
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
  draw_polylines(image, lines, stroke, l.frame.area);
}

void paint_bar(Image& image, const FieldPicture& p, const Layout& l) {
  const auto table = colour_table(p.map, kColours);
  const PixelRect b = l.bar;
  const int steps = static_cast<int>(l.bar_below ? b.x1 - b.x0 : b.y1 - b.y0);
  for (int k = 0; k < steps; ++k) {
    const Rgb c = colour_at(table, (k + 0.5) / steps);
    if (l.bar_below)
      fill_rect(image, {b.x0 + k, b.y0, b.x0 + k + 1, b.y1}, c);
    else
      fill_rect(image, {b.x0, b.y1 - k - 1, b.x1, b.y1 - k}, c);
  }
  draw_frame(image, {b.x0 + 0.5, b.y0 + 0.5, b.x1 - 0.5, b.y1 - 0.5}, kPictureStyle.ink);
}

void label_bar(Image& image, const FieldPicture& p, const Layout& l) {
  const PixelRect b = l.bar;
  TextStyle style{.size = kPictureStyle.text, .colour = kPictureStyle.ink};
  double widest = 0;
  for (std::size_t k = 0; k < l.colour_ticks.at.size(); ++k) {
    const double t = l.colours.fraction(l.colour_ticks.at[k]);
    const std::string& label = l.colour_ticks.labels[k];
    widest = std::max(widest, text_width(label, style.size));
    if (l.bar_below) {
      const double x = std::floor(b.x0 + t * (b.x1 - b.x0 - 1)) + 0.5;
      fill_rect(image, {x - 0.5, b.y1, x + 0.5, b.y1 + 6}, style.colour);
      style.horizontal = HorizontalAnchor::centre, style.vertical = VerticalAnchor::top;
      draw_text(image, {x, b.y1 + 14}, label, style);
    } else {
      const double y = std::floor(b.y1 - 1 - t * (b.y1 - b.y0 - 1)) + 0.5;
      fill_rect(image, {b.x1, y - 0.5, b.x1 + 6, y + 0.5}, style.colour);
      style.horizontal = HorizontalAnchor::left, style.vertical = VerticalAnchor::middle;
      draw_text(image, {b.x1 + 13, y}, label, style);
    }
  }
  style.horizontal = HorizontalAnchor::centre;
  style.vertical = l.bar_below ? VerticalAnchor::baseline : VerticalAnchor::top;
  style.upwards = !l.bar_below;
  const Point2 place = l.bar_below ? Point2{0.5 * (b.x0 + b.x1), b.y1 + bottom_margin() - 16}
                                   : Point2{b.x1 + 13 + widest + 16, 0.5 * (b.y0 + b.y1)};
  draw_text(image, place, title_with_exponent(p.label, l.colour_ticks), style);
}

void check(const FieldPicture& p) {
  require(p.nx > 0 && p.ny > 0 && p.dx > 0 && p.dy > 0, "a field picture has cells of positive size");
  const std::size_t count = static_cast<std::size_t>(p.nx) * static_cast<std::size_t>(p.ny);
  require(p.values.size() == count, "a field picture has nx * ny values");
  require(p.level_set.empty() || p.level_set.size() == count, "a level set has nx * ny values");
}

}  // namespace

Image field_picture(const FieldPicture& picture) {
  check(picture);
  const Layout l = layout_of(picture);
  Image image = make_image(l.width, l.height, kPictureStyle.page);
  paint_field(image, picture, l);
  draw_outlines(image, picture, l, picture.mesh_lines, {.colour = {40, 44, 52}, .width = 1.0, .alpha = 0.28});
  draw_outlines(image, picture, l, picture.outlines, {.colour = {24, 26, 30}, .width = 2.2});
  draw_outlines(image, picture, l, picture.references, {.colour = {240, 110, 30}, .width = 1.8});
  draw_axes(image, l.frame);
  paint_bar(image, picture, l);
  label_bar(image, picture, l);
  draw_heading(image, l.frame.area, picture.title, picture.note);
  return image;
}

}  // namespace recoil
