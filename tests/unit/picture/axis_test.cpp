#include "picture/axis.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace recoil::axis_test {
namespace {

using Labels = std::vector<std::string>;

TEST(Axis, MarksAreRoundNumbers) {
  EXPECT_EQ(nice_ticks({0, 10}, 5).labels, (Labels{"0", "2", "4", "6", "8", "10"}));
  EXPECT_EQ(nice_ticks({-0.13, 0.31}, 4).labels, (Labels{"\u22120.1", "0.0", "0.1", "0.2", "0.3"}));
  EXPECT_EQ(nice_ticks({0, 1.2}, 6).labels, (Labels{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0", "1.2"}));
}

TEST(Axis, LargeAndSmallNumbersShareAPowerOfTen) {
  const Ticks large = nice_ticks({0, 2.5e9}, 5);
  EXPECT_EQ(large.exponent, 9);
  EXPECT_EQ(large.labels, (Labels{"0.0", "0.5", "1.0", "1.5", "2.0", "2.5"}));
  EXPECT_EQ(title_with_exponent("p [Pa]", large), "p [Pa]   ×10^{9}");
  EXPECT_EQ(nice_ticks({0, 4e-6}, 4).exponent, -6);
  EXPECT_EQ(nice_ticks({0, 450}, 4).exponent, 0);
}

TEST(Axis, NumberOfMarksIsNearTheOneWanted) {
  for (double size = 1e-7; size < 1e9; size *= 1.37) {
    const auto ticks = nice_ticks({0.3 * size, 1.3 * size}, 6);
    EXPECT_GE(ticks.at.size(), 3u) << size;
    EXPECT_LE(ticks.at.size(), 11u) << size;
    EXPECT_EQ(ticks.at.size(), ticks.labels.size());
  }
}

TEST(Axis, LogarithmicMarksAreDecades) {
  EXPECT_EQ(nice_ticks({1e-6, 1e-4, true}, 5).labels,
            (Labels{"10^{\u22126}", "10^{\u22125}", "10^{\u22124}"}));
  const AxisScale scale{0.01, 100, true};
  EXPECT_DOUBLE_EQ(scale.fraction(1), 0.5);
  EXPECT_TRUE(std::isnan(scale.fraction(-1)));
}

TEST(Axis, OneValueOrNoneStillMakesAnAxis) {
  for (const bool log : {false, true}) {
    Range range;
    EXPECT_LT(axis_around(range, 0.1, log).lo, axis_around(range, 0.1, log).hi);
    range.include(std::nan(""));
    range.include(5.0, log);
    EXPECT_LT(axis_around(range, 0.1, log).lo, 5);
    EXPECT_GT(axis_around(range, 0.1, log).hi, 5);
  }
  Range zero;
  zero.include(0);
  EXPECT_LT(axis_around(zero, 0).lo, axis_around(zero, 0).hi);
}

TEST(Axis, UnitsAreWrittenForPeople) {
  EXPECT_EQ(with_unit_symbols("time [us]"), "time [µs]");
  EXPECT_EQ(with_unit_symbols("mass [kg/m2]"), "mass [kg/m^{2}]");
  EXPECT_EQ(with_unit_symbols("a [m/s^2]"), "a [m/s^{2}]");
  EXPECT_EQ(with_unit_symbols("rate [s-1]"), "rate [s^{\u22121}]");
  EXPECT_EQ(with_unit_symbols("impulse [kg/(m s)]"), "impulse [kg/(m s)]");
  EXPECT_EQ(with_unit_symbols("friction [1]"), "friction");
  EXPECT_EQ(with_unit_symbols("[1]"), "");
  EXPECT_EQ(with_unit_symbols("m2 of it"), "m2 of it");
}

TEST(Axis, ShortLogarithmicAxesHaveEvenMarks) {
  const Ticks ticks = nice_ticks({3.1, 4.4, true}, 5);
  ASSERT_GE(ticks.at.size(), 3U);
  for (const double v : ticks.at) EXPECT_TRUE(v >= 3.1 && v <= 4.4);
}

RC_GTEST_PROP(AxisOfAnyStretch, MarksRiseWithinItAndAreFew, ()) {
  const double lo = *rc::gen::map(rc::gen::inRange(-1000000, 1000000), [](int n) { return n * 1e-3; });
  const int decades = *rc::gen::inRange(-9, 9), wanted = *rc::gen::inRange(1, 12);
  const double size = *rc::gen::inRange(1, 1000) * 0.01 * std::pow(10.0, decades);
  const AxisScale scale{lo, lo + std::max(size, 1e-9 * std::abs(lo)), false};
  const Ticks ticks = nice_ticks(scale, wanted);
  const double slack = 1e-6 * (scale.hi - scale.lo);
  RC_ASSERT(ticks.labels.size() == ticks.at.size());
  RC_ASSERT(ticks.at.size() <= 3U * static_cast<unsigned>(wanted) + 2);
  for (std::size_t k = 0; k < ticks.at.size(); ++k) {
    RC_ASSERT(ticks.at[k] >= scale.lo - slack && ticks.at[k] <= scale.hi + slack);
    if (k > 0) RC_ASSERT(ticks.at[k] > ticks.at[k - 1]);
  }
}

RC_GTEST_PROP(AxisOfAnyStretch, LogarithmicMarksRiseWithinIt, ()) {
  const double lo = std::pow(10.0, *rc::gen::inRange(-200, 200) * 0.1);
  const AxisScale scale{lo, lo * std::pow(10.0, *rc::gen::inRange(1, 300) * 0.05), true};
  const Ticks ticks = nice_ticks(scale, *rc::gen::inRange(1, 12));
  RC_ASSERT(ticks.labels.size() == ticks.at.size());
  for (std::size_t k = 0; k < ticks.at.size(); ++k) {
    RC_ASSERT(scale.fraction(ticks.at[k]) >= -1e-6 && scale.fraction(ticks.at[k]) <= 1 + 1e-6);
    if (k > 0) RC_ASSERT(ticks.at[k] > ticks.at[k - 1]);
  }
}

}  // namespace
}  // namespace recoil::axis_test
