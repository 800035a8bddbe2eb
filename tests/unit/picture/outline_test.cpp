#include "picture/outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace recoil::outline_test {
namespace {

/// Cell-centred values of a function of the place.
template <class F>
PlaneArray sampled(int nx, int ny, double x0, double y0, double d, const F& f) {
  PlaneArray a{nx, ny, x0, y0, d, d, {}};
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) a.values.push_back(f(x0 + (i + 0.5) * d, y0 + (j + 0.5) * d));
  return a;
}

TEST(Outline, CircleHasItsLengthAndArea) {
  const double r = 0.7;
  const auto outlines = zero_outlines(
      sampled(60, 50, -1, -1, 0.04, [&](double x, double y) { return std::hypot(x - 0.1, y) - r; }));
  ASSERT_EQ(outlines.size(), 1u);
  EXPECT_TRUE(outlines[0].closed);
  EXPECT_NEAR(length(outlines[0]), 2 * std::numbers::pi * r, 0.01 * 2 * std::numbers::pi * r);
  EXPECT_NEAR(signed_area(outlines[0]), std::numbers::pi * r * r, 0.01 * std::numbers::pi * r * r);
  for (const auto& p : outlines[0].points) EXPECT_NEAR(std::hypot(p.x - 0.1, p.y), r, 1e-3);
}

TEST(Outline, NegativeSideLiesToTheLeftAlsoOfHoles) {
  const auto outlines = zero_outlines(sampled(
      50, 50, -1, -1, 0.04, [](double x, double y) { return std::abs(std::hypot(x, y) - 0.6) - 0.2; }));
  ASSERT_EQ(outlines.size(), 2u);
  const double a = signed_area(outlines[0]), b = signed_area(outlines[1]);
  EXPECT_NEAR(std::max(a, b), std::numbers::pi * 0.64, 0.03);
  EXPECT_NEAR(std::min(a, b), -std::numbers::pi * 0.16, 0.02);
}

TEST(Outline, ReachesTheEdgeOfTheArray) {
  // A half disc on the axis r = 0: an open curve that begins and ends on the axis itself.
  const auto outlines =
      zero_outlines(sampled(40, 80, 0, -2, 0.05, [](double x, double y) { return std::hypot(x, y) - 1; }));
  ASSERT_EQ(outlines.size(), 1u);
  EXPECT_FALSE(outlines[0].closed);
  EXPECT_DOUBLE_EQ(outlines[0].points.front().x, 0);
  EXPECT_DOUBLE_EQ(outlines[0].points.back().x, 0);
  EXPECT_NEAR(length(outlines[0]), std::numbers::pi, 0.01 * std::numbers::pi);
  EXPECT_EQ(signed_area(outlines[0]), 0);
}

TEST(Outline, SaddleIsDecidedByItsMean) {
  const PlaneArray joined{2, 2, 0, 0, 1, 1, {-2, 1, 1, -2}}, apart{2, 2, 0, 0, 1, 1, {-1, 2, 2, -1}};
  for (const bool is_joined : {true, false}) {
    const auto outlines = zero_outlines_of_nodes(is_joined ? joined : apart);
    ASSERT_EQ(outlines.size(), 2u);
    for (const auto& outline : outlines) {  // joined: each curve cuts off the corner (1, 0) or (0, 1)
      const Point2 a = outline.points.front(), b = outline.points.back();
      const double sum_x = a.x + b.x, sum_y = a.y + b.y;
      EXPECT_EQ((sum_x > 1) != (sum_y > 1), is_joined);
    }
  }
}

TEST(Outline, NothingWhereNothingIsKnown) {
  auto phi = sampled(30, 30, -1.5, -1.5, 0.1, [](double x, double y) { return std::hypot(x, y) - 1; });
  EXPECT_TRUE(zero_outlines(PlaneArray{2, 2, 0, 0, 1, 1, {1, 1, 1, 1}}).empty());
  EXPECT_TRUE(zero_outlines(PlaneArray{}).empty()) << "a plane without cells";
  phi.values[15 + 30 * 5] = std::nan("");  // on the lower part of the circle: the curve opens there
  const auto outlines = zero_outlines(phi);
  ASSERT_EQ(outlines.size(), 1u);
  EXPECT_FALSE(outlines[0].closed);
}

TEST(Outline, ValuesThatAreExactlyZeroBreakNothing) {
  const auto outlines = zero_outlines(sampled(9, 9, -4.5, -4.5, 1, [](double x, double y) {
    return std::max(std::abs(x), std::abs(y)) - 2;  // zero at centres of cells
  }));
  ASSERT_EQ(outlines.size(), 1u);
  EXPECT_TRUE(outlines[0].closed);
  EXPECT_NEAR(signed_area(outlines[0]), 16 - 4 * 0.5, 1e-12);  // the corners are cut
}

}  // namespace
}  // namespace recoil::outline_test
