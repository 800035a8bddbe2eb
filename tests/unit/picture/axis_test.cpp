#include "picture/axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace recoil {
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

}  // namespace
}  // namespace recoil
