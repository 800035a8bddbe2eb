#include "picture/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace recoil {
namespace {

unsigned char mixed(unsigned char below, unsigned char above, double cover) {
  return static_cast<unsigned char>(std::lround(below + (above - below) * cover));
}

void blend(Image& image, int i, int j, Rgb colour, double cover) {
  const std::size_t o = image.offset(i, j);
  image.rgb[o] = mixed(image.rgb[o], colour.r, cover);
  image.rgb[o + 1] = mixed(image.rgb[o + 1], colour.g, cover);
  image.rgb[o + 2] = mixed(image.rgb[o + 2], colour.b, cover);
}

/// Whole pixels touched by a rectangle, cut to the picture: [i0, i1) x [j0, j1).
struct PixelBox {
  int i0 = 0, j0 = 0, i1 = 0, j1 = 0;
  bool empty() const { return i1 <= i0 || j1 <= j0; }
};

PixelBox box_of(const PixelRect& rect, const Image& image) {
  const auto low = [](double v, int size) {
    return static_cast<int>(std::clamp(std::floor(v), 0.0, 1.0 * size));
  };
  const auto high = [](double v, int size) {
    return static_cast<int>(std::clamp(std::ceil(v), 0.0, 1.0 * size));
  };
  return {low(rect.x0, image.width), low(rect.y0, image.height), high(rect.x1, image.width),
          high(rect.y1, image.height)};
}

/// How much of each pixel of a box the lines cover, the largest over all of them.
struct Coverage {
  PixelBox box;
  std::vector<float> values;

  explicit Coverage(const PixelBox& b)
      : box(b), values(static_cast<std::size_t>(b.i1 - b.i0) * static_cast<std::size_t>(b.j1 - b.j0), 0.0f) {}
  float& at(int i, int j) {
    return values[static_cast<std::size_t>(j - box.j0) * static_cast<std::size_t>(box.i1 - box.i0) +
                  static_cast<std::size_t>(i - box.i0)];
  }
};

double distance_to_segment(Point2 p, Point2 a, Point2 b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  const double t = length2 > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// Adds one segment with round ends. Each row of pixels visits only the stretch near the segment, so a
/// long diagonal costs its length and not the area around it.
void cover_segment(Coverage& cover, Point2 a, Point2 b, double width) {
  const double radius = 0.5 * std::max(width, 1.0);
  const double strength = std::min(width, 1.0);  // a hairline is fainter, not thinner
  const double reach = radius + 0.5;
  if (a.y > b.y) std::swap(a, b);
  const int j0 = std::max(cover.box.j0, static_cast<int>(std::floor(std::max(a.y - reach, -1e6))));
  const int j1 = std::min(cover.box.j1, static_cast<int>(std::ceil(std::min(b.y + reach, 1e6))));
  for (int j = j0; j < j1; ++j) {
    const double y = j + 0.5;
    double xa = a.x, xb = b.x;
    if (b.y - a.y > 1e-9) {
      const double slope = (b.x - a.x) / (b.y - a.y);
      xa = a.x + slope * (std::clamp(y - reach, a.y, b.y) - a.y);
      xb = a.x + slope * (std::clamp(y + reach, a.y, b.y) - a.y);
    }
    if (xa > xb) std::swap(xa, xb);
    const int i0 = std::max(cover.box.i0, static_cast<int>(std::floor(std::max(xa - reach, -1e6))));
    const int i1 = std::min(cover.box.i1, static_cast<int>(std::ceil(std::min(xb + reach, 1e6))));
    for (int i = i0; i < i1; ++i) {
      const double c = std::clamp(reach - distance_to_segment({i + 0.5, y}, a, b), 0.0, 1.0) * strength;
      float& old = cover.at(i, j);
      old = std::max(old, static_cast<float>(c));
    }
  }
}

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

/// Cuts the visible part of a segment into dashes. @param phase length along the line before it.
void cover_dashes(Coverage& cover, Point2 a, Point2 b, const Stroke& stroke, double phase, double t0,
                  double t1) {
  double period = 0;
  for (const double part : stroke.dash) period += part;
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (!(period > 0.5) || !(length > 0)) return cover_segment(cover, a, b, stroke.width);
  double start = phase + t0 * length;  // along the whole line
  const double end = phase + t1 * length;
  double base = std::floor(start / period) * period;
  for (; base < end; base += period) {
    double from = base;
    for (std::size_t k = 0; k < stroke.dash.size(); ++k) {
      const double to = from + stroke.dash[k];
      const double lo = std::max(from, start), hi = std::min(to, end);
      if (k % 2 == 0 && lo < hi)
        cover_segment(cover, between(a, b, (lo - phase) / length), between(a, b, (hi - phase) / length),
                      stroke.width);
      from = to;
    }
  }
}

void cover_line(Coverage& cover, const Polyline& line, const Stroke& stroke, const PixelRect& visible) {
  const auto finite = [](Point2 p) { return std::isfinite(p.x) && std::isfinite(p.y); };
  if (line.size() == 1 && finite(line[0])) cover_segment(cover, line[0], line[0], stroke.width);
  double phase = 0;
  for (std::size_t k = 1; k < line.size(); ++k) {
    const Point2 a = line[k - 1], b = line[k];
    if (!finite(a) || !finite(b)) {
      phase = 0;
      continue;
    }
    double t0 = 0, t1 = 1;
    if (clip_segment(a, b, visible, t0, t1)) {
      if (stroke.dash.empty())
        cover_segment(cover, between(a, b, t0), between(a, b, t1), stroke.width);
      else
        cover_dashes(cover, a, b, stroke, phase, t0, t1);
    }
    phase += std::hypot(b.x - a.x, b.y - a.y);
  }
}

/// Smallest rectangle around the lines, with room for their width, inside `clip`.
PixelRect extent(std::span<const Polyline> lines, double margin, const PixelRect& clip) {
  PixelRect r{clip.x1, clip.y1, clip.x0, clip.y0};
  for (const auto& line : lines)
    for (const Point2& p : line) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
      r = {std::min(r.x0, p.x - margin), std::min(r.y0, p.y - margin), std::max(r.x1, p.x + margin),
           std::max(r.y1, p.y + margin)};
    }
  return {std::max(r.x0, clip.x0), std::max(r.y0, clip.y0), std::min(r.x1, clip.x1), std::min(r.y1, clip.y1)};
}

}  // namespace

