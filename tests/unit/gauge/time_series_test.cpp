#include "gauge/time_series.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace recoil::time_series_test {
namespace {

const Curve ramp{{0, 1, 3}, {0, 2, 2}};  // up to 2 in 1 s, then level

TEST(TimeSeries, ReadsBetweenRecords) {
  EXPECT_DOUBLE_EQ(value_at(ramp, 0.25), 0.5);
  EXPECT_DOUBLE_EQ(value_at(ramp, 2), 2);
  EXPECT_DOUBLE_EQ(value_at(ramp, 3), 2);
  EXPECT_DOUBLE_EQ(value_at(ramp, 3 * (1 + 1e-12)), 2) << "round-off in the end of a run";
  EXPECT_TRUE(std::isnan(value_at(ramp, 3.1)));
  EXPECT_TRUE(std::isnan(value_at(Curve{}, 0)));
}

TEST(TimeSeries, MeansAreExactForStraightLines) {
  EXPECT_DOUBLE_EQ(mean_over(ramp, 0, 1), 1);
  EXPECT_DOUBLE_EQ(mean_over(ramp, 0.5, 2), (0.5 * 1.5 + 1 * 2) / 1.5);
  EXPECT_DOUBLE_EQ(rms_over(ramp, 0, 1), 2 / std::sqrt(12.0));
  EXPECT_DOUBLE_EQ(rms_over(ramp, 1, 3), 0);
  EXPECT_DOUBLE_EQ(slope_over(ramp, 0.25, 0.75), 2);
  EXPECT_NEAR(slope_over(ramp, 1, 3), 0, 1e-15);
  EXPECT_TRUE(std::isnan(slope_over(ramp, 1, 9)));
  EXPECT_TRUE(std::isnan(mean_over(ramp, 2, 4)));
  EXPECT_DOUBLE_EQ(distance_over(ramp, {{0, 3}, {2, 2}}, 0, 3), 1.0 / 3);
}

TEST(TimeSeries, PeaksAndArrivals) {
  const Curve pushed{{0, 1, 2, 3}, {0, -1, -5, 2}};
  EXPECT_EQ(peak_of(pushed).value, -5);
  EXPECT_EQ(peak_of(pushed).time, 2);
  EXPECT_DOUBLE_EQ(arrival_at(pushed, -3), 1.5);
  EXPECT_DOUBLE_EQ(arrival_at(pushed, 1), 3 - 1.0 / 7);
  EXPECT_TRUE(std::isnan(arrival_at(pushed, 7)));
  EXPECT_DOUBLE_EQ(arrival_of(pushed), 1 + 1.5 / 4);
  EXPECT_TRUE(std::isnan(arrival_of({{0, 1}, {4, 4}})));
}

TEST(TimeSeries, ColumnsByName) {
  TimeSeries line{"a", {{"velocity.x", "m/s"}, {"mass", "kg"}}, {0, 1, 2}, {{1, NAN, 3}, {0, 0, 0}}};
  EXPECT_EQ(line.find("velocity.x"), 0U);
  EXPECT_EQ(line.find("velocity"), 0U) << "one component only";
  EXPECT_EQ(line.find("veloc"), 2U);
  line.columns.push_back({"velocity.y", "m/s"});
  EXPECT_EQ(line.find("velocity"), 3U);
  const Curve curve = curve_of(line, 0);
  EXPECT_EQ(curve.t, (std::vector<double>{0, 2})) << "records without a value do not count";
}

}  // namespace
}  // namespace recoil::time_series_test
