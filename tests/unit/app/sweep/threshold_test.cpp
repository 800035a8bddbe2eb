#include "app/sweep/threshold.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace recoil::app::threshold_test {
namespace {

/// Answers until nothing more is wanted.
Threshold searched(std::vector<double> points, double within, const std::function<bool(double)>& holds,
                   std::size_t most = 1) {
  Threshold t(std::move(points), within);
  for (auto next = t.wanted(most); !next.empty(); next = t.wanted(most)) {
    for (const double x : next) t.learn(x, holds(x));
    if (t.runs() > 200) throw std::logic_error("the search does not end");
  }
  return t;
}

TEST(Threshold, BisectsToTheTolerance) {
  for (const double place : {201.0, 333.3, 500.0, 799.0}) {
    const Threshold t = searched({200, 800}, 2, [&](double v) { return v > place; });
    EXPECT_LE(t.half_width(), 2);
    EXPECT_NEAR(t.middle(), place, t.half_width() * (1 + 1e-12)) << place;
    EXPECT_TRUE(t.holds_above());
    EXPECT_EQ(t.changes(), 1U);
    EXPECT_LE(t.runs(), 2U + 8U);  // 600 / 2^8 < 4
  }
}

TEST(Threshold, AFallingRangeAndAConditionThatHoldsBelow) {
  const Threshold t = searched({-5, -10, -15, -20}, 0.1, [](double a) { return a < -12.25; });
  EXPECT_NEAR(t.middle(), -12.25, 0.1);
  EXPECT_FALSE(t.holds_above());
}

TEST(Threshold, PointsBetweenAreTriedAtOnce) {
  Threshold t({0, 1}, 0.01);
  EXPECT_EQ(t.wanted(3), (std::vector<double>{0, 1}));
  t.learn(0, false);
  t.learn(1, true);
  EXPECT_EQ(t.wanted(3), (std::vector<double>{0.25, 0.5, 0.75}));
  const Threshold found = searched(
      {0, 1}, 0.001, [](double x) { return x > 0.7; }, 3);
  EXPECT_NEAR(found.middle(), 0.7, 0.001);
}

TEST(Threshold, NoChangeEndsAtOnce) {
  const Threshold never = searched({1, 2, 3}, 0.1, [](double) { return false; });
  EXPECT_EQ(never.runs(), 3U);
  EXPECT_EQ(never.changes(), 0U);
  EXPECT_TRUE(std::isnan(never.middle()));
  EXPECT_FALSE(never.holds_above());
  EXPECT_TRUE(searched({1, 2}, 0.1, [](double) { return true; }).holds_above());
}

TEST(Threshold, OfSeveralChangesTheFirst) {
  const Threshold t = searched({0, 1, 2, 3}, 0.01, [](double x) { return x > 0.5 && x < 2.5; });
  EXPECT_EQ(t.changes(), 2U);
  EXPECT_NEAR(t.middle(), 0.5, 0.01);
}

TEST(Threshold, EndsWhereNumbersEnd) {
  const Threshold t = searched({1, 1 + 3e-9}, 1e-12, [](double x) { return x > 1 + 1e-9; });
  EXPECT_LT(t.runs(), 20U);
}

}  // namespace
}  // namespace recoil::app::threshold_test
