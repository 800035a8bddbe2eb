#include "picture/colour_key.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "picture/frame.hpp"
#include "picture/text.hpp"

namespace recoil {
namespace {

constexpr double kBarWidth = 22, kBarGap = 24, kTick = 6, kLabelGap = 7, kTip = 18;
constexpr int kColours = 1024;
constexpr double kDecades = 6;  // of logarithmic colours, unless a range is given
constexpr double kSwatch = 20, kRow = 30, kItemGap = 26;

TextStyle ink_style() { return {.size = kPictureStyle.text, .colour = kPictureStyle.ink}; }

constexpr int fewest_ticks = 2, most_ticks = 8;  // of a vertical bar

Ticks ticks_of(const ColourKey& key, double length) {
  const int upright = std::clamp(static_cast<int>(length / 80), fewest_ticks, most_ticks);
  return nice_ticks(key.colours.shown, key.horizontal ? 6 : upright);
}

/// The bar along its own axis: t from 0 at the low end to 1 at the high one, s across it.
struct Bar {
  PixelRect r;  // without the tips
  bool horizontal;

  Point2 at(double t, double s) const {
    return horizontal ? Point2{r.x0 + t * (r.x1 - r.x0), r.y0 + s * (r.y1 - r.y0)}
                      : Point2{r.x0 + s * (r.x1 - r.x0), r.y1 - t * (r.y1 - r.y0)};
  }
  double length() const { return horizontal ? r.x1 - r.x0 : r.y1 - r.y0; }
};

double value_at(const AxisScale& scale, double t) {
  return scale.log ? scale.lo * std::pow(scale.hi / scale.lo, t) : scale.lo + t * (scale.hi - scale.lo);
}

/// The bar, pointed at an end beyond which there are values.
void paint_bar(Canvas& canvas, const Colours& colours, const Bar& bar) {
  constexpr int steps = 256;
  Image image(bar.horizontal ? steps : 1, bar.horizontal ? 1 : steps);
  for (int k = 0; k < steps; ++k)
    image.set(bar.horizontal ? k : 0, bar.horizontal ? 0 : steps - 1 - k,
              colours.at(value_at(colours.shown, (k + 0.5) / steps)));
  // The tips reach under the bar, so that no seam shows.
  const double tip = kTip / bar.length(), under = 1 / bar.length();
  Polyline edge{bar.at(0, 0)};
  if (colours.below) {
    fill_polygon(canvas, {bar.at(under, 0), bar.at(0, 0), bar.at(-tip, 0.5), bar.at(0, 1), bar.at(under, 1)},
                 colours.at(colours.shown.lo));
    edge.push_back(bar.at(-tip, 0.5));
  }
  edge.push_back(bar.at(0, 1));
  edge.push_back(bar.at(1, 1));
  if (colours.above) {
    fill_polygon(
        canvas,
        {bar.at(1 - under, 0), bar.at(1, 0), bar.at(1 + tip, 0.5), bar.at(1, 1), bar.at(1 - under, 1)},
        colours.at(colours.shown.hi));
    edge.push_back(bar.at(1 + tip, 0.5));
  }
  edge.push_back(bar.at(1, 0));
  edge.push_back(bar.at(0, 0));
  draw_image(canvas, image, bar.r);
  draw_polyline(canvas, edge, {.colour = kPictureStyle.ink, .width = 1}, canvas.bounds());
}

void label_bar(Canvas& canvas, const ColourKey& key, const Bar& bar) {
  const Ticks ticks = ticks_of(key, bar.length());
  TextStyle style = ink_style();
  double widest = 0, free_from = -1e30;
  for (std::size_t k = 0; k < ticks.at.size(); ++k) {
    const Point2 p = bar.at(key.colours.shown.fraction(ticks.at[k]), 1);
    const double width = text_width(ticks.labels[k], style.size);
    widest = std::max(widest, width);
    if (key.horizontal) {
      const double x = std::floor(p.x) + 0.5;
      fill_rect(canvas, {x - 0.5, p.y, x + 0.5, p.y + kTick}, style.colour);
      if (x - 0.5 * width < free_from) continue;
      free_from = x + 0.5 * width + 8;
      style.horizontal = HorizontalAnchor::centre, style.vertical = VerticalAnchor::top;
      draw_text(canvas, {x, p.y + kTick + kLabelGap}, ticks.labels[k], style);
    } else {
      const double y = std::floor(p.y) + 0.5;
      fill_rect(canvas, {p.x, y - 0.5, p.x + kTick, y + 0.5}, style.colour);
      style.vertical = VerticalAnchor::middle;
      draw_text(canvas, {p.x + kTick + kLabelGap, y}, ticks.labels[k], style);
    }
  }
  style.horizontal = HorizontalAnchor::centre;
  style.vertical = key.horizontal ? VerticalAnchor::baseline : VerticalAnchor::top;
  style.upwards = !key.horizontal;
  const Point2 middle = bar.at(0.5, 1);
  draw_text(canvas,
            key.horizontal ? Point2{middle.x, middle.y + bottom_margin() - 16}
                           : Point2{middle.x + kTick + kLabelGap + widest + 14, middle.y},
            title_with_exponent(key.label, ticks), style);
}

double item_width(const Category& category) {
  return kSwatch + 10 + text_width(category.name, kPictureStyle.text);
}

/// Rows of categories that fit below a field of that width.
std::vector<std::vector<Category>> rows_of(const ColourKey& key, double width) {
  std::vector<std::vector<Category>> rows(1);
  double used = 0;
  for (const Category& c : key.colours.categories) {
    if (!rows.back().empty() && used + kItemGap + item_width(c) > width) {
      rows.emplace_back();
      used = 0;
    }
    used += (rows.back().empty() ? 0 : kItemGap) + item_width(c);
    rows.back().push_back(c);
  }
  return rows;
}

void draw_item(Canvas& canvas, const Category& c, double x, double y) {
  const PixelRect box{x + 0.5, y + 0.5, x + kSwatch - 0.5, y + kSwatch - 0.5};
  fill_rect(canvas, box, c.colour);
  draw_frame(canvas, box, kPictureStyle.ink);
  TextStyle style = ink_style();
  style.vertical = VerticalAnchor::middle;
  draw_text(canvas, {x + kSwatch + 10, y + 0.5 * kSwatch}, c.name, style);
}

void draw_categories(Canvas& canvas, const ColourKey& key, const PixelRect& area, double below) {
  if (!key.horizontal) {
    double y = std::floor(area.y0);
    TextStyle style = ink_style();
    style.vertical = VerticalAnchor::top;
    if (!key.label.empty()) {
      draw_text(canvas, {area.x1 + kBarGap, y + 3}, key.label, style);
      y += kRow;
    }
    for (const Category& c : key.colours.categories) {
      draw_item(canvas, c, std::floor(area.x1 + kBarGap), y);
      y += kRow;
    }
    return;
  }
  double y = std::floor(area.y1 + below);
  for (const auto& row : rows_of(key, area.x1 - area.x0)) {
    double width = -kItemGap;
    for (const Category& c : row) width += kItemGap + item_width(c);
    double x = std::floor(0.5 * (area.x0 + area.x1 - width));
    for (const Category& c : row) {
      draw_item(canvas, c, x, y);
      x += std::floor(item_width(c) + kItemGap);
    }
    y += kRow;
  }
}

}  // namespace

Colours colours_of(const std::vector<double>& values, const ColourChoice& choice) {
  Colours c{colour_table(choice.map, kColours), {}, {}, choice.categories};
  Range all, range;
  for (const double v : values) all.include(v);
  if (choice.range) {
    range.include(choice.range->first, choice.log);
    range.include(choice.range->second, choice.log);
  } else {
    for (const double v : values) range.include(v, choice.log);
    if (choice.log && !range.empty()) range.lo = std::max(range.lo, range.hi * std::pow(10, -kDecades));
  }
  const bool centred = choice.map == ColourMap::diverging && !choice.log && !range.empty();
  const double largest = std::max(std::abs(range.lo), std::abs(range.hi));
  if (centred && !choice.range) range = {-largest, largest};
  c.shown = c.mapped = axis_around(range, 0, choice.log);
  if (centred && largest > 0) c.mapped = {-largest, largest};  // the pale middle means zero
  const double slack = 1e-9 * (c.shown.hi - c.shown.lo);
  c.below = all.lo < c.shown.lo - slack;
  c.above = all.hi > c.shown.hi + slack;
  return c;
}

Rgb Colours::at(double value) const {
  if (std::isnan(value)) return kPictureStyle.void_space;
  if (categories.empty()) {
    const double inside = std::clamp(value, shown.lo, shown.hi);
    return colour_at(table, mapped.fraction(inside));
  }
  for (const Category& c : categories)
    if (c.value == value) return c.colour;
  return kPictureStyle.void_space;
}

double key_width(const ColourKey& key) {
  double widest = 0;
  if (key.colours.categories.empty()) {
    for (int n = fewest_ticks; n <= most_ticks; ++n)  // the length of the bar is not known yet
      for (const auto& label : nice_ticks(key.colours.shown, n).labels)
        widest = std::max(widest, text_width(label, kPictureStyle.text));
    return std::ceil(kBarGap + kBarWidth + kTick + kLabelGap + widest + 14 + kPictureStyle.text + 12);
  }
  widest = text_width(key.label, kPictureStyle.text);
  for (const Category& c : key.colours.categories) widest = std::max(widest, item_width(c));
  return std::ceil(kBarGap + widest + 20);
}

double key_height(const ColourKey& key, double width) {
  if (key.colours.categories.empty()) return kBarWidth + bottom_margin() + 8;
  return kRow * static_cast<double>(rows_of(key, width).size()) + 10;
}

void draw_key(Canvas& canvas, const ColourKey& key, const PixelRect& a, double below) {
  if (!key.colours.categories.empty()) return draw_categories(canvas, key, a, below);
  const double low = key.colours.below ? kTip : 0, high = key.colours.above ? kTip : 0;
  Bar bar{{}, key.horizontal};
  if (key.horizontal) {
    const double width = std::floor(std::min(0.72 * (a.x1 - a.x0), 620.0));
    const double x = std::floor(0.5 * (a.x0 + a.x1 - width)) + 0.5, y = std::floor(a.y1 + below) + 0.5;
    bar.r = {x + low, y, x + width - high, y + kBarWidth};
  } else {
    const double x = std::floor(a.x1 + kBarGap) + 0.5;
    bar.r = {x, std::floor(a.y0) + 0.5 + high, x + kBarWidth, std::floor(a.y1) + 0.5 - low};
  }
  paint_bar(canvas, key.colours, bar);
  label_bar(canvas, key, bar);
}

}  // namespace recoil
