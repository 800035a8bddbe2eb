#include "kernels/row_kernels.hpp"

#include <gtest/gtest.h>

namespace recoil::detail {
namespace {

constexpr double rho = 8000, sound = 5000, at_rest = 0, jump = 1e6, half = 0.5;

/// The waves along the axis between two cells at rest whose stress differs by `jump`.
struct Normal {
  double mass = 0, normal = 0, power = 0, speed = 0, rho_behind = 0, p_behind = 0, kinetic = 0, work = 0,
         inverse = 0;

  explicit Normal(const double* pull) {
    const double p_high = -jump;
    solve_normal_waves(1, {&rho, &at_rest, &at_rest, &at_rest, &sound},
                       {&rho, &at_rest, &jump, &p_high, &sound}, pull,
                       {&mass, &normal, &power, &speed, &rho_behind, &p_behind, &kinetic, &work, &inverse});
  }
};

TEST(NormalWaves, HalfOfTheJumpOfStressDrivesHalfTheVelocity) {
  const Normal whole(nullptr), part(&half);
  EXPECT_NEAR(whole.speed, jump / (2 * rho * sound), 1e-12);
  EXPECT_NEAR(part.speed, 0.5 * whole.speed, 1e-12);
  EXPECT_NEAR(part.normal, whole.normal, 1e-3 * jump) << "the star stress is the same but for the flow";
}

/// Shear waves between two cells at rest whose shear stress differs by `jump`.
struct Sheared {
  double momentum = 0, speed = 0, power = 0;

  explicit Sheared(const double* pull) {
    const double mass = 0, inverse = 1 / (rho * sound);
    solve_shear_waves(60e9, 1, {&rho, &at_rest, &at_rest}, {&rho, &at_rest, &jump}, pull,
                      {&mass, &at_rest, &inverse}, {&momentum, &speed, &power});
  }
};

TEST(ShearWaves, HalfOfTheJumpOfStressDrivesHalfTheVelocity) {
  const Sheared whole(nullptr), part(&half);
  EXPECT_GT(whole.speed, 0);
  EXPECT_DOUBLE_EQ(part.speed, 0.5 * whole.speed);
  EXPECT_EQ(part.momentum, whole.momentum) << "the star stress is the same";
  EXPECT_DOUBLE_EQ(part.power, 0.5 * whole.power) << "work is the star stress times the star velocity";
}

}  // namespace
}  // namespace recoil::detail
