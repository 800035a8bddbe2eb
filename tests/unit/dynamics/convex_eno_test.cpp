#include "dynamics/convex_eno.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "../core/random.hpp"

namespace recoil::convex_eno_test {
namespace {

double face(const std::array<double, 5>& v) { return convex_eno3(v[0], v[1], v[2], v[3], v[4]); }

/// Means over five cells of width h, of which the third ends at x, of a function given by its integral.
std::array<double, 5> means(const std::function<double(double)>& integral, double x, double h) {
  std::array<double, 5> v{};
  for (int k = 0; k < 5; ++k) {
    const double low = x + (k - 3) * h;
    v[k] = (integral(low + h) - integral(low)) / h;
  }
  return v;
}

TEST(ConvexEno3, AConstantStaysTheSameToTheLastBit) {
  Random random(1);
  for (int n = 0; n < 1000; ++n) {
    const double v = random(-1e9, 1e9);
    ASSERT_EQ(face({v, v, v, v, v}), v);
  }
}

TEST(ConvexEno3, IsExactForParabolas) {
  // Means of x^2 + 3 x: all three parabolas are the function itself, on one side of the minmod line.
  const auto v = means([](double x) { return x * x * x / 3 + 1.5 * x * x; }, 0.7, 0.1);
  EXPECT_NEAR(face(v), 0.7 * 0.7 + 3 * 0.7, 1e-13);
}

TEST(ConvexEno3, IsOfThirdOrderWhereDataAreSmooth) {
  const auto error = [](double h) {
    double sum = 0;
    for (int k = 0; k < 40; ++k) {
      const double x = 0.4 + 0.02 * k;  // where sin bends and neither peaks nor turns
      sum += std::abs(face(means([](double s) { return -std::cos(s); }, x, h)) - std::sin(x));
    }
    return sum / 40;
  };
  const double order = std::log2(error(0.02) / error(0.01));
  EXPECT_GT(order, 2.8);
  EXPECT_LT(order, 3.3);
}

TEST(ConvexEno3, MakesNoNewExtremaAtAJump) {
  for (int jump = 1; jump < 5; ++jump) {
    std::array<double, 5> v{};
    for (int k = 0; k < 5; ++k) v[k] = k < jump ? 0 : 1;
    EXPECT_GE(face(v), 0) << jump;
    EXPECT_LE(face(v), 1) << jump;
  }
}

TEST(ConvexEno3, TakesTheLineWhereTheParabolasDisagree) {
  // A peak: the minmod slope is 0, and the parabolas lie on both sides of it.
  EXPECT_EQ(face({0, 3, 4, 3.9, -3}), 4);
}

}  // namespace
}  // namespace recoil::convex_eno_test
