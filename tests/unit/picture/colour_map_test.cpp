#include "picture/colour_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace recoil::colour_map_test {
namespace {

/// Lightness L* of CIE 1976 from sRGB, 0 to 100: another formula than the one the maps are made with.
double lightness(Rgb c) {
  const auto linear = [](unsigned char v) {
    const double s = v / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  };
  const double y = 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
  return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

TEST(ColourMap, OneWayMapsGrowLighterAllTheWay) {
  for (const auto map : {ColourMap::sequential, ColourMap::heat, ColourMap::grey}) {
    const auto table = colour_table(map, 65);
    for (std::size_t k = 1; k < table.size(); ++k) {
      const double step = lightness(table[k]) - lightness(table[k - 1]);
      EXPECT_GT(step, 0.2) << static_cast<int>(map) << " at " << k;
      EXPECT_LT(step, 3.0) << static_cast<int>(map) << " at " << k;
    }
  }
}

TEST(ColourMap, DivergingIsBlueThenPaleThenRed) {
  const auto table = colour_table(ColourMap::diverging, 257);
  EXPECT_GT(table.front().b, table.front().r + 60);
  EXPECT_GT(table.back().r, table.back().b + 60);
  const Rgb middle = table[128];
  EXPECT_LT(std::abs(middle.r - middle.b), 8);
  EXPECT_GT(lightness(middle), 94);
  for (std::size_t k = 0; k < 128; ++k)  // both arms are equally light at equal distance
    EXPECT_NEAR(lightness(table[k]), lightness(table[256 - k]), 6) << k;
}

TEST(ColourMap, NeighboursAreClose) {
  for (const auto map : {ColourMap::sequential, ColourMap::heat, ColourMap::diverging}) {
    const auto table = colour_table(map, 1024);
    for (std::size_t k = 1; k < table.size(); ++k) {
      EXPECT_LE(std::abs(table[k].r - table[k - 1].r), 4) << static_cast<int>(map) << " at " << k;
      EXPECT_LE(std::abs(table[k].g - table[k - 1].g), 4) << static_cast<int>(map) << " at " << k;
      EXPECT_LE(std::abs(table[k].b - table[k - 1].b), 4) << static_cast<int>(map) << " at " << k;
    }
  }
}

TEST(ColourMap, ValuesOutsideTakeTheEnds) {
  const auto table = colour_table(ColourMap::heat, 16);
  EXPECT_EQ(colour_at(table, -3), table.front());
  EXPECT_EQ(colour_at(table, 7), table.back());
}

TEST(ColourMap, CurvesDifferFromEachOtherAndFromTheirAreas) {
  for (std::size_t a = 0; a < 9; ++a) {
    EXPECT_GT(lightness(area_colour(a)), lightness(curve_colour(a)) + 10);
    for (std::size_t b = 0; b < a; ++b) {
      const Rgb p = curve_colour(a), q = curve_colour(b);
      EXPECT_GT(std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b), 60) << a << " " << b;
    }
  }
  EXPECT_EQ(curve_colour(9), curve_colour(0));
}

}  // namespace
}  // namespace recoil::colour_map_test
