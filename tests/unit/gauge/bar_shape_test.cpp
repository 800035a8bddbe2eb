#include "gauge/bar_shape.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <string>

#include "../support/small_case.hpp"

namespace recoil::bar_shape_test {
namespace {

/// A bar above a wall, cells of 0.25 mm that fit neither of them.
State<2> bar_on_wall(const std::string& shape, double wall_mm, const char* fall = "-100 m/s") {
  return state_of<2>(case_from(fmt::format(R"(
format = 1
[domain]
geometry = "axisymmetric"
r = ["0 mm", "6 mm"]
z = ["-2.09 mm", "14 mm"]
[mesh]
finest = "0.25 mm"
[time]
end = "1 us"
[body.wall]
rigid = true
shape = {{ kind = "half-space", point = {{ z = "{} mm" }}, normal = {{ z = 1 }} }}
[body.bar]
material = "none"
velocity = {{ z = "{}" }}
shape = {}
)",
                                           wall_mm, fall, shape)));
}

BarReading reading(const State<2>& state, BarWatch bar = {1, 0, true, 0}) {
  ExactSums sums;
  const int item = bar_item(state.grid(), sums);
  collect_bar(state, bar, item, sums);
  sums.reduce(parallel::World{});
  return read_bar(state.grid(), bar, sums.total(item));
}

const char* straight = R"({ kind = "cylinder", radius = "3.2 mm", z = ["0 mm", "10.1 mm"] })";

TEST(BarShape, OfABarThatStands) {
  const BarReading r = reading(bar_on_wall(straight, 0));
  EXPECT_NEAR(r.length, 10.1e-3, 1e-9);
  EXPECT_NEAR(r.foot_radius, 3.2e-3, 1e-9);
  EXPECT_NEAR(r.radius, 3.2e-3, 1e-9);
  EXPECT_NEAR(r.volume_radius, 3.2e-3, 1e-6);
  EXPECT_NEAR(r.contact_radius, 3.2e-3, 0.13e-3);
  EXPECT_NEAR(r.lift_off, 0, 1e-9);
  EXPECT_EQ(r.plastic_strain, 0);
}

TEST(BarShape, OfABarAboveTheWall) {
  const BarReading r = reading(bar_on_wall(straight, -0.1));
  EXPECT_NEAR(r.length, 10.1e-3, 1e-9);
  EXPECT_EQ(r.contact_radius, 0);
  EXPECT_NEAR(r.lift_off, 0.1e-3, 1e-9);
}

// The foot touches up to 2 mm and rises from there to 0.2 mm at its edge of 4 mm.
TEST(BarShape, OfAFootThatLiftsOff) {
  const BarReading r = reading(bar_on_wall(
      R"({ kind = "polygon", vertices = [["0 mm", "0 mm"], ["2 mm", "0 mm"], ["4 mm", "0.2 mm"], ["4 mm", "1.4 mm"],
         ["2.5 mm", "3 mm"], ["2.5 mm", "10 mm"], ["0 mm", "10 mm"]] })",
      0));
  EXPECT_NEAR(r.foot_radius, 4e-3, 1e-6);
  EXPECT_NEAR(r.contact_radius, 2.25e-3, 0.05e-3) << "0.1 dx is reached there";
  EXPECT_NEAR(r.lift_off, 0.18e-3, 0.01e-3) << "at 3.8 mm";
  EXPECT_NEAR(r.rim_lift_off, 0.19e-3, 0.015e-3) << "at the last centre of a cell before 4 mm";
}

TEST(BarShape, FootRadiusIsThatOfTheFoot) {
  const State<2> state = bar_on_wall(
      R"({ kind = "polygon", vertices = [["0 mm", "0 mm"], ["2 mm", "0 mm"], ["2 mm", "6 mm"], ["4 mm", "7 mm"],
         ["4 mm", "10 mm"], ["0 mm", "10 mm"]] })",
      0);
  const BarReading r = reading(state);
  EXPECT_NEAR(r.foot_radius, 2e-3, 1e-6);
  EXPECT_NEAR(r.radius, 4e-3, 1e-6);
  const BarReading other_end = reading(state, {1, 0, false, 0});
  EXPECT_NEAR(other_end.foot_radius, 4e-3, 1e-6);
  EXPECT_NEAR(other_end.length, 10e-3, 1e-9);
}

}  // namespace
}  // namespace recoil::bar_shape_test
