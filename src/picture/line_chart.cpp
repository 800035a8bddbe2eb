#include "picture/line_chart.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/error.hpp"
#include "picture/colour_map.hpp"
#include "picture/frame.hpp"
#include "picture/text.hpp"

namespace recoil {
namespace {

Rgb colour_of(const LineChart& chart, std::size_t which) {
  if (chart.series[which].style.colour) return *chart.series[which].style.colour;
  std::size_t place = 0;  // styled series use up no colour of the palette
  for (std::size_t k = 0; k < which; ++k)
    if (!chart.series[k].style.colour) ++place;
  return curve_colour(place);
}

Stroke stroke_of(const SeriesStyle& style, Rgb colour) {
  Stroke stroke{.colour = colour, .width = style.width};
  if (style.pattern == LinePattern::dashed) stroke.dash = {5.0 * style.width, 3.6 * style.width};
  if (style.pattern == LinePattern::dotted) stroke.dash = {0.1, 2.4 * style.width};
  return stroke;
}

AxisScale scale_of(const LineChart& chart, bool is_x) {
  const bool log = is_x ? chart.log_x : chart.log_y;
  const auto& fixed = is_x ? chart.x_range : chart.y_range;
  if (fixed)
    return axis_around({std::min(fixed->first, fixed->second), std::max(fixed->first, fixed->second)}, 0,
                       log);
  Range range;
  for (const auto& s : chart.series)
    for (const double v : is_x ? s.x : s.y) range.include(v, log);
  for (const auto& g : chart.guides)
    if (g.vertical == is_x) range.include(g.at, log);
  const bool points = std::ranges::any_of(chart.series, [](const Series& s) { return s.style.markers; });
  AxisScale scale = axis_around(range, is_x && !points ? 0.0 : 0.06, log);
  // An axis that ends just short of zero is easier to read from zero on.
  if (!log && range.lo >= 0 && scale.lo < 0) scale.lo = 0;
  return scale;
}

Frame frame_of(const LineChart& chart) {
  Frame frame;
  frame.x = scale_of(chart, true);
  frame.y = scale_of(chart, false);
  frame.x_title = chart.x_title;
  frame.y_title = chart.y_title;
  frame.y_ticks = nice_ticks(frame.y, std::max(2, chart.height / 120));
  frame.x_ticks = nice_ticks(frame.x, std::max(2, chart.width / 150));
  const double top = chart.title.empty() && chart.note.empty() ? 24 : 62;
  frame.area = {left_margin(frame.y_ticks), top, chart.width - 36.0, chart.height - bottom_margin()};
  return frame;
}

/// The points of the curve in the picture, without those that nobody could tell from the one before.
Polyline pixels_of(const Frame& frame, const Series& series) {
  constexpr double nearest = 0.2;  // pixels
  Polyline line;
  for (std::size_t k = 0; k < series.x.size(); ++k) {
    const Point2 p = frame.pixel(series.x[k], series.y[k]);
    const bool last = k + 1 == series.x.size();
    if (!last && !line.empty() && std::hypot(p.x - line.back().x, p.y - line.back().y) < nearest) continue;
    line.push_back(p);
  }
  return line;
}

void draw_series(Canvas& canvas, const Frame& frame, const Polyline& line, const SeriesStyle& style,
                 Rgb colour) {
  const double margin = 0.5 * style.width;
  const PixelRect clip{frame.area.x0, frame.area.y0 - margin, frame.area.x1, frame.area.y1 + margin};
  if (style.pattern != LinePattern::none) draw_polyline(canvas, line, stroke_of(style, colour), clip);
  if (!style.markers) return;
  for (const Point2& p : line) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    fill_circle(canvas, p, 2.2 * style.width + 1.5, kPictureStyle.page, frame.area);
    fill_circle(canvas, p, 2.2 * style.width, colour, frame.area);
  }
}

/// How much curve runs through the rectangle [pixels], to put the legend where it hides least.
double curve_inside(const std::vector<Polyline>& lines, const PixelRect& r) {
  double inside = 0;
  for (const auto& line : lines)
    for (std::size_t k = 0; k < line.size(); ++k) {
      const Point2 b = line[k], a = k > 0 ? line[k - 1] : b;
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      if (!std::isfinite(length)) continue;
      const int pieces = 1 + static_cast<int>(std::min(length / 6, 400.0));
      for (int n = 0; n < pieces; ++n) {
        const double t = (n + 1.0) / pieces;
        const Point2 p{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
        if (p.x > r.x0 && p.x < r.x1 && p.y > r.y0 && p.y < r.y1) inside += 0.5 + length / pieces;
      }
    }
  return inside;
}

/// A line around and through a rectangle, for curve_inside.
Polyline edge_of(const PixelRect& r) {
  return {{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}, {r.x0, r.y0}, {r.x1, r.y1}};
}

void draw_guide_lines(Canvas& canvas, const LineChart& chart, const Frame& f) {
  const Stroke stroke{.colour = kPictureStyle.soft_ink, .width = 1.4, .dash = {3, 4}};
  for (const auto& guide : chart.guides) {
    const Point2 at = guide.vertical ? f.pixel(guide.at, f.y.lo) : f.pixel(f.x.lo, guide.at);
    const Polyline line = guide.vertical ? Polyline{{at.x, f.area.y0}, {at.x, f.area.y1}}
                                         : Polyline{{f.area.x0, at.y}, {f.area.x1, at.y}};
    draw_polyline(canvas, line, stroke, f.area);
  }
}

constexpr double kGuideText = 16;

/// Where the labels of the guides stand: beside each, at that end and on that side of it where the curves and
/// the labels before leave most room.
std::vector<PixelRect> guide_label_places(const LineChart& chart, const Frame& f,
                                          std::vector<Polyline> lines) {
  constexpr double kHeight = 0.7 * kGuideText, kOff = 7;
  std::vector<PixelRect> places;
  for (const auto& guide : chart.guides) {
    const double width = text_width(guide.label, kGuideText);
    const Point2 at = guide.vertical ? f.pixel(guide.at, f.y.lo) : f.pixel(f.x.lo, guide.at);
    PixelRect best{};
    double least = 1e300;
    for (const bool first_end : {true, false})
      for (const bool first_side : {true, false}) {
        PixelRect r;
        if (guide.vertical) {
          r.x0 = first_side ? at.x + kOff : at.x - kOff - kHeight;
          r.y0 = first_end ? f.area.y0 + 12 : f.area.y1 - 12 - width;
          r.x1 = r.x0 + kHeight, r.y1 = r.y0 + width;
        } else {
          r.x0 = first_end ? f.area.x0 + 12 : f.area.x1 - 12 - width;
          r.y0 = first_side ? at.y - kOff - kHeight : at.y + kOff;
          r.x1 = r.x0 + width, r.y1 = r.y0 + kHeight;
        }
        const double hidden = curve_inside(lines, {r.x0 - 3, r.y0 - 3, r.x1 + 3, r.y1 + 3});
        if (hidden < least) least = hidden, best = r;
      }
    places.push_back(best);
    lines.push_back(edge_of(best));
  }
  return places;
}

void label_guides(Canvas& canvas, const LineChart& chart, const std::vector<PixelRect>& places) {
  for (std::size_t k = 0; k < places.size(); ++k) {
    const bool vertical = chart.guides[k].vertical;
    const PixelRect& r = places[k];
    draw_text(canvas, vertical ? Point2{r.x1, r.y1} : Point2{r.x0, r.y1}, chart.guides[k].label,
              {.size = kGuideText, .colour = kPictureStyle.soft_ink, .upwards = vertical});
  }
}

constexpr double kLegendRow = 28, kLegendSample = 42, kLegendGap = 14;

/// Size of the legend; 0 where no curve has a name.
Point2 legend_size(const LineChart& chart) {
  double text = 0, rows = 0;
  for (const auto& s : chart.series) {
    if (s.label.empty()) continue;
    text = std::max(text, text_width(s.label, kPictureStyle.text - 1));
    rows += 1;
  }
  if (rows == 0) return {};
  return {std::ceil(14 + kLegendSample + 12 + text + 16), rows * kLegendRow + 12};
}

/// Where the legend hides least of lines and labels: in a corner if it can, else at another place of the
/// plot.
PixelRect legend_place(Point2 size, const Frame& f, std::vector<Polyline> lines,
                       const std::vector<PixelRect>& labels, double& least) {
  for (const PixelRect& r : labels) lines.push_back(edge_of(r));
  const PixelRect a = f.area;
  const double left = a.x0 + kLegendGap, top = a.y0 + kLegendGap;
  const double room_x = a.x1 - a.x0 - 2 * kLegendGap - size.x, room_y = a.y1 - a.y0 - 2 * kLegendGap - size.y;
  PixelRect best{};
  least = 1e300;
  const double shares[] = {1, 0, 0.5, 0.25, 0.75};
  for (const double v : {0.0, 1.0, 0.5, 0.25, 0.75})
    for (const double u : shares) {
      const double x = std::floor(left + u * room_x), y = std::floor(top + v * room_y);
      const PixelRect r{x, y, x + size.x, y + size.y};
      const double hidden = curve_inside(lines, {r.x0 - 8, r.y0 - 8, r.x1 + 8, r.y1 + 8});
      if (hidden < least) least = hidden, best = r;
    }
  if (room_x < 0 || room_y < 0) least = 1e300;
  return best;
}

void draw_legend(Canvas& canvas, const LineChart& chart, const PixelRect& box) {
  if (box.x1 <= box.x0) return;
  fill_rect(canvas, box, kPictureStyle.page, 0.88);
  draw_frame(canvas, {box.x0 + 0.5, box.y0 + 0.5, box.x1 - 0.5, box.y1 - 0.5}, {200, 204, 210});
  double y = box.y0 + 6 + 0.5 * kLegendRow;
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const auto& s = chart.series[k];
    if (s.label.empty()) continue;
    const Rgb colour = colour_of(chart, k);
    const double x = box.x0 + 14;
    if (s.style.pattern != LinePattern::none)
      draw_polyline(canvas, {{x, y}, {x + kLegendSample, y}}, stroke_of(s.style, colour), box);
    if (s.style.markers) fill_circle(canvas, {x + 0.5 * kLegendSample, y}, 2.2 * s.style.width, colour, box);
    draw_text(
        canvas, {x + kLegendSample + 12, y}, s.label,
        {.size = kPictureStyle.text - 1, .colour = kPictureStyle.ink, .vertical = VerticalAnchor::middle});
    y += kLegendRow;
  }
}

}  // namespace

