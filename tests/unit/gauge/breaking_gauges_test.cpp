/// Gauges of what breaks and passes: crater, residual, fragments, peak-tension, of states in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "../support/small_case.hpp"
#include "gauge/gauge_watch.hpp"

namespace recoil::breaking_gauges_test {
namespace {

/// What the only gauge of a case records of its start.
template <int Dim>
std::vector<double> first_row(const std::string& text) {
  const config::Case c = case_from(text);
  const State<Dim> state = state_of<Dim>(c);
  const parallel::World world;
  ExactSums sums;
  const RunUnits units = run_units(c.domain.geometry);
  std::vector<double> row;
  std::visit(
      [&](const auto& kind) {
        const auto watch = make_watch<Dim>(kind, WatchSetup<Dim>{c, state, sums});
        watch->collect(state, world, true, sums);
        sums.reduce(world);
        watch->read({0, 0, sums, {}, nullptr, units}, row);
        EXPECT_EQ(row.size(), column_list(kind.columns(), units).size());
      },
      c.gauges.front().kind);
  return row;
}

/// A block of 12 mm around the axis, from z = 0 on, with a pit of 4 mm radius and 3 mm depth; or a hole.
std::string pitted(const std::string& depth) {
  return R"(
format = 1
[domain]
geometry = "axisymmetric"
r = ["0 mm", "16 mm"]
z = ["-2 mm", "10 mm"]
[mesh]
finest = "0.25 mm"
[time]
end = "1 us"
[body.block]
material = "none"
shape = { kind = "difference", parts = [{ kind = "cylinder", radius = "12 mm", z = ["0 mm", "8 mm"] }, )"
         R"({ kind = "cylinder", radius = "4 mm", z = ["-1 mm", ")" +
         depth + R"("] }] }
[gauge.pit]
kind = "crater"
body = "block"
at = { z = "0 mm" }
direction = { z = -1 }
radius = "10 mm"
)";
}

TEST(Crater, OfAPitAndOfAHole) {
  const double area = std::numbers::pi * 16e-6;
  const auto pit = first_row<2>(pitted("3 mm")), hole = first_row<2>(pitted("9 mm"));
  EXPECT_NEAR(pit[0], 3e-3, 1e-9);
  EXPECT_NEAR(pit[1], 8e-3, 1e-9);
  EXPECT_NEAR(pit[2] / (3e-3 * area), 1, 1e-9);
  EXPECT_EQ(pit[3], 0) << "no hole";
  EXPECT_NEAR(hole[0], 0, 1e-12);
  EXPECT_NEAR(hole[1], 8e-3, 1e-9);
  EXPECT_NEAR(hole[2], 0, 1e-15);
  EXPECT_NEAR(hole[3], 8e-3, 1e-9);
}

/// A block with a square pit of 4 mm by 4 mm and 2 mm depth, in the whole domain or a quarter of it.
std::vector<double> square_pit(const std::string& sides) {
  return first_row<3>(
      R"(
format = 1
[domain]
geometry = "3d"
)" + sides +
      R"(
z = ["-6 mm", "2 mm"]
[mesh]
finest = "0.5 mm"
[time]
end = "1 us"
[body.block]
material = "none"
shape = { kind = "difference", parts = [{ kind = "box", x = ["-5 mm", "5 mm"], y = ["-5 mm", "5 mm"], z = ["-4 mm", "0 mm"] }, )"
      R"({ kind = "box", x = ["-2 mm", "2 mm"], y = ["-2 mm", "2 mm"], z = ["-2 mm", "1 mm"] }] }
[gauge.pit]
kind = "crater"
body = "block"
at = { z = "0 mm" }
direction = { z = 1 }
radius = "4 mm"
)");
}

TEST(Crater, ImagesBeyondPlanesOfSymmetryCountInTheDiameter) {
  const auto whole = square_pit("x = [\"-6 mm\", \"6 mm\"]\ny = [\"-6 mm\", \"6 mm\"]"),
             quarter = square_pit(
                 "x = [\"0 mm\", \"6 mm\"]\ny = [\"-6 mm\", \"0 mm\"]\nboundary = { x = "
                 "[\"symmetry\", \"outflow\"], y = [\"outflow\", \"symmetry\"] }");
  EXPECT_NEAR(whole[1], 2 * std::sqrt(16e-6 / std::numbers::pi), 1e-9);
  EXPECT_NEAR(quarter[0], whole[0], 1e-12);
  EXPECT_NEAR(quarter[1], whole[1], 1e-12);
  EXPECT_NEAR(quarter[2], 0.25 * whole[2], 1e-18) << "of what the domain holds";
  EXPECT_EQ(quarter[3], 0);
}

