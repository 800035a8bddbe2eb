#include "dynamics/half_step/loading.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../material/alumina.hpp"
#include "../material/samples.hpp"

namespace recoil::loading_test {
namespace {

using C = Components<2>;

Primitives<2> state_with(double s_xx, double s_xy) {
  Primitives<2> w{};
  w[C::rho] = 8930;
  w[C::s] = s_xx;
  w[C::s + C::stress(0, 1)] = s_xy;
  return w;
}

double size(const Primitives<2>& w) { return std::sqrt(equivalent_stress_squared<2>(w.data() + C::s, 1)); }

/// Pure shear at yield that a turned strain rate has moved: it is turned, and as large as before.
TEST(KeepAtYield, TurnsAStressAndKeepsItsSize) {
  const auto before = state_with(0, 0.1e9);
  auto moved = state_with(0.4e9, 0.1e9);
  keep_at_yield<2>(before, before, moved);
  EXPECT_NEAR(size(moved), size(before), 1e-9 * size(before));
  EXPECT_NEAR(moved[C::s] / moved[C::s + C::stress(0, 1)], 4, 1e-12);
}

TEST(KeepAtYield, TheLargerOfTheEndAndTheMeanCounts) {
  const auto end = state_with(0, 0.1e9), mean = state_with(0, 0.3e9);
  auto moved = state_with(0.1e9, 0.1e9);
  const auto as_moved = moved;
  keep_at_yield<2>(end, mean, moved);
  EXPECT_EQ(moved, as_moved);
}

TEST(KeepAtYield, OfAMeltNothingIsLeft) {
  auto moved = state_with(0.1e9, 0.2e9);
  keep_at_yield<2>(state_with(0, 0), state_with(0, 0), moved);
  EXPECT_EQ(size(moved), 0);
}

TEST(Loading, IsOfYieldingMatterAndOfAMelt) {
  Body<2> body;
  body.material = samples::copper();
  const auto with_yield = [&](double a) {
    body.material.strength = JohnsonCook{43e9, a, 0, 1.0, 0, 1.09, 1358};
  };
  with_yield(0.3e9);
  EXPECT_EQ(loading_of<2>(body, state_with(0, 0)), 0);
  EXPECT_EQ(loading_of<2>(body, state_with(0, 0.1e9)), 0);
  const double s = 0.3e9 / std::sqrt(3.0);  // |S|^2 = 2 s^2
  EXPECT_NEAR(loading_of<2>(body, state_with(0, s)) * std::sqrt(2.0) * s, 1, 1e-12);
  with_yield(0);
  EXPECT_EQ(loading_of<2>(body, state_with(0, 0)), loading_of_melt);
}

/// A ceramic yields at a stress that falls as it is fractured.
TEST(Loading, KnowsTheDamageOfACeramic) {
  Body<2> body;
  body.material = samples::alumina();
  const double pressure = 2e9;
  const auto yielding = [&](double damage) {
    const YieldState state{.pressure = pressure, .damage = damage};
    return yield(body.material.strength, state, 1, 0);
  };
  const auto loads = [&](double damage, double part) {
    auto w = state_with(0, part * yielding(damage) / std::sqrt(3.0));
    w[C::rho] = density(body.material);
    w[C::p] = pressure;
    w[C::damage] = damage;
    return loading_of<2>(body, w) > 0;
  };
  ASSERT_LT(yielding(1), 0.9 * yielding(0));
  for (const double damage : {0.0, 0.5, 1.0}) {
    EXPECT_TRUE(loads(damage, 1.01)) << damage;
    EXPECT_FALSE(loads(damage, 0.97)) << damage;
  }
}

}  // namespace
}  // namespace recoil::loading_test
