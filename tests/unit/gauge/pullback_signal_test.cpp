#include "gauge/kind/pullback_signal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../core/random.hpp"
#include "gauge/time_series.hpp"

namespace recoil::pullback_signal_test {
namespace {

/// A rise in a time of 1 to 300, a plateau to 2, a straight fall by 120 to 3, then ringing of a period of
/// 0.5.
double velocity(double t) {
  if (t < 1) return 300 * t;
  if (t < 2) return 300;
  if (t < 3) return 300 - 120 * (t - 2);
  return 220 - 40 * std::cos(4 * std::numbers::pi * (t - 3));
}

TEST(PullbackSignal, OfASpall) {
  for (const int steps : {200, 20000}) {  // the latter are thinned out
    PullbackSignal signal;
    for (int k = 0; k <= 5 * steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      if (t < 3) {
        EXPECT_TRUE(std::isnan(signal.fall()));
      }
      signal.add(t, velocity(t));
    }
    const double h = 2.0 / steps;
    EXPECT_NEAR(signal.peak(), 300, 1e-9);
    EXPECT_NEAR(signal.fall(), 120, 1e-9);
    EXPECT_NEAR(signal.low_time(), 3, h);
    EXPECT_NEAR(signal.slope(), 120, 0.5);
    EXPECT_NEAR(signal.period(), 0.5, 2 * h);
  }
}

TEST(PullbackSignal, WithoutARiseThereIsNone) {
  PullbackSignal signal;
  for (int k = 0; k < 100; ++k) signal.add(k, 100 - k);
  EXPECT_EQ(signal.peak(), 100);
  EXPECT_TRUE(std::isnan(signal.fall()));
  EXPECT_TRUE(std::isnan(signal.period()));
}

TEST(PullbackSignal, NoiseOnAPlateauIsNoFall) {
  PullbackSignal signal;
  double time = 0;
  for (const double u : {0.0, 391.1, 390.9, 391.05, 380.0, 224.0, 300.0}) signal.add(++time, u);
  EXPECT_NEAR(signal.fall(), 391.1 - 224, 1e-9);
}

/// At any time it is what pull_back_of() finds in the record so far.
TEST(PullbackSignal, IsThatOfTheRecord) {
  Random random(3);
  for (int run = 0; run < 30; ++run) {
    PullbackSignal signal;
    Curve curve;
    for (int k = 0; k < 60; ++k) {
      curve.t.push_back(k);
      curve.y.push_back(random(-100, 300));
      signal.add(curve.t.back(), curve.y.back());
      const PullBack wanted = pull_back_of(curve);
      ASSERT_EQ(std::isnan(wanted.fall), std::isnan(signal.fall()));
      if (std::isnan(wanted.fall)) continue;
      ASSERT_EQ(signal.fall(), wanted.fall);
      ASSERT_EQ(signal.peak_time(), wanted.peak_time);
      ASSERT_EQ(signal.low_time(), wanted.time);
    }
  }
}

}  // namespace
}  // namespace recoil::pullback_signal_test
