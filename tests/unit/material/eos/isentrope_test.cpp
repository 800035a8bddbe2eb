#include "material/eos/isentrope.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace recoil {
namespace {

IdealGas air() { return {.rho0 = 1.2, .gamma = 1.4, .p0 = 1e5}; }

TEST(Isentrope, HasTheRarefactionOfTheClosedForm) {
  const double rho = 5, p = 9e5, c = std::sqrt(1.4 * 1e6 / rho);
  const auto end = gas_isentrope(air(), rho, p, 0);
  ASSERT_TRUE(end);
  EXPECT_NEAR(end->rho, rho * std::pow(0.1, 1 / 1.4), 1e-12 * rho);
  EXPECT_NEAR(end->speed, 5 * c * (1 - std::pow(0.1, 1.0 / 7)), 1e-10 * c);
}

/// Energy and speed at the end are the integrals of p d ln(rho)/rho and c d ln(rho), with the equation of
/// state's own pressure and speed of sound.
TEST(Isentrope, KeepsTheEntropy) {
  const IdealGas gas = air();
  for (const double to : {2e4, 5e6}) {
    double rho = 5, p = 9e5;
    const auto end = gas_isentrope(gas, rho, p, to);
    ASSERT_TRUE(end && end->reached);
    EXPECT_EQ(end->p, to);
    constexpr int steps = 20000;
    const double h = std::log(end->rho / rho) / steps;
    double e = gas.energy(rho, p), speed = 0;
    for (int k = 0; k < steps; ++k) {
      const double middle = rho * std::exp(0.5 * h), half = e + 0.5 * h * gas.pressure(rho, e) / rho;
      const double between = gas.pressure(middle, half);
      e += h * between / middle;
      speed -= h * std::sqrt(gas.sound_speed_squared(middle, between));
      rho *= std::exp(h);
    }
    EXPECT_NEAR(gas.pressure(rho, e) / to, 1, 1e-6);
    EXPECT_NEAR(end->speed / speed, 1, 1e-6);
  }
}

TEST(Isentrope, StopsAtTheMostExpansion) {
  const auto end = gas_isentrope(air(), 1.2, 0, -1e5);
  ASSERT_TRUE(end);
  EXPECT_FALSE(end->reached);
  EXPECT_NEAR(end->rho, 1.2 / most_expansion, 1e-12);
  EXPECT_GT(end->p, -1e5);
}

TEST(Isentrope, LiquidsAndSolidsHaveNone) {
  EXPECT_FALSE(gas_isentrope(IdealGas{.rho0 = 1000, .gamma = 4, .p0 = 1e5, .p_inf = 6e8}, 1000, 1e6, 0));
  EXPECT_FALSE(gas_isentrope(LinearEos{}, 1, 1, 0));
}

}  // namespace
}  // namespace recoil
