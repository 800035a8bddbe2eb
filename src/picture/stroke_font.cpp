#include "picture/stroke_font.hpp"

#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <sstream>
#include <string>

#include "core/error.hpp"

namespace recoil {
namespace {

/// A glyph as it is drawn, in hundredths of the em, y upwards. The path language:
///   M x y              start a stroke           N                     start a stroke without a point
///   L x y              straight to              C x1 y1 x2 y2 x y     cubic Bezier to
///   A x y rx ry a b    arc of the ellipse around (x, y) from angle a to b in degrees, straight to its start
///   D x y              dot
struct Drawing {
  char32_t code;
  double advance;
  const char* path;
};

constexpr Drawing kDrawings[] = {
    {U' ', 27, ""},
    {U'!', 24, "M 12 70 L 12 22 D 12 2"},
    {U'"', 34, "M 11 70 L 11 50 M 23 70 L 23 50"},
    {U'#', 62, "M 25 68 L 17 2 M 45 68 L 37 2 M 8 46 L 56 46 M 6 24 L 54 24"},
    {U'$', 56,
     "M 46 52 C 43 58 37 62 28 62 C 18 62 11 57 11 49 C 11 38 21 36 28 35 C 37 33 47 30 47 20 C 47 11 39 6 "
     "28 6 C 19 6 12 10 9 17 M 28 72 L 28 -4"},
    {U'%', 82, "N A 20 54 13 16 0 360 N A 62 16 13 16 0 360 M 63 70 L 19 0"},
    {U'&', 70,
     "M 62 0 L 20 48 C 14 55 15 70 29 70 C 43 70 44 55 34 46 L 20 36 C 6 26 6 0 28 0 C 46 0 58 14 60 32"},
    {U'\'', 22, "M 11 70 L 11 50"},
    {U'(', 32, "M 25 78 C 8 58 8 8 25 -12"},
    {U')', 32, "M 7 78 C 24 58 24 8 7 -12"},
    {U'*', 44, "M 22 70 L 22 40 M 9 62 L 35 48 M 35 62 L 9 48"},
    {U'+', 58, "M 29 55 L 29 15 M 9 35 L 49 35"},
    {U',', 24, "M 13 4 L 13 1 L 8 -11"},
    {U'-', 36, "M 8 27 L 28 27"},
    {U'.', 24, "D 12 2"},
    {U'/', 40, "M 35 76 L 5 -8"},
    {U'0', 56, "N A 28 50 18 20 0 180 A 28 20 18 20 180 360 L 46 50"},
    {U'1', 56, "M 14 57 L 31 70 L 31 0"},
    {U'2', 56, "N A 27.5 51.5 17.5 18.5 168 -34 L 10 0 L 47 0"},
    {U'3', 56, "N A 27 53.5 16 16.5 155 -90 A 27 18.5 18.5 18.5 90 -155"},
    {U'4', 56, "M 38 0 L 38 70 L 7 18 L 49 18"},
    {U'5', 56, "M 43 70 L 16 70 L 13.5 38 A 27 22.5 19 22.5 133 -152"},
    {U'6', 56, "M 37 70 C 21 55 10 40 10 21 A 28 21 18 21 180 540"},
    {U'7', 56, "M 9 70 L 47 70 L 22 0"},
    {U'8', 56, "N A 28 53.5 15.5 16.5 0 360 N A 28 18.5 18.5 18.5 0 360"},
    {U'9', 56, "M 19 0 C 35 15 46 30 46 49 A 28 49 18 21 0 360"},
    {U':', 24, "D 12 2 D 12 46"},
    {U';', 24, "M 13 4 L 13 1 L 8 -11 D 12 46"},
    {U'<', 58, "M 48 56 L 10 35 L 48 14"},
    {U'=', 58, "M 9 44 L 49 44 M 9 26 L 49 26"},
    {U'>', 58, "M 10 56 L 48 35 L 10 14"},
    {U'?', 48, "N A 24 53.5 15 16.5 165 -40 C 29 36 23 34 23 22 D 23 2"},
    {U'@', 86,
     "N A 41 32 13 16 0 360 M 54 48 L 54 24 C 54 12 74 12 74 34 C 74 54 60 70 42 70 C 22 70 8 53 8 32 C 8 9 "
     "24 -8 44 -8 C 52 -8 58 -6 63 -3"},
    {U'A', 62, "M 5 0 L 31 70 L 57 0 M 13.5 23 L 48.5 23"},
    {U'B', 63,
     "M 10 0 L 10 70 L 31 70 A 31 53.5 17 16.5 90 -90 L 10 37 M 31 37 L 34 37 A 34 18.5 19 18.5 90 -90 L 10 "
     "0"},
    {U'C', 66, "N A 36 35 27 35 48 312"},
    {U'D', 68, "M 10 0 L 10 70 L 27 70 A 27 35 32 35 90 -90 L 10 0"},
    {U'E', 57, "M 49 70 L 10 70 L 10 0 L 49 0 M 10 37 L 44 37"},
    {U'F', 54, "M 48 70 L 10 70 L 10 0 M 10 36 L 43 36"},
    {U'G', 71, "N A 36 35 27 35 48 336 L 60.7 33 L 39 33"},
    {U'H', 69, "M 10 0 L 10 70 M 59 0 L 59 70 M 10 37 L 59 37"},
    {U'I', 22, "M 11 0 L 11 70"},
    {U'J', 46, "M 36 70 L 36 19 A 21 19 15 19 0 -160"},
    {U'K', 61, "M 10 0 L 10 70 M 53 70 L 10 26 M 25 41.3 L 56 0"},
    {U'L', 53, "M 10 70 L 10 0 L 48 0"},
    {U'M', 80, "M 10 0 L 10 70 L 40 14 L 70 70 L 70 0"},
    {U'N', 69, "M 10 0 L 10 70 L 59 0 L 59 70"},
    {U'O', 73, "N A 36.5 35 28 35 0 360"},
    {U'P', 59, "M 10 0 L 10 70 L 33 70 A 33 51 19 19 90 -90 L 10 32"},
    {U'Q', 73, "N A 36.5 35 28 35 0 360 M 45 16 L 63 -6"},
    {U'R', 63, "M 10 0 L 10 70 L 33 70 A 33 51 19 19 90 -90 L 10 32 M 34 32 L 56 0"},
    {U'S', 58,
     "M 48 58 C 44 66 38 70 29 70 C 18 70 11 63 11 53 C 11 41 21 38 29 36 C 39 33 49 29 49 18 C 49 6 39 0 28 "
     "0 C 19 0 11 4 8 13"},
    {U'T', 56, "M 28 0 L 28 70 M 4 70 L 52 70"},
    {U'U', 67, "M 10 70 L 10 24 A 33.5 24 23.5 24 180 360 L 57 70"},
    {U'V', 60, "M 5 70 L 30 0 L 55 70"},
    {U'W', 88, "M 5 70 L 24 0 L 44 66 L 64 0 L 83 70"},
    {U'X', 58, "M 7 70 L 51 0 M 51 70 L 7 0"},
    {U'Y', 58, "M 5 70 L 29 34 L 53 70 M 29 34 L 29 0"},
    {U'Z', 58, "M 9 70 L 50 70 L 8 0 L 51 0"},
    {U'[', 32, "M 25 78 L 12 78 L 12 -12 L 25 -12"},
    {U'\\', 40, "M 5 76 L 35 -8"},
    {U']', 32, "M 7 78 L 20 78 L 20 -12 L 7 -12"},
    {U'^', 50, "M 9 42 L 25 70 L 41 42"},
    {U'_', 50, "M 0 -10 L 50 -10"},
    {U'`', 30, "M 8 72 L 20 58"},
    {U'a', 53,
     "M 10 40 C 13 47 18 50 25 50 C 36 50 42 45 42 34 L 42 0 M 42 29 L 25 29 C 14 29 8 23 8 14.5 C 8 5 14 0 "
     "22 0 C 33 0 42 7 42 18"},
    {U'b', 56, "M 10 72 L 10 0 N A 28.5 25 18.5 25 0 360"},
    {U'c', 49, "N A 27.5 25 18.5 25 50 310"},
    {U'd', 56, "M 46 72 L 46 0 N A 27.5 25 18.5 25 0 360"},
    {U'e', 54, "M 9 26 L 45.5 26 A 27 25 18.5 25 2 317"},
    {U'f', 33, "M 32 71 C 21 73 15 69 15 58 L 15 0 M 5 49 L 29 49"},
    {U'g', 56, "N A 27.5 25 18.5 25 0 360 M 46 50 L 46 0 C 46 -14 38 -21 27 -21 C 20 -21 14 -19 10 -14"},
    {U'h', 54, "M 10 72 L 10 0 M 10 28 C 12 42 19 50 28 50 C 38 50 44 43 44 32 L 44 0"},
    {U'i', 22, "M 11 50 L 11 0 D 11 68"},
    {U'j', 24, "M 13 50 L 13 -8 C 13 -18 8 -21 0 -20 D 13 68"},
    {U'k', 50, "M 10 72 L 10 0 M 42 50 L 10 18 M 20 28 L 45 0"},
    {U'l', 25, "M 11 72 L 11 10 C 11 3 14 0 20 0"},
    {U'm', 82,
     "M 10 50 L 10 0 M 10 28 C 12 42 18 50 26 50 C 36 50 41 43 41 32 L 41 0 M 41 28 C 43 42 50 50 57 50 C 67 "
     "50 72 43 72 32 L 72 0"},
    {U'n', 54, "M 10 50 L 10 0 M 10 28 C 12 42 19 50 28 50 C 38 50 44 43 44 32 L 44 0"},
    {U'o', 54, "N A 27 25 18.5 25 0 360"},
    {U'p', 56, "M 10 50 L 10 -21 N A 28.5 25 18.5 25 0 360"},
    {U'q', 56, "M 46 50 L 46 -21 N A 27.5 25 18.5 25 0 360"},
    {U'r', 35, "M 10 50 L 10 0 M 10 26 C 12 42 20 50 32 49"},
    {U's', 46,
     "M 38 41 C 35 47 30 50 23.5 50 C 15 50 9.5 45 9.5 37.5 C 9.5 29 17 27 24 25.5 C 32 24 39 21 39 13 C 39 "
     "4.5 32 0 23 0 C 15 0 9.5 3 7 10"},
    {U't', 36, "M 15 64 L 15 14 C 15 4 20 0 31 1 M 5 49 L 30 49"},
    {U'u', 54, "M 10 50 L 10 18 C 10 7 16 0 26 0 C 35 0 42 8 44 22 M 44 50 L 44 0"},
    {U'v', 48, "M 5 50 L 24 0 L 43 50"},
    {U'w', 70, "M 5 50 L 20 0 L 35 46 L 50 0 L 65 50"},
    {U'x', 48, "M 6 50 L 42 0 M 42 50 L 6 0"},
    {U'y', 48, "M 5 50 L 24 1 M 43 50 L 24 1 C 18 -14 15 -21 5 -20"},
    {U'z', 48, "M 8 50 L 40 50 L 7 0 L 42 0"},
    {U'{', 36, "M 28 78 C 12 78 24 38 8 33 C 24 28 12 -12 28 -12"},
    {U'|', 24, "M 12 78 L 12 -12"},
    {U'}', 36, "M 8 78 C 24 78 12 38 28 33 C 12 28 24 -12 8 -12"},
    {U'~', 56, "M 9 29 C 14 40 22 40 28 34 C 34 28 42 28 47 39"},
    {U'\u00b0', 36, "N A 18 58 11 11 0 360"},
    {U'\u00b1', 58, "M 29 60 L 29 22 M 10 41 L 48 41 M 10 6 L 48 6"},
    {U'\u00b2', 36, "N A 18 61 9 9 165 -35 L 9 37 L 28 37"},
    {U'\u00b3', 36, "N A 17 63 8 7 155 -90 A 17 46 9.5 9.5 90 -155"},
    {U'\u00b5', 54, "M 10 50 L 10 -21 M 10 18 C 10 7 16 0 26 0 C 35 0 42 8 44 22 M 44 50 L 44 0"},
    {U'\u00b7', 24, "D 12 30"},
    {U'\u00d7', 56, "M 12 51 L 44 19 M 44 51 L 12 19"},
    {U'\u03b5', 46, "M 38 42 C 30 54 10 52 10 38 C 10 29 17 27 26 27 C 17 27 8 24 8 13 C 8 -3 32 -4 40 9"},
    {U'\u03c1', 56, "M 10 -21 L 10 25 A 28.5 25 18.5 25 180 -180"},
    {U'\u03c3', 56, "M 52 50 L 27 50 A 27 25 18.5 25 90 450"},
    {U'\u03c4', 46, "M 6 50 L 42 50 M 23 50 L 23 12 C 23 4 28 0 36 1"},
    {U'\u03c6', 64, "N A 32 25 23 24 0 360 M 32 72 L 32 -21"},
    {U'\u0394', 64, "M 32 70 L 6 0 L 58 0 L 32 70"},
    {U'\u2013', 50, "M 6 27 L 44 27"},
    {U'\u2212', 56, "M 10 35 L 46 35"},
    {U'\u2265', 58, "M 10 64 L 48 45 L 10 26 M 10 8 L 48 8"},
    {U'\u2264', 58, "M 48 64 L 10 45 L 48 26 M 10 8 L 48 8"},
};

void add_arc(Polyline& line, Point2 centre, double rx, double ry, double from, double to) {
  constexpr double degree = std::numbers::pi / 180;
  const int pieces = 2 + static_cast<int>(std::abs(to - from) / 7.5);
  for (int k = 0; k <= pieces; ++k) {
    const double angle = (from + (to - from) * k / pieces) * degree;
    line.push_back({centre.x + rx * std::cos(angle), centre.y + ry * std::sin(angle)});
  }
}

void add_curve(Polyline& line, Point2 b, Point2 c, Point2 d) {
  const Point2 a = line.back();
  constexpr int pieces = 12;
  for (int k = 1; k <= pieces; ++k) {
    const double t = 1.0 * k / pieces, s = 1 - t;
    const double wa = s * s * s, wb = 3 * s * s * t, wc = 3 * s * t * t, wd = t * t * t;
    line.push_back({wa * a.x + wb * b.x + wc * c.x + wd * d.x, wa * a.y + wb * b.y + wc * c.y + wd * d.y});
  }
}

Glyph drawn(const Drawing& drawing) {
  Glyph result;
  std::istringstream path(drawing.path);
  char command = 0;
  const auto point = [&path] {
    Point2 p;
    path >> p.x >> p.y;
    return p;
  };
  while (path >> command) {
    if (command == 'M') {
      result.strokes.push_back({point()});
    } else if (command == 'N') {
      result.strokes.emplace_back();
    } else if (command == 'L') {
      result.strokes.back().push_back(point());
    } else if (command == 'C') {
      const Point2 b = point(), c = point(), d = point();
      add_curve(result.strokes.back(), b, c, d);
    } else if (command == 'A') {
      const Point2 centre = point(), radii = point(), angles = point();
      add_arc(result.strokes.back(), centre, radii.x, radii.y, angles.x, angles.y);
    } else if (command == 'D') {  // a ring so small that a stroke fills it: a dot a little wider than lines
      result.strokes.emplace_back();
      add_arc(result.strokes.back(), point(), 1.4, 1.4, 0, 360);
    }
  }
  require(!path.bad(), "path of a glyph");
  result.advance = drawing.advance / 100;
  for (auto& stroke : result.strokes)
    for (auto& p : stroke) p = {p.x / 100, p.y / 100};
  return result;
}

const std::map<char32_t, Glyph>& glyphs() {
  static const std::map<char32_t, Glyph> table = [] {
    std::map<char32_t, Glyph> all;
    for (const auto& drawing : kDrawings) all.emplace(drawing.code, drawn(drawing));
    all.emplace(U'\u03bc', all.at(U'\u00b5'));  // the Greek letter for the micro sign
    return all;
  }();
  return table;
}

}  // namespace

bool has_glyph(char32_t code) { return glyphs().contains(code); }

const Glyph& glyph(char32_t code) {
  static const Glyph missing = drawn({0, 56, "M 12 0 L 44 0 L 44 66 L 12 66 L 12 0"});
  const auto found = glyphs().find(code);
  return found == glyphs().end() ? missing : found->second;
}

}  // namespace recoil