Canvas line_chart(const LineChart& chart) {
  for (const auto& s : chart.series) require(s.x.size() == s.y.size(), "x and y of a series have one size");
  Canvas canvas(chart.width, chart.height, kPictureStyle.page);
  Frame frame = frame_of(chart);
  const auto curves = [&] {
    std::vector<Polyline> lines;
    for (const Series& series : chart.series) lines.push_back(pixels_of(frame, series));
    return lines;
  };
  std::vector<Polyline> lines = curves();
  std::vector<PixelRect> labels = guide_label_places(chart, frame, lines);
  const Point2 size = legend_size(chart);
  double hidden = 0;
  PixelRect legend{};
  if (size.x > 0) legend = legend_place(size, frame, lines, labels, hidden);
  if (size.x > 0 && hidden > 0 && size.x < 0.4 * chart.width) {  // no place in the plot: beside it
    frame.area.x1 -= size.x + kLegendGap;
    lines = curves();
    labels = guide_label_places(chart, frame, lines);
    const double x = frame.area.x1 + kLegendGap + 12;
    legend = {x, frame.area.y0, x + size.x, frame.area.y0 + size.y};
  }
  draw_grid(canvas, frame);
  draw_guide_lines(canvas, chart, frame);
  for (std::size_t k = 0; k < chart.series.size(); ++k)
    draw_series(canvas, frame, lines[k], chart.series[k].style, colour_of(chart, k));
  label_guides(canvas, chart, labels);
  draw_axes(canvas, frame);
  draw_legend(canvas, chart, legend);
  draw_heading(canvas, frame.area, chart.title, chart.note);
  return canvas;
}

}  // namespace recoil
