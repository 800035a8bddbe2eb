#include "picture/canvas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace recoil::canvas_test {
namespace {

constexpr Rgb kWhite{255, 255, 255}, kBlack{0, 0, 0};

/// How much of the picture is covered by black [pixels].
double ink(const Image& image) {
  double sum = 0;
  for (std::size_t o = 0; o < image.rgb.size(); o += 3) sum += (255.0 - image.rgb[o]) / 255.0;
  return sum;
}

TEST(Canvas, RectangleCoversItsAreaAlsoBetweenPixels) {
  Canvas canvas(20, 20, kWhite);
  fill_rect(canvas, {2.25, 3.5, 10.75, 8.25}, kBlack);
  EXPECT_NEAR(ink(rendered(canvas)), 8.5 * 4.75, 0.2);
  EXPECT_EQ(rendered(canvas).at(5, 5), kBlack);
  EXPECT_EQ(rendered(canvas).at(11, 5), kWhite);
}

TEST(Canvas, LineCoversLengthTimesWidthInAnyDirection) {
  for (int degrees = 0; degrees < 180; degrees += 15) {
    Canvas canvas(200, 200, kWhite);
    const double a = degrees * std::numbers::pi / 180, x = 70 * std::cos(a), y = 70 * std::sin(a);
    draw_polyline(canvas, {{100 - x, 100 - y}, {100 + x, 100 + y}}, {.colour = kBlack, .width = 3},
                  canvas.bounds());
    EXPECT_NEAR(ink(rendered(canvas)), 140 * 3 + std::numbers::pi * 1.5 * 1.5, 0.03 * 420) << degrees;
  }
}

TEST(Canvas, CrossingOfHalfTransparentLinesIsNoDarker) {
  Canvas canvas(40, 40, kWhite);
  const std::vector<Polyline> cross{{{2, 20}, {38, 20}}, {{20, 2}, {20, 38}}};
  draw_polylines(canvas, cross, {.colour = kBlack, .width = 4, .alpha = 0.5}, canvas.bounds());
  EXPECT_EQ(rendered(canvas).at(20, 20), rendered(canvas).at(10, 20));
}

TEST(Canvas, DashesLeaveTheirShareAndGoOnAroundCorners) {
  Canvas canvas(400, 40, kWhite);
  Polyline line;
  for (int k = 0; k <= 100; ++k) line.push_back({10 + 3.8 * k, 20.0});
  draw_polyline(canvas, line, {.colour = kBlack, .width = 1, .dash = {10, 10}}, canvas.bounds());
  EXPECT_NEAR(ink(rendered(canvas)), 190, 25);  // round ends add a little
  EXPECT_GT(rendered(canvas).at(25, 19).r, 200);
  EXPECT_LT(rendered(canvas).at(15, 19).r, 160);
}

TEST(Canvas, NothingIsDrawnOutsideTheClip) {
  Canvas canvas(60, 60, kWhite);
  draw_polyline(canvas, {{-1e12, 30}, {1e12, 30}}, {.colour = kBlack, .width = 5, .dash = {6, 3}},
                {20, 10, 40, 50});
  EXPECT_EQ(rendered(canvas).at(10, 30), kWhite);
  EXPECT_EQ(rendered(canvas).at(50, 30), kWhite);
  EXPECT_GT(ink(rendered(canvas)), 50);
}

TEST(Canvas, LineBreaksAtPointsThatAreNotFinite) {
  Canvas canvas(60, 60, kWhite);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  draw_polyline(canvas, {{5, 30}, {15, 30}, {nan, 30}, {45, 30}, {55, 30}, {inf, 30}, {30, -inf}},
                {.colour = kBlack, .width = 3}, canvas.bounds());
  EXPECT_EQ(rendered(canvas).at(30, 30), kWhite);
  EXPECT_EQ(rendered(canvas).at(10, 30), kBlack);
  EXPECT_EQ(rendered(canvas).at(50, 30), kBlack);
}

TEST(Canvas, CircleHasItsArea) {
  Canvas canvas(60, 60, kWhite);
  fill_circle(canvas, {30.3, 29.6}, 17, kBlack, canvas.bounds());
  EXPECT_NEAR(ink(rendered(canvas)), std::numbers::pi * 17 * 17, 10);
}

TEST(Canvas, ImageIsStretchedWithSharpPixels) {
  Canvas canvas(60, 40, kWhite);
  Image image(3, 2);
  image.set(0, 0, {255, 0, 0}), image.set(1, 0, {0, 255, 0}), image.set(2, 0, {0, 0, 255});
  image.set(0, 1, {9, 9, 9}), image.set(1, 1, {8, 8, 8}), image.set(2, 1, {7, 7, 7});
  draw_image(canvas, image, {15, 10, 45, 30});
  const Image pixels = rendered(canvas);
  for (int j = 10; j < 30; ++j)
    for (int i = 15; i < 45; ++i)
      ASSERT_EQ(pixels.at(i, j), image.at((i - 15) / 10, (j - 10) / 10)) << i << " " << j;
  EXPECT_EQ(pixels.at(14, 20), kWhite);
  EXPECT_EQ(pixels.at(20, 30), kWhite);
}

TEST(Canvas, PolygonIsFilled) {
  Canvas canvas(60, 60, kWhite);
  fill_polygon(canvas, {{10, 10}, {50, 10}, {10, 50}}, kBlack);
  EXPECT_NEAR(ink(rendered(canvas)), 800, 5);
}

}  // namespace
}  // namespace recoil::canvas_test
