#include "picture/text.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "picture/stroke_font.hpp"

namespace recoil {
namespace {

/// One character in its place, in em units of the line.
struct Placed {
  char32_t code = 0;
  double x = 0, y = 0, scale = 1;
};

/// Takes one code point off the front; a broken byte becomes U+FFFD, which draws as a box.
char32_t take_code_point(std::string_view& text) {
  const auto lead = static_cast<unsigned char>(text.front());
  text.remove_prefix(1);
  if (lead < 0x80) return lead;
  const int more = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : lead >= 0xc0 ? 1 : 0;
  if (more == 0) return 0xfffd;
  auto code = static_cast<char32_t>(lead & (0x3f >> more));
  for (int k = 0; k < more; ++k) {
    if (text.empty() || (static_cast<unsigned char>(text.front()) & 0xc0) != 0x80) return 0xfffd;
    code = (code << 6) | static_cast<char32_t>(static_cast<unsigned char>(text.front()) & 0x3f);
    text.remove_prefix(1);
  }
  return code;
}

/// Sets the characters side by side. @param[out] width of the line [em].
std::vector<Placed> layout(std::string_view text, double& width) {
  constexpr double kRaise = 0.33, kShrink = 0.66, kTracking = 0.015;
  std::vector<Placed> line;
  double x = 0;
  bool raised = false;
  while (!text.empty()) {
    if (!raised && text.starts_with("^{")) {
      raised = true;
      text.remove_prefix(2);
      continue;
    }
    if (raised && text.front() == '}') {
      raised = false;
      text.remove_prefix(1);
      continue;
    }
    const char32_t code = take_code_point(text);
    const double scale = raised ? kShrink : 1.0;
    line.push_back({code, x, raised ? kRaise : 0.0, scale});
    x += (glyph(code).advance + kTracking) * scale;
  }
  width = x;
  return line;
}

}  // namespace

double text_width(std::string_view text, double size) {
  double width = 0;
  layout(text, width);
  return width * size;
}

void draw_text(Image& image, Point2 at, std::string_view text, const TextStyle& style) {
  double width = 0;
  const auto line = layout(text, width);
  const double s = style.size;
  double left = 0, up = 0;  // of the start of the base line from the anchor, along and across the text
  if (style.horizontal == HorizontalAnchor::centre) left = -0.5 * width * s;
  if (style.horizontal == HorizontalAnchor::right) left = -width * s;
  if (style.vertical == VerticalAnchor::middle) up = -0.35 * s;
  if (style.vertical == VerticalAnchor::top) up = -0.70 * s;
  // Horizontal strokes on the base line fall on the middle of a row of pixels: sharper small text.
  const auto snapped = [](double v) { return std::floor(v) + 0.5; };
  const Point2 start =
      style.upwards ? Point2{snapped(at.x - up), at.y - left} : Point2{at.x + left, snapped(at.y - up)};
  std::vector<Polyline> strokes;
  for (const auto& c : line)
    for (const auto& stroke : glyph(c.code).strokes) {
      Polyline& out = strokes.emplace_back();
      for (const Point2& p : stroke) {
        const double x = (c.x + p.x * c.scale) * s, y = (c.y + p.y * c.scale) * s;
        out.push_back(style.upwards ? Point2{start.x - y, start.y - x} : Point2{start.x + x, start.y - y});
      }
    }
  const double stroke_width = s * (style.bold ? 0.125 : 0.082);
  draw_polylines(image, strokes, {.colour = style.colour, .width = stroke_width}, bounds(image));
}

}  // namespace recoil
