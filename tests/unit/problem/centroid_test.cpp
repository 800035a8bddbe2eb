#include "problem/centroid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace recoil::centroid_test {
namespace {

double from_box(double x, double lo, double hi) { return std::max(lo - x, x - hi); }

TEST(Centroid, OfABoxIsItsMiddle) {
  const auto interval = [](const Vec<1>& x) { return from_box(x[0], 2, 5); };
  EXPECT_DOUBLE_EQ(centroid<1>(interval, {{2}}, {{5}}, false)[0], 3.5);
  EXPECT_NEAR(centroid<1>(interval, {{-90}}, {{70}}, false)[0], 3.5, 1e-4);
  const auto box = [](const Vec<3>& x) {
    return std::max({from_box(x[0], 2, 5), from_box(x[1], 1, 4), from_box(x[2], -2, 2)});
  };
  const Vec<3> middle = centroid<3>(box, {{2, 1, -2}}, {{5, 4, 2}}, false);
  EXPECT_NEAR(norm(middle - Vec<3>{{3.5, 2.5, 0}}), 0, 1e-12);
}

/// What of a body lies beyond the box does not count: half a ball's centroid is at 3/8 of its radius.
TEST(Centroid, OfHalfABall) {
  const auto ball = [](const Vec<3>& x) { return norm(x - Vec<3>{{1, 2, 0}}) - 0.8; };
  const Vec<3> at = centroid<3>(ball, {{1, -40, -30}}, {{70, 50, 60}}, false);
  EXPECT_NEAR(norm(at - Vec<3>{{1 + 0.3, 2, 0}}), 0, 2e-3 * 0.8);
}

TEST(Centroid, OfHalfADisc) {
  const auto disc = [](const Vec<2>& x) { return norm(x) - 3; };
  const Vec<2> at = centroid<2>(disc, {{0, -100}}, {{50, 100}}, false);
  EXPECT_NEAR(at[0], 4 / std::numbers::pi, 1e-4);
  EXPECT_NEAR(at[1], 0, 1e-4);
}

/// A cone of height 4 has its centroid at a quarter of it, on the axis.
TEST(Centroid, OfACone) {
  const auto cone = [](const Vec<2>& x) {
    return std::max(-x[1], (x[0] - 1 + 0.25 * x[1]) / std::hypot(1, 0.25));
  };
  const Vec<2> at = centroid<2>(cone, {{0, -2}}, {{20, 30}}, true);
  EXPECT_EQ(at[0], 0);
  EXPECT_NEAR(at[1], 1, 5e-4);
}

TEST(Centroid, OfNothingIsTheMiddleOfTheBox) {
  EXPECT_EQ(centroid<2>([](const Vec<2>&) { return 1e300; }, {{0, 2}}, {{2, 4}}, false), (Vec<2>{{1, 3}}));
}

}  // namespace
}  // namespace recoil::centroid_test
