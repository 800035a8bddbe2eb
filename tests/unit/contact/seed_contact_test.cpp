#include "contact/seed_contact.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <vector>

namespace recoil::seed_contact_test {
namespace {

TEST(Colliding, TakesTheSizeOfTheGapOnly) {
  EXPECT_TRUE(colliding(-0.2, 0.6, 0.5, 1));
  EXPECT_FALSE(colliding(-0.2, 0.75, 0.5, 1));
  EXPECT_TRUE(colliding(-0.6, 0.2, 0.5, 1));   // an overlap counts like a gap,
  EXPECT_FALSE(colliding(-0.8, 0.2, 0.5, 1));  // and so is lost when it is deep
}

TEST(InterfaceTraction, TheNearerNodeWeighsMore) {
  EXPECT_DOUBLE_EQ(interface_traction({-4, 0.1}, {-8, 0.3}), -5);
  EXPECT_DOUBLE_EQ(interface_traction({-4, 0.3}, {-8, 0.1}), -7);
  EXPECT_DOUBLE_EQ(interface_traction({-4, 0}, {-8, 0.1}), -4);
  EXPECT_DOUBLE_EQ(interface_traction({-4, 0}, {-8, 0}), -6);
}

TEST(Presses, CompressionHoldsTensionParts) {
  EXPECT_TRUE(presses(-1, -5, true));
  EXPECT_TRUE(presses(-1, -5, false));
  EXPECT_FALSE(presses(1, 5, true));
}

TEST(Presses, FreeSurfacesMeetWhenTheyApproach) {
  EXPECT_TRUE(presses(0, 5, false));
  EXPECT_FALSE(presses(0, -5, false));
  EXPECT_FALSE(presses(0, 5, true));
}

TEST(Join, SharesVelocityAndStressOfTheRiemannProblem) {
  // Z 1 and 3, u 4 and 0 without stress: u = 1, sigma = -3.
  const Touch t = join({4, 0, 1}, {0, 0, 3});
  EXPECT_TRUE(t.touching);
  EXPECT_DOUBLE_EQ(t.first_velocity, 1);
  EXPECT_DOUBLE_EQ(t.second_velocity, 1);
  EXPECT_DOUBLE_EQ(t.traction, -3);
}

TEST(Join, AlsoPulls) {
  EXPECT_DOUBLE_EQ(join({-4, 0, 1}, {0, 0, 3}).traction, 3);
  EXPECT_DOUBLE_EQ(join_rigid({-4, 0, 2}, 0).traction, 8);
  EXPECT_DOUBLE_EQ(join_rigid({-4, 0, 2}, 1).first_velocity, 1);
}

/// The immediate neighbours of the origin inside the half plane y <= 0, without it.
std::vector<double> places_below() { return {-1, 0, 1, 0, -1, -1, 0, -1, 1, -1}; }

TEST(FitAtOrigin, IsExactForBilinearFields) {
  const std::vector<double> places = places_below();
  std::vector<double> values;
  for (std::size_t i = 0; i < 5; ++i) {
    const double x = places[2 * i], y = places[2 * i + 1];
    values.push_back(7 + 2 * x - 3 * y + 0.5 * x * y);
  }
  double at = 0;
  ASSERT_TRUE(fit_at_origin(2, places, values, at));
  EXPECT_NEAR(at, 7, 1e-12);
}

TEST(FitAtOrigin, IsExactForTrilinearFields) {
  std::vector<double> places, values;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 0; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        places.insert(places.end(), {1.0 * x, 1.0 * y, 1.0 * z});
        values.push_back(-3 + x - 2 * y + 4 * z + x * y * z - y * z);
      }
  double at = 0;
  ASSERT_TRUE(fit_at_origin(3, places, values, at));
  EXPECT_NEAR(at, -3, 1e-12);
}

TEST(FitAtOrigin, IsLeastSquaresWhereThereAreMore) {
  // On a line 1, x through three values: the best line at 0 is their mean, as x is balanced.
  const std::array<double, 3> places{-1, 0, 1}, values{1, 4, 1};
  double at = 0;
  ASSERT_TRUE(fit_at_origin(1, places, values, at));
  EXPECT_NEAR(at, 2, 1e-12);
}

TEST(FitAtOrigin, TooFewOrInOneRowIsNoField) {
  double at = 5;
  EXPECT_FALSE(fit_at_origin(1, std::array<double, 1>{-1}, std::array<double, 1>{2}, at));
  const std::array<double, 8> row{-2, 0, -1, 0, 1, 0, 2, 0};
  EXPECT_FALSE(fit_at_origin(2, row, std::array<double, 4>{1, 2, 3, 4}, at));
  EXPECT_EQ(at, 5);
}

}  // namespace
}  // namespace recoil::seed_contact_test