PixelRect bounds(const Image& image) { return {0, 0, 1.0 * image.width, 1.0 * image.height}; }

void fill_rect(Image& image, const PixelRect& rect, Rgb colour, double alpha) {
  const PixelBox box = box_of(rect, image);
  for (int j = box.j0; j < box.j1; ++j) {
    const double cover_y = std::min(j + 1.0, rect.y1) - std::max(1.0 * j, rect.y0);
    for (int i = box.i0; i < box.i1; ++i) {
      const double cover_x = std::min(i + 1.0, rect.x1) - std::max(1.0 * i, rect.x0);
      blend(image, i, j, colour, std::clamp(cover_x * cover_y * alpha, 0.0, 1.0));
    }
  }
}

void draw_frame(Image& image, const PixelRect& r, Rgb colour, double width) {
  const double h = 0.5 * width;
  fill_rect(image, {r.x0 - h, r.y0 - h, r.x1 + h, r.y0 + h}, colour);
  fill_rect(image, {r.x0 - h, r.y1 - h, r.x1 + h, r.y1 + h}, colour);
  fill_rect(image, {r.x0 - h, r.y0 + h, r.x0 + h, r.y1 - h}, colour);
  fill_rect(image, {r.x1 - h, r.y0 + h, r.x1 + h, r.y1 - h}, colour);
}

void draw_polylines(Image& image, std::span<const Polyline> lines, const Stroke& stroke,
                    const PixelRect& clip) {
  const double margin = 0.5 * stroke.width + 1.0;
  const PixelBox box = box_of(extent(lines, margin, clip), image);
  if (box.empty()) return;
  Coverage cover(box);
  const PixelRect visible{box.i0 - margin, box.j0 - margin, box.i1 + margin, box.j1 + margin};
  for (const auto& line : lines) cover_line(cover, line, stroke, visible);
  for (int j = box.j0; j < box.j1; ++j)
    for (int i = box.i0; i < box.i1; ++i)
      if (const float c = cover.at(i, j); c > 0) blend(image, i, j, stroke.colour, c * stroke.alpha);
}

void draw_polyline(Image& image, const Polyline& line, const Stroke& stroke, const PixelRect& clip) {
  draw_polylines(image, std::span(&line, 1), stroke, clip);
}

void fill_circle(Image& image, Point2 centre, double radius, Rgb colour, const PixelRect& clip) {
  draw_polyline(image, {centre}, {.colour = colour, .width = 2 * radius}, clip);
}

}  // namespace recoil
