#include "kernels/row_kernels.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace recoil::detail::row_kernels_test {
namespace {

constexpr double rho = 8000, sound = 5000, at_rest = 0, jump = 1e6, half = 0.5;
const AtRest rest(1e-9, 0.1);

/// The waves along the axis between two cells at rest whose stress differs by `jump`.
struct Normal {
  double mass = 0, normal = 0, power = 0, speed = 0, rho_behind = 0, p_behind = 0, kinetic = 0, work = 0,
         inverse = 0;

  explicit Normal(const double* pull) {
    const double p_high = -jump;
    solve_normal_waves(1, rest, {&rho, &at_rest, &at_rest, &at_rest, &sound},
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

/// The waves between two cells of these velocities and stresses.
std::array<double, 4> passed(double u, double stress) {
  double mass = 1, normal = 1, power = 1, speed = 1, other = 0;
  solve_normal_waves(1, rest, {&rho, &u, &stress, &at_rest, &sound},
                     {&rho, &at_rest, &at_rest, &at_rest, &sound}, nullptr,
                     {&mass, &normal, &power, &speed, &other, &other, &other, &other, &other});
  return {mass, normal, power, speed};
}

TEST(NormalWaves, NothingPassesBetweenStatesAtRest) {
  EXPECT_EQ(passed(rest.speed, -rest.stress), (std::array<double, 4>{}));
  for (const double v : passed(2 * rest.speed, 0)) EXPECT_NE(v, 0);
  for (const double v : passed(0, 2 * rest.stress)) EXPECT_NE(v, 0);
  for (const double v : passed(std::nan(""), 0)) EXPECT_TRUE(std::isnan(v));
}

/// Shear waves between two cells at rest whose shear stress differs by `jump`.
struct Sheared {
  double momentum = 0, speed = 0, power = 0;

  explicit Sheared(const double* pull) {
    const double mass = 0, inverse = 1 / (rho * sound), modulus = 60e9;
    solve_shear_waves(1, rest, {&rho, &at_rest, &at_rest, &modulus}, {&rho, &at_rest, &jump, &modulus}, pull,
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

/// The values of a row at its faces, of cells that are 0 but for one.
struct Ends5 {
  static constexpr int count = 12, beyond = 2;
  std::array<double, count> low{}, high{};

  Ends5(double value, int at) {
    std::array<double, count + 2 * beyond> q{};
    q[static_cast<std::size_t>(at + beyond)] = value;
    reconstruct_plain(q.data() + beyond, 1, count, 1e-12, {}, {low.data(), high.data()});
  }
  bool zero_at(int i) const {
    const auto k = static_cast<std::size_t>(i);
    return low[k] == 0 && high[k] == 0 && !std::signbit(low[k]) && !std::signbit(high[k]);
  }
};

TEST(PlainValues, OfARowOfZerosAreZero) {
  const Ends5 zero(0, 0);
  for (int i = 0; i < Ends5::count; ++i) EXPECT_TRUE(zero.zero_at(i));
}

TEST(PlainValues, SeeWhatIsTwoCellsBeyondARowOfZeros) {
  for (const int at : {-2, Ends5::count + 1}) {
    const Ends5 one(1e-3, at);
    int changed = 0;
    for (int i = 0; i < Ends5::count; ++i) changed += one.zero_at(i) ? 0 : 1;
    EXPECT_EQ(changed, 1) << "cell " << at;
  }
}

TEST(Differences, SetAsIfAddedToZero) {
  const double area = 0, flux = 1;
  double set = 7, added = 0;
  set_difference(1, &area, &flux, &area, &flux, &set);
  add_difference(1, &area, &flux, &area, &flux, &added);
  EXPECT_EQ(set, 0);
  const double minus = -1;
  set_difference(1, &area, &minus, &area, &flux, &set);
  add_difference(1, &area, &minus, &area, &flux, &added);
  EXPECT_EQ(std::signbit(set), std::signbit(added)) << "0 + -0 is 0";
}

}  // namespace
}  // namespace recoil::detail::row_kernels_test
