#include "picture/colour_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <span>

#include "core/error.hpp"

namespace recoil {
namespace {

/// A colour of Oklab in polar form: lightness 0..1, chroma, hue in degrees.
struct Polar {
  double lightness = 0, chroma = 0, hue = 0;
};

/// Lightness rises evenly in the one-way maps; chroma is what the sRGB gamut holds there.
constexpr Polar kSequential[] = {{0.24, 0.115, 305}, {0.37, 0.125, 287}, {0.50, 0.105, 250},
                                 {0.63, 0.092, 205}, {0.75, 0.130, 162}, {0.86, 0.165, 126},
                                 {0.95, 0.155, 106}};
constexpr Polar kHeat[] = {{0.10, 0.030, 290}, {0.26, 0.120, 305}, {0.42, 0.155, 345}, {0.57, 0.185, 385},
                           {0.71, 0.165, 412}, {0.85, 0.145, 440}, {0.98, 0.050, 465}};
constexpr Polar kDiverging[] = {{0.33, 0.110, 262}, {0.49, 0.145, 257}, {0.66, 0.115, 250},
                                {0.83, 0.058, 245}, {0.97, 0.000, 0},   {0.84, 0.065, 44},
                                {0.67, 0.140, 36},  {0.50, 0.165, 29},  {0.35, 0.125, 25}};
constexpr Polar kGrey[] = {{0.20, 0, 0}, {0.97, 0, 0}};

std::span<const Polar> points_of(ColourMap map) {
  switch (map) {
    case ColourMap::sequential:
      return kSequential;
    case ColourMap::heat:
      return kHeat;
    case ColourMap::diverging:
      return kDiverging;
    case ColourMap::grey:
      return kGrey;
  }
  throw InternalError("unknown colour map");
}

/// Cubic Hermite interpolation through four neighbouring values, slopes from central differences.
double smooth(double before, double a, double b, double after, double t) {
  const double slope_a = 0.5 * (b - before), slope_b = 0.5 * (after - a);
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * a + (t3 - 2 * t2 + t) * slope_a + (3 * t2 - 2 * t3) * b +
         (t3 - t2) * slope_b;
}

/// A colour of Oklab: lightness, a towards red, b towards yellow.
struct Oklab {
  double lightness = 0, a = 0, b = 0;
};

Oklab cartesian(const Polar& c) {
  const double angle = c.hue * std::numbers::pi / 180;
  return {c.lightness, c.chroma * std::cos(angle), c.chroma * std::sin(angle)};
}

/// Linear sRGB of an Oklab colour; components leave 0..1 outside the gamut.
std::array<double, 3> linear_rgb(const Oklab& c) {
  const auto cube = [](double v) { return v * v * v; };
  const double l = cube(c.lightness + 0.3963377774 * c.a + 0.2158037573 * c.b);
  const double m = cube(c.lightness - 0.1055613458 * c.a - 0.0638541728 * c.b);
  const double s = cube(c.lightness - 0.0894841775 * c.a - 1.2914855480 * c.b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

unsigned char encoded(double linear) {
  const double v = std::clamp(linear, 0.0, 1.0);
  const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  return static_cast<unsigned char>(std::lround(255 * s));
}

/// The colour on screen; one outside the gamut loses chroma, never lightness.
Rgb on_screen(const Oklab& c) {
  const auto inside = [](const std::array<double, 3>& rgb) {
    return std::ranges::all_of(rgb, [](double v) { return v >= -1e-4 && v <= 1 + 1e-4; });
  };
  double in = 0, out = 1;  // shares of the chroma
  auto rgb = linear_rgb(c);
  if (!inside(rgb))
    for (int k = 0; k < 20; ++k) {
      const double share = 0.5 * (in + out);
      rgb = linear_rgb({c.lightness, share * c.a, share * c.b});
      (inside(rgb) ? in : out) = share;
    }
  return {encoded(rgb[0]), encoded(rgb[1]), encoded(rgb[2])};
}

}  // namespace

Rgb curve_colour(std::size_t which) {
  constexpr Rgb palette[] = {{14, 98, 174},  {212, 64, 52}, {30, 140, 84},   {232, 146, 20}, {118, 72, 160},
                             {20, 158, 168}, {150, 86, 50}, {220, 110, 160}, {122, 128, 22}};
  return palette[which % std::size(palette)];
}

Rgb area_colour(std::size_t which) {
  const Rgb c = curve_colour(which);
  const auto paler = [](unsigned char v) { return static_cast<unsigned char>(255 - (255 - v) * 6 / 10); };
  return {paler(c.r), paler(c.g), paler(c.b)};
}

std::vector<Rgb> colour_table(ColourMap map, int count) {
  require(count >= 2, "a colour table has two colours or more");
  const auto points = points_of(map);
  const auto last = static_cast<int>(points.size()) - 1;
  std::vector<Rgb> table;
  for (int k = 0; k < count; ++k) {
    const double place = 1.0 * last * k / (count - 1);
    const int i = std::min(static_cast<int>(place), last - 1);
    const auto at = [&](int n) { return cartesian(points[std::clamp(n, 0, last)]); };
    const Oklab p = at(i - 1), c = at(i), d = at(i + 1), q = at(i + 2);
    const double t = place - i;
    table.push_back(on_screen({c.lightness + t * (d.lightness - c.lightness), smooth(p.a, c.a, d.a, q.a, t),
                               smooth(p.b, c.b, d.b, q.b, t)}));
  }
  return table;
}

Rgb colour_at(const std::vector<Rgb>& table, double t) {
  const double last = static_cast<double>(table.size() - 1);
  return table[std::lround(std::clamp(t, 0.0, 1.0) * last)];
}

}  // namespace recoil
