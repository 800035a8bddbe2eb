#include "picture/line_chart.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "core/error.hpp"
#include "picture/frame.hpp"
#include "picture/text.hpp"

namespace recoil {
namespace {

/// Told apart also by people who see few colours: they differ in lightness as well.
constexpr Rgb kPalette[] = {{14, 98, 174},  {212, 64, 52},  {30, 140, 84}, {232, 146, 20},
                            {118, 72, 160}, {20, 158, 168}, {150, 86, 50}, {220, 110, 160}};

Rgb colour_of(const LineChart& chart, std::size_t which) {
  if (chart.series[which].style.colour) return *chart.series[which].style.colour;
  std::size_t place = 0;  // styled series use up no colour of the palette
  for (std::size_t k = 0; k < which; ++k)
    if (!chart.series[k].style.colour) ++place;
  return kPalette[place % std::size(kPalette)];
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

Polyline pixels_of(const Frame& frame, const Series& series) {
  Polyline line;
  line.reserve(series.x.size());
  for (std::size_t k = 0; k < series.x.size(); ++k) line.push_back(frame.pixel(series.x[k], series.y[k]));
  return line;
}

void draw_series(Image& image, const Frame& frame, const Series& series, Rgb colour) {
  const Polyline line = pixels_of(frame, series);
  const double margin = 0.5 * series.style.width;
  const PixelRect clip{frame.area.x0, frame.area.y0 - margin, frame.area.x1, frame.area.y1 + margin};
  if (series.style.pattern != LinePattern::none)
    draw_polyline(image, line, stroke_of(series.style, colour), clip);
  if (!series.style.markers) return;
  for (const Point2& p : line) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    fill_circle(image, p, 2.2 * series.style.width + 1.5, kPictureStyle.page, frame.area);
    fill_circle(image, p, 2.2 * series.style.width, colour, frame.area);
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

void draw_guide_lines(Image& image, const LineChart& chart, const Frame& f) {
  const Stroke stroke{.colour = kPictureStyle.soft_ink, .width = 1.4, .dash = {3, 4}};
  for (const auto& guide : chart.guides) {
    const Point2 at = guide.vertical ? f.pixel(guide.at, f.y.lo) : f.pixel(f.x.lo, guide.at);
    const Polyline line = guide.vertical ? Polyline{{at.x, f.area.y0}, {at.x, f.area.y1}}
                                         : Polyline{{f.area.x0, at.y}, {f.area.x1, at.y}};
    draw_polyline(image, line, stroke, f.area);
  }
}

/// Writes beside each guide, at that end and on that side of it where the curves leave most room.
void label_guides(Image& image, const LineChart& chart, const Frame& f, const std::vector<Polyline>& lines) {
  constexpr double kSize = 17, kHeight = 0.7 * kSize, kOff = 7;
  for (const auto& guide : chart.guides) {
    const double width = text_width(guide.label, kSize);
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
    const Point2 start = guide.vertical ? Point2{best.x1, best.y1} : Point2{best.x0, best.y1};
    draw_text(image, start, guide.label,
              {.size = kSize, .colour = kPictureStyle.soft_ink, .upwards = guide.vertical});
  }
}

constexpr double kLegendRow = 30, kLegendSample = 44;

PixelRect legend_place(const LineChart& chart, const Frame& f, const std::vector<Polyline>& lines) {
  double text = 0, rows = 0;
  for (const auto& s : chart.series) {
    if (s.label.empty()) continue;
    text = std::max(text, text_width(s.label, kPictureStyle.text - 1));
    rows += 1;
  }
  if (rows == 0) return {};
  const double w = 14 + kLegendSample + 12 + text + 16, h = rows * kLegendRow + 12, gap = 16;
  const PixelRect a = f.area;
  const double xs[] = {a.x1 - gap - w, a.x0 + gap, 0.5 * (a.x0 + a.x1 - w)};
  const double ys[] = {a.y0 + gap, a.y1 - gap - h, 0.5 * (a.y0 + a.y1 - h)};
  PixelRect best{};
  double least = 1e300;
  for (const double y : ys)
    for (const double x : xs) {
      const PixelRect r{std::floor(x), std::floor(y), std::floor(x + w), std::floor(y + h)};
      const double hidden = curve_inside(lines, {r.x0 - 6, r.y0 - 6, r.x1 + 6, r.y1 + 6});
      if (hidden < least) least = hidden, best = r;
    }
  return best;
}

void draw_legend(Image& image, const LineChart& chart, const PixelRect& box) {
  if (box.x1 <= box.x0) return;
  fill_rect(image, box, kPictureStyle.page, 0.88);
  draw_frame(image, {box.x0 + 0.5, box.y0 + 0.5, box.x1 - 0.5, box.y1 - 0.5}, {200, 204, 210});
  double y = box.y0 + 6 + 0.5 * kLegendRow;
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const auto& s = chart.series[k];
    if (s.label.empty()) continue;
    const Rgb colour = colour_of(chart, k);
    const double x = box.x0 + 14;
    if (s.style.pattern != LinePattern::none)
      draw_polyline(image, {{x, y}, {x + kLegendSample, y}}, stroke_of(s.style, colour), box);
    if (s.style.markers) fill_circle(image, {x + 0.5 * kLegendSample, y}, 2.2 * s.style.width, colour, box);
    draw_text(
        image, {x + kLegendSample + 12, y}, s.label,
        {.size = kPictureStyle.text - 1, .colour = kPictureStyle.ink, .vertical = VerticalAnchor::middle});
    y += kLegendRow;
  }
}

}  // namespace

Image line_chart(const LineChart& chart) {
  for (const auto& s : chart.series) require(s.x.size() == s.y.size(), "x and y of a series have one size");
  Image image = make_image(chart.width, chart.height, kPictureStyle.page);
  const Frame frame = frame_of(chart);
  draw_grid(image, frame);
  draw_guide_lines(image, chart, frame);
  std::vector<Polyline> lines;
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    draw_series(image, frame, chart.series[k], colour_of(chart, k));
    lines.push_back(pixels_of(frame, chart.series[k]));
  }
  label_guides(image, chart, frame, lines);
  draw_axes(image, frame);
  draw_legend(image, chart, legend_place(chart, frame, lines));
  draw_heading(image, frame.area, chart.title, chart.note);
  return image;
}

}  // namespace recoil
