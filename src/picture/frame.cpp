#include "picture/frame.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "picture/text.hpp"

namespace recoil {
namespace {

constexpr double kTickLength = 7, kGap = 8;

/// Marks sit on whole pixels so that they are crisp.
double crisp(double v) { return std::floor(v) + 0.5; }

TextStyle label_style(HorizontalAnchor h, VerticalAnchor v) {
  return {.size = kPictureStyle.text, .colour = kPictureStyle.ink, .horizontal = h, .vertical = v};
}

void draw_x_axis(Canvas& canvas, const Frame& f) {
  const Rgb ink = kPictureStyle.ink;
  for (const double v : f.x_ticks.minor) {
    const double x = crisp(f.pixel(v, f.y.lo).x);
    fill_rect(canvas, {x - 0.5, f.area.y1, x + 0.5, f.area.y1 + 0.6 * kTickLength}, ink);
  }
  double free_from = -1e30;  // labels that would touch the one before are left out
  for (std::size_t k = 0; k < f.x_ticks.at.size(); ++k) {
    const double x = crisp(f.pixel(f.x_ticks.at[k], f.y.lo).x);
    fill_rect(canvas, {x - 0.5, f.area.y1, x + 0.5, f.area.y1 + kTickLength}, ink);
    const double half = 0.5 * text_width(f.x_ticks.labels[k], kPictureStyle.text);
    if (x - half < free_from) continue;
    free_from = x + half + 10;
    draw_text(canvas, {x, f.area.y1 + kTickLength + kGap}, f.x_ticks.labels[k],
              label_style(HorizontalAnchor::centre, VerticalAnchor::top));
  }
  draw_text(canvas, {0.5 * (f.area.x0 + f.area.x1), f.area.y1 + bottom_margin() - 14},
            title_with_exponent(f.x_title, f.x_ticks),
            label_style(HorizontalAnchor::centre, VerticalAnchor::baseline));
}

void draw_y_axis(Canvas& canvas, const Frame& f) {
  const Rgb ink = kPictureStyle.ink;
  for (const double v : f.y_ticks.minor) {
    const double y = crisp(f.pixel(f.x.lo, v).y);
    fill_rect(canvas, {f.area.x0 - 0.6 * kTickLength, y - 0.5, f.area.x0, y + 0.5}, ink);
  }
  for (std::size_t k = 0; k < f.y_ticks.at.size(); ++k) {
    const double y = crisp(f.pixel(f.x.lo, f.y_ticks.at[k]).y);
    fill_rect(canvas, {f.area.x0 - kTickLength, y - 0.5, f.area.x0, y + 0.5}, ink);
    draw_text(canvas, {f.area.x0 - kTickLength - kGap, y}, f.y_ticks.labels[k],
              label_style(HorizontalAnchor::right, VerticalAnchor::middle));
  }
  TextStyle style = label_style(HorizontalAnchor::centre, VerticalAnchor::top);
  style.upwards = true;
  draw_text(canvas, {f.area.x0 - left_margin(f.y_ticks) + 14, 0.5 * (f.area.y0 + f.area.y1)},
            title_with_exponent(f.y_title, f.y_ticks), style);
}

}  // namespace

Point2 Frame::pixel(double x_value, double y_value) const {
  return {area.x0 + x.fraction(x_value) * (area.x1 - area.x0),
          area.y1 - y.fraction(y_value) * (area.y1 - area.y0)};
}

void draw_grid(Canvas& canvas, const Frame& f) {
  for (const double v : f.x_ticks.at) {
    const double x = crisp(f.pixel(v, f.y.lo).x);
    fill_rect(canvas, {x - 0.5, f.area.y0, x + 0.5, f.area.y1}, kPictureStyle.grid);
  }
  for (const double v : f.y_ticks.at) {
    const double y = crisp(f.pixel(f.x.lo, v).y);
    fill_rect(canvas, {f.area.x0, y - 0.5, f.area.x1, y + 0.5}, kPictureStyle.grid);
  }
}

void draw_axes(Canvas& canvas, const Frame& f) {
  const PixelRect edge{crisp(f.area.x0), crisp(f.area.y0), crisp(f.area.x1), crisp(f.area.y1)};
  draw_frame(canvas, edge, kPictureStyle.ink, 1.0);
  draw_x_axis(canvas, f);
  draw_y_axis(canvas, f);
}

double left_margin(const Ticks& y_ticks) {
  double widest = 0;
  for (const auto& label : y_ticks.labels) widest = std::max(widest, text_width(label, kPictureStyle.text));
  return std::ceil(14 + kPictureStyle.text + 12 + widest + kGap + kTickLength);
}

double bottom_margin() { return std::ceil(kTickLength + kGap + 2.5 * kPictureStyle.text + 10); }

void draw_heading(Canvas& canvas, const PixelRect& area, const std::string& title, const std::string& note) {
  constexpr double gap = 24, smallest = 15, line = 26;
  const double note_width = note.empty() ? 0 : text_width(note, kPictureStyle.text) + gap;
  const double whole = area.x1 - area.x0, wanted = text_width(title, kPictureStyle.title, true);
  const auto size_in = [&](double room) {  // a long title becomes smaller before it leaves the picture
    return std::clamp(kPictureStyle.title * room / std::max(1.0, wanted), 12.0, kPictureStyle.title);
  };
  const bool two_lines = size_in(whole - note_width) < smallest && note_width > 0;
  const double room = two_lines ? whole : whole - note_width, size = size_in(room), y = area.y0 - 18;
  draw_text(canvas, {area.x0, two_lines ? y - line : y}, shortened_text(title, room, size, true),
            {.size = size, .colour = kPictureStyle.ink, .bold = true});
  draw_text(canvas, {two_lines ? area.x0 : area.x1, y}, note,
            {.size = kPictureStyle.text,
             .colour = kPictureStyle.soft_ink,
             .horizontal = two_lines ? HorizontalAnchor::left : HorizontalAnchor::right});
}

}  // namespace recoil
