#include "app/check/case_marks.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "../../support/small_case.hpp"

namespace recoil::app::case_marks_test {
namespace {

const char* swinging = R"(
format = 1
[domain]
geometry = "planar"
x = ["-4 mm", "4 mm"]
y = ["-2 mm", "2 mm"]
[mesh]
finest = "0.25 mm"
[time]
end = "1 us"
[body.plate]
material = "none"
shape = { kind = "box", x = ["-3 mm", "3 mm"], y = ["-1 mm", "1 mm"] }
velocity = { x = "3 m/s" }
velocity-field = { y = "1000 * x/s" }
)";

/// Arrows show the formulas and the rest of the velocity together, and the fastest says how fast.
TEST(CaseMarks, ArrowsFollowTheFormulas) {
  const config::Case c = case_from(swinging);
  const std::vector<StartMotion> motions = start_motions(c);
  ASSERT_EQ(motions.size(), 1U);
  ASSERT_TRUE(has_velocity_field(c, motions[0]));
  const auto arrows = field_arrows(c, motions[0], {{-2e-3, 0, 0}, {0, 0, 0}, {2.5e-3, 0.5e-3, 0}});
  ASSERT_EQ(arrows.size(), 3U);
  EXPECT_NEAR(arrows[0].velocity[0], 3, 1e-9);
  EXPECT_NEAR(arrows[0].velocity[1], -2, 1e-9);
  EXPECT_NEAR(arrows[2].velocity[1], 2.5, 1e-9);
  EXPECT_EQ(arrows[0].label, "");
  EXPECT_EQ(arrows[2].label, "3 m/s, by formulas: 3.905 m/s here");
}

TEST(CaseMarks, WhatIsSlowHasNoArrow) {
  config::Case c = case_from(swinging);
  c.bodies[0].velocity = {};
  const auto arrows = field_arrows(c, start_motions(c).at(0), {{-2e-3, 0, 0}, {0.1e-3, 0, 0}});
  ASSERT_EQ(arrows.size(), 1U);
  EXPECT_NEAR(arrows[0].at[0], -2e-3, 1e-12);
  EXPECT_TRUE(field_arrows(c, start_motions(c).at(0), {}).empty());
}

TEST(CaseMarks, PlacesAreSpreadOverWhatIsInside) {
  const auto inside = [](int i, int j) { return i >= 100 && i < 170 && j >= 20 && j < 25; };
  const auto places = spread_inside(400, 300, inside);
  ASSERT_EQ(places.size(), 7U);
  for (const auto& [i, j] : places) {
    EXPECT_TRUE(inside(i, j));
    EXPECT_EQ(j, 22);
  }
  EXPECT_EQ(places[0][0] - 100, 169 - places[6][0] + 1);
  EXPECT_TRUE(spread_inside(10, 10, [](int, int) { return false; }).empty());
}

}  // namespace
}  // namespace recoil::app::case_marks_test
