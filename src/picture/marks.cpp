#include "picture/marks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "picture/frame.hpp"
#include "picture/text.hpp"

namespace recoil {

namespace {

constexpr Rgb gauge_colour{206, 32, 92}, arrow_colour{20, 22, 26}, halo{255, 255, 255};
constexpr double label_size = 16, dot_radius = 5.5, shortest_arrow = 8;

bool apart(const PixelRect& a, const PixelRect& b) {
  return a.x1 <= b.x0 || b.x1 <= a.x0 || a.y1 <= b.y0 || b.y1 <= a.y0;
}

void draw_arrow_of(Canvas& canvas, const Mark& m, const PixelRect& area) {
  const double length = std::hypot(m.way.x, m.way.y), ux = m.way.x / length, uy = m.way.y / length;
  const double head = std::min(17.0, 0.6 * length);
  for (const double more : {2.0, 0.0}) {
    const Rgb colour = more > 0 ? halo : arrow_colour;
    const Point2 tip{m.at.x + m.way.x + 1.5 * more * ux, m.at.y + m.way.y + 1.5 * more * uy};
    const Point2 neck{m.at.x + m.way.x - (head + more) * ux, m.at.y + m.way.y - (head + more) * uy};
    const double wide = 0.38 * head + more;
    draw_polyline(canvas, {m.at, neck}, {.colour = colour, .width = 3.6 + 2 * more}, area);
    fill_polygon(canvas,
                 {tip, {neck.x - wide * uy, neck.y + wide * ux}, {neck.x + wide * uy, neck.y - wide * ux}},
                 colour);
  }
}

void draw_dot(Canvas& canvas, const Mark& m, const PixelRect& area) {
  const Rgb colour = m.arrow ? arrow_colour : gauge_colour;
  fill_circle(canvas, m.at, dot_radius + 2, halo, area);
  fill_circle(canvas, m.at, dot_radius, colour, area);
  if (m.behind || m.arrow) fill_circle(canvas, m.at, dot_radius - 2.2, halo, area);
  if (m.arrow) fill_circle(canvas, m.at, 1.6, colour, area);
}

/// The place of the label: beside the mark's end, where nothing is yet.
PixelRect place_of(const Mark& m, const PixelRect& area, const std::vector<PixelRect>& taken) {
  const double width = text_width(m.label, label_size), height = label_size;
  const double away = dot_radius + 5;
  const Point2 end{m.at.x + (m.arrow ? m.way.x : 0), m.at.y + (m.arrow ? m.way.y : 0)};
  const std::array<Point2, 4> corners{{{end.x + away, end.y - 0.5 * height},
                                       {end.x - away - width, end.y - 0.5 * height},
                                       {end.x - 0.5 * width, end.y - away - height},
                                       {end.x - 0.5 * width, end.y + away}}};
  const auto rect = [&](Point2 p) {
    p.x = std::clamp(p.x, area.x0 + 2, std::max(area.x0 + 2, area.x1 - width - 2));
    p.y = std::clamp(p.y, area.y0 + 2, std::max(area.y0 + 2, area.y1 - height - 2));
    return PixelRect{p.x, p.y, p.x + width, p.y + height};
  };
  for (const Point2& p : corners) {
    const PixelRect r = rect(p);
    if (std::ranges::all_of(taken, [&](const PixelRect& t) { return apart(r, t); })) return r;
  }
  return rect(corners.front());
}

void draw_label(Canvas& canvas, const Mark& m, const PixelRect& r) {
  TextStyle style{.size = label_size, .colour = halo, .vertical = VerticalAnchor::middle, .bold = m.arrow};
  const Point2 at{r.x0, 0.5 * (r.y0 + r.y1)};
  for (int k = 0; k < 12; ++k) {
    const double angle = k * 0.5235987755982988;  // 30 degrees
    draw_text(canvas, {at.x + 2 * std::cos(angle), at.y + 2 * std::sin(angle)}, m.label, style);
  }
  style.colour = m.arrow ? arrow_colour : gauge_colour;
  draw_text(canvas, at, m.label, style);
}

}  // namespace

void draw_marks(Canvas& canvas, const std::vector<Mark>& marks, const PixelRect& area) {
  std::vector<PixelRect> taken;
  for (const Mark& m : marks) {
    if (m.arrow && std::hypot(m.way.x, m.way.y) >= shortest_arrow)
      draw_arrow_of(canvas, m, area);
    else
      draw_dot(canvas, m, area);
    taken.push_back({m.at.x - dot_radius, m.at.y - dot_radius, m.at.x + dot_radius, m.at.y + dot_radius});
  }
  for (const Mark& m : marks) {
    taken.push_back(place_of(m, area, taken));
    draw_label(canvas, m, taken.back());
  }
}

}  // namespace recoil
