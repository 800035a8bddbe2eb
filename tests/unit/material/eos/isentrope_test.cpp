#include "material/eos/isentrope.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../samples.hpp"

namespace recoil::isentrope_test {
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

/// Of a solid it has the density at which the energy that it gives up, the integral of p dv, leaves it
/// without pressure: copper behind a shock of 353 GPa.
TEST(Isentrope, OfASolidKeepsTheEntropyToo) {
  const MieGruneisen eos{8930, 3940, 1.489, 2.02};
  const double u = 4000, us = eos.c0 + eos.s * u, shocked = eos.rho0 * us / (us - u), p = eos.rho0 * us * u;
  const auto end = follow_isentrope(eos, shocked, p, 0, 0);
  EXPECT_TRUE(end.reached);
  double rho = shocked, e = eos.energy(rho, p);
  for (const double h = 1e-5; eos.pressure(rho, e) > 0;) {
    const double middle = rho * (1 - 0.5 * h), half = e - 0.5 * h * eos.pressure(rho, e) / rho;
    e -= h * rho * eos.pressure(middle, half) / (middle * middle);
    rho *= 1 - h;
  }
  EXPECT_NEAR(end.rho / rho, 1, 3e-3);
  EXPECT_NEAR(follow_isentrope(eos, end.rho, 0, 0, p).rho / shocked, 1, 3e-3) << "and back";
  const auto pulled = follow_isentrope(eos, shocked, p, 0, -1e13);
  EXPECT_FALSE(pulled.reached);
  EXPECT_NEAR(pulled.rho, shocked * std::exp(-most_change), 1e-9 * shocked);
}

/// A state that is not a number ends the search; it must not go on for ever.
TEST(Isentrope, OfWhatIsNotANumberIsNotReached) {
  const MieGruneisen eos{8930, 3940, 1.489, 2.02};
  EXPECT_FALSE(follow_isentrope(eos, 8930, std::nan(""), 0, 0).reached);
  EXPECT_FALSE(follow_isentrope(eos, std::nan(""), 1e9, 0, 0).reached);
  EXPECT_FALSE(follow_isentrope(eos, 8930, 1e9, 0, std::nan("")).reached);
}

/// The same as the closed form has for a gas, whose speed of sound stays above the floor of walls.
TEST(Isentrope, FollowedStepByStepIsTheClosedForm) {
  const double rho = 5, p = 9e5, to = 3e5;
  EXPECT_NEAR(follow_isentrope(air(), rho, p, 0, to).rho / gas_isentrope(air(), rho, p, to)->rho, 1, 1e-3);
}

/// Products of a detonation have no state without pressure: where they expand into nothing, the factor of e
/// is where they end. Any other pressure has to be reached.
TEST(Isentrope, ProductsExpandIntoNothing) {
  const Jwl tnt = samples::of(Jwl{}).front();
  const double rho = 100, p = 5e7;
  const IsentropePoint nothing = follow_isentrope(tnt, rho, p, 0, 0);
  EXPECT_TRUE(nothing.reached);
  EXPECT_NEAR(nothing.rho, rho * std::exp(-most_change), 1e-9 * rho);
  EXPECT_FALSE(follow_isentrope(tnt, rho, p, 0, 1e5).reached);
  EXPECT_FALSE(follow_isentrope(air(), rho, p, 0, -1e5).reached);
  EXPECT_TRUE(is_gas(tnt) && is_gas(air()));
  EXPECT_FALSE(is_gas(IdealGas{.rho0 = 1000, .gamma = 4, .p0 = 1e5, .p_inf = 6e8}));
  EXPECT_FALSE(is_gas(MieGruneisen{8930, 3940, 1.49, 2.0}));
}

}  // namespace
}  // namespace recoil::isentrope_test
