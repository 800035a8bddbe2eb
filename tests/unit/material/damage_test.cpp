#include "material/damage/damage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "samples.hpp"

namespace recoil::damage_test {
namespace {

/// Every model: nothing grows at rest nor under pressure, damage grows with tension, and never falls.
TEST(Damage, GrowsInTensionOnly) {
  samples::for_each<Damage>([](const auto& model) {
    const DamagePoint rest{.temperature = 300, .dt = 1e-9};
    EXPECT_EQ(model.growth(rest), 0) << model.kind;
    DamagePoint pressed = rest;
    pressed.pressure = 10e9, pressed.principal = -9e9, pressed.equivalent = 1e9;
    EXPECT_EQ(model.growth(pressed), 0) << model.kind;
    double last = 0;
    for (const double tension : {0.5e9, 2e9, 5e9, 20e9}) {
      DamagePoint pulled = rest;
      pulled.pressure = -tension, pulled.principal = tension, pulled.equivalent = 0.5e9;
      pulled.strain_growth = 1e-3;
      const double growth = model.growth(pulled);
      EXPECT_GE(growth, last) << model.kind << ' ' << tension;
      last = growth;
    }
    EXPECT_EQ(last > 0, model.kind != std::string("none")) << model.kind;
  });
}

/// Twice the threshold for the time tau: failed.
TEST(Damage, TensileModelFailsAfterItsTime) {
  const TensileDamage model{1e9, 1, 20e-9};
  const DamagePoint at{.principal = 2e9, .dt = 1e-9};
  double damage = 0;
  for (int k = 0; k < 20; ++k) damage += model.growth(at);
  EXPECT_NEAR(damage, 1, 1e-12);
  const TensileDamage square{1e9, 2, 20e-9};
  EXPECT_NEAR(square.growth({.principal = 4e9, .dt = 1e-9}), 9.0 / 20, 1e-12);
}

/// Johnson & Cook (1985), 4340 steel: D1 0.05, D2 3.44, D3 -2.12, D4 0.002, D5 0.61.
TEST(Damage, JohnsonCookStrainToFailure) {
  const JohnsonCookDamage steel{0.05, 3.44, -2.12, 0.002, 0.61, 1793, 294, 1};
  EXPECT_NEAR(steel.failure_strain(1.0 / 3, 1, 294), 0.05 + 3.44 * std::exp(-2.12 / 3), 1e-12);
  EXPECT_NEAR(steel.failure_strain(0, std::exp(5.0), 294) / (0.05 + 3.44), 1.01, 1e-12);
  EXPECT_NEAR(steel.failure_strain(0, 1, 0.5 * (1793 + 294)) / (0.05 + 3.44), 1 + 0.61 / 2, 1e-12);
  EXPECT_EQ(steel.failure_strain(3, 1, 294), steel.failure_strain(1.5, 1, 294));
  const DamagePoint at{
      .pressure = -1e9 / 3, .equivalent = 1e9, .strain_growth = 0.1, .temperature = 294, .dt = 1};
  EXPECT_NEAR(steel.growth(at), 0.1 / steel.failure_strain(1.0 / 3, 0.1, 294), 1e-12);
}

/// Failed once the plastic work of the largest principal stress is W.
TEST(Damage, CockcroftAndLathamCountWorkUnderTension) {
  const CockcroftLatham model{1516e6};
  const DamagePoint at{.principal = 758e6, .pressure = 200e6, .strain_growth = 0.1};
  EXPECT_NEAR(model.growth(at), 0.05, 1e-15);
}

TEST(Damage, WeakensWhatItHasDamaged) {
  const Damage weakening = CockcroftLatham{400e6, 0.3};
  EXPECT_EQ(strength_left(weakening, 0), 1);
  EXPECT_NEAR(strength_left(weakening, 0.5), 0.85, 1e-15);
  EXPECT_NEAR(strength_left(weakening, 2), 0.7, 1e-15) << "beyond 1 only within a step";
  EXPECT_EQ(strength_left(CockcroftLatham{400e6}, 0.5), 1);
  EXPECT_EQ(strength_left(TensileDamage{1e9, 1, 20e-9}, 0.5), 1);
}

/// Growth alone is exponential: f = f0 exp(3/4 (s - s_g) t/eta), whatever the steps.
TEST(Damage, VoidsGrowExponentially) {
  const VoidGrowth model{1e12, 1e9, 0, 1e-6, 0.3e9, 40, 0.3};
  for (const int steps : {1, 10, 100}) {
    double damage = 0.01;
    for (int k = 0; k < steps; ++k)
      damage += model.growth({.damage = damage, .pressure = -1.3e9, .dt = 100e-9 / steps});
    EXPECT_NEAR(damage / (0.01 * std::exp(0.75 * 1e9 * 100e-9 / 40)), 1, 1e-12) << steps;
  }
}

TEST(Damage, FailedMatterBearsAsMuchAsItsFriction) {
  const FailedMatter failed{10e6, 0.5};
  EXPECT_DOUBLE_EQ(failed.limit(100e6), 60e6);
  EXPECT_DOUBLE_EQ(failed.limit(-100e6), 10e6);
}

}  // namespace
}  // namespace recoil::damage_test
