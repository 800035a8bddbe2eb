#include "picture/canvas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace recoil {
namespace {

constexpr Rgb kWhite{255, 255, 255}, kBlack{0, 0, 0};

/// How much of the picture is covered by black [pixels].
double ink(const Image& image) {
  double sum = 0;
  for (std::size_t o = 0; o < image.rgb.size(); o += 3) sum += (255.0 - image.rgb[o]) / 255.0;
  return sum;
}

TEST(Canvas, RectangleCoversItsAreaAlsoBetweenPixels) {
  Image image = make_image(20, 20, kWhite);
  fill_rect(image, {2.25, 3.5, 10.75, 8.25}, kBlack);
  EXPECT_NEAR(ink(image), 8.5 * 4.75, 0.2);
  EXPECT_EQ(image.at(5, 5), kBlack);
  EXPECT_EQ(image.at(11, 5), kWhite);
}

TEST(Canvas, LineCoversLengthTimesWidthInAnyDirection) {
  for (int degrees = 0; degrees < 180; degrees += 15) {
    Image image = make_image(200, 200, kWhite);
    const double a = degrees * std::numbers::pi / 180, x = 70 * std::cos(a), y = 70 * std::sin(a);
    draw_polyline(image, {{100 - x, 100 - y}, {100 + x, 100 + y}}, {.colour = kBlack, .width = 3},
                  bounds(image));
    EXPECT_NEAR(ink(image), 140 * 3 + std::numbers::pi * 1.5 * 1.5, 0.03 * 420) << degrees;
  }
}

TEST(Canvas, CrossingOfHalfTransparentLinesIsNoDarker) {
  Image image = make_image(40, 40, kWhite);
  const std::vector<Polyline> cross{{{2, 20}, {38, 20}}, {{20, 2}, {20, 38}}};
  draw_polylines(image, cross, {.colour = kBlack, .width = 4, .alpha = 0.5}, bounds(image));
  EXPECT_EQ(image.at(20, 20), image.at(10, 20));
}

TEST(Canvas, DashesLeaveTheirShareAndGoOnAroundCorners) {
  Image image = make_image(400, 40, kWhite);
  Polyline line;
  for (int k = 0; k <= 100; ++k) line.push_back({10 + 3.8 * k, 20.0});
  draw_polyline(image, line, {.colour = kBlack, .width = 1, .dash = {10, 10}}, bounds(image));
  EXPECT_NEAR(ink(image), 190, 25);  // round ends add a little
  EXPECT_GT(image.at(25, 19).r, 200);
  EXPECT_LT(image.at(15, 19).r, 160);
}

TEST(Canvas, NothingIsDrawnOutsideTheClip) {
  Image image = make_image(60, 60, kWhite);
  draw_polyline(image, {{-1e12, 30}, {1e12, 30}}, {.colour = kBlack, .width = 5, .dash = {6, 3}},
                {20, 10, 40, 50});
  EXPECT_EQ(image.at(10, 30), kWhite);
  EXPECT_EQ(image.at(50, 30), kWhite);
  EXPECT_GT(ink(image), 50);
}

TEST(Canvas, LineBreaksAtPointsThatAreNotFinite) {
  Image image = make_image(60, 60, kWhite);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  draw_polyline(image, {{5, 30}, {15, 30}, {nan, 30}, {45, 30}, {55, 30}, {inf, 30}, {30, -inf}},
                {.colour = kBlack, .width = 3}, bounds(image));
  EXPECT_EQ(image.at(30, 30), kWhite);
  EXPECT_EQ(image.at(10, 30), kBlack);
  EXPECT_EQ(image.at(50, 30), kBlack);
}

TEST(Canvas, CircleHasItsArea) {
  Image image = make_image(60, 60, kWhite);
  fill_circle(image, {30.3, 29.6}, 17, kBlack, bounds(image));
  EXPECT_NEAR(ink(image), std::numbers::pi * 17 * 17, 10);
}

}  // namespace
}  // namespace recoil