TEST(Crater, GoesOnAcrossTheEdgeOfAPeriod) {
  const auto row = first_row<2>(R"(
format = 1
[domain]
geometry = "planar"
x = ["-2 mm", "6 mm"]
y = ["0 mm", "16 mm"]
boundary = { x = "outflow", y = "periodic" }
[mesh]
finest = "0.5 mm"
[time]
end = "1 us"
[body.block]
material = "none"
shape = { kind = "union", parts = [{ kind = "box", x = ["0 mm", "4 mm"], y = ["3 mm", "14 mm"] }, )"
                                R"({ kind = "box", x = ["1 mm", "4 mm"], y = ["0 mm", "16 mm"] }] }
[gauge.pit]
kind = "crater"
body = "block"
at = { x = "0 mm", y = "16 mm" }
direction = { x = -1 }
radius = "4 mm"
)");
  EXPECT_NEAR(row[0], 1e-3, 1e-9);
  EXPECT_NEAR(row[1], 5e-3, 1e-9) << "2 mm before the edge and 3 mm behind it";
  EXPECT_NEAR(row[2], 5e-6, 1e-12);
}

TEST(Residual, IsThePartBeyondThePlane) {
  const auto row = first_row<2>(R"(
format = 1
[domain]
geometry = "planar"
x = ["0 mm", "20 mm"]
y = ["0 mm", "20 mm"]
[mesh]
finest = "0.5 mm"
[time]
end = "1 us"
[body.rod]
material = "none"
shape = { kind = "box", x = ["5 mm", "15 mm"], y = ["8 mm", "10 mm"] }
velocity = { x = "300 m/s", y = "400 m/s" }
[gauge.behind]
kind = "residual"
body = "rod"
at = { x = "11 mm", y = "9 mm" }
direction = { x = 1 }
)");
  const double mass = 1000 * 4e-3 * 2e-3;
  ASSERT_EQ(row.size(), 6U);
  EXPECT_NEAR(row[0], 300, 1e-9);
  EXPECT_NEAR(row[1], 400, 1e-9);
  EXPECT_NEAR(row[2], 500, 1e-9);
  EXPECT_NEAR(row[3] / mass, 1, 1e-12);
  EXPECT_NEAR(row[4] / (0.5 * mass * 25e4), 1, 1e-12);
  EXPECT_NEAR(row[5], std::atan2(4, 3), 1e-12);
}

const char* line = R"(
format = 1
[domain]
geometry = "1d"
x = ["0 mm", "20 mm"]
[mesh]
finest = "0.1 mm"
[time]
end = "1 us"
[body.plate]
material = "none"
shape = { kind = "box", x = ["5 mm", "10 mm"] }
velocity = { x = "200 m/s" }
)";

TEST(FragmentsGauge, OfAWholeBody) {
  const auto row = first_row<1>(std::string(line) + "[gauge.g]\nkind = \"fragments\"\nbody = \"plate\"\n");
  EXPECT_EQ(row[0], 1);
  EXPECT_NEAR(row[1], 5, 1e-12) << "kg/m2";
  EXPECT_NEAR(row[2], 200, 1e-9);
  EXPECT_EQ(row[3] + row[4] + row[5], 0);
  const auto small = first_row<1>(
      std::string(line) + "[gauge.g]\nkind = \"fragments\"\nbody = \"plate\"\nsmaller-than = \"6 mm\"\n");
  EXPECT_EQ(small[0], 0);
  EXPECT_EQ(small[3], 1);
  EXPECT_NEAR(small[4], 5, 1e-12);
}

TEST(PeakTension, OfMatterAtRestIsNone) {
  const auto row = first_row<1>(std::string(line) + "[gauge.g]\nkind = \"peak-tension\"\nbody = \"plate\"\n");
  ASSERT_EQ(row.size(), 6U);
  EXPECT_NEAR(row[0], 0, 1e-3);
  EXPECT_EQ(row[1], 0);
  EXPECT_GT(row[2], 5e-3);
  EXPECT_NEAR(row[3], 0, 1e-3);
}

}  // namespace
}  // namespace recoil::breaking_gauges_test
