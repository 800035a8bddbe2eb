#include "material/strength/strength.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "../samples.hpp"

namespace recoil::strength_test {
namespace {

TEST(Strength, YieldNeverFallsWithStrainOrRateNorRisesWithTemperature) {
  samples::for_each<Strength>([](const auto& s) {
    double before = 0;
    for (const double ep : {0.0, 1e-8, 1e-4, 0.01, 0.3, 2.0}) {
      const double y = s.yield({ep, 1e4, 400});
      EXPECT_GE(y, before) << s.kind;
      EXPECT_GE(s.yield({ep, 1e6, 400}), y) << s.kind;
      EXPECT_LE(s.yield({ep, 1e4, 700}), y) << s.kind;
      EXPECT_GE(s.yield({ep, 1e4, 400, 1e9}), y) << s.kind;
      EXPECT_GE(s.yield({ep, 1e4, 400, -50e9}), 0) << s.kind;
      before = y;
    }
  });
}

TEST(Strength, SaysWhetherItDependsOnTemperature) {
  samples::for_each<Strength>([]<class Model>(const Model& s) {
    const double cold = s.yield({0.1, 1e4, 320}), hot = s.yield({0.1, 1e4, 700});
    EXPECT_EQ(temperature_dependent<Model>(), cold != hot) << s.kind;
  });
}

TEST(Strength, OnlyFluidsHaveNoShearModulus) {
  samples::for_each<Strength>([](const auto& s) {
    const std::vector<Strength> list{s};
    EXPECT_EQ(shear_modulus(list[0]), s.shear_modulus);
    EXPECT_EQ(has_strength(list[0]), std::string(s.kind) != "none");
  });
  EXPECT_TRUE(std::isinf(Elastic{1e9}.yield({1, 1, 1e5})));
}

TEST(JohnsonCook, FollowsItsFormula) {
  const JohnsonCook s{47.7e9, 90e6, 292e6, .31, .025, 1.09, 1356};
  const double t = (600.0 - 298) / (1356 - 298);
  const double y = (90e6 + 292e6 * std::pow(0.2, .31)) * (1 + .025 * std::log(1e5)) * (1 - std::pow(t, 1.09));
  EXPECT_NEAR(s.yield({0.2, 1e5, 600}), y, 1e-6);
  EXPECT_NEAR(s.yield({0, 0, 298}), 90e6, 1e-6);
  EXPECT_NEAR(s.yield({0, 0.1, 200}), 90e6, 1e-6) << "no rate below 1/s, no hardening by cold";
  EXPECT_EQ(s.yield({0.5, 1e6, 1356}), 0) << "melted";
  EXPECT_EQ(s.yield({0.5, 1e6, 5000}), 0) << "melted";
}

TEST(JohnsonCook, NoRateTermWhereItsConstantIsZero) {
  JohnsonCook s{47.7e9, 90e6, 292e6, .31, .025, 1.09, 1356};
  s.c = 0;
  EXPECT_EQ(s.yield({0.2, 1e6, 400}), s.yield({0.2, 0, 400}));
}

TEST(JohnsonCook, ExpansionHasTheSlopesOfTheYieldStress) {
  for (const JohnsonCook& s : samples::of(JohnsonCook{})) {
    const double ep = 0.05, rate = std::log(1e4), h = 1e-5;
    const auto at = s.expand(ep, rate);
    EXPECT_NEAR(at.yield, s.yield({ep, 1e4, 298}), 1e-12 * at.yield);
    const double by_ep =
        (s.expand(ep + h * ep, rate).yield - s.expand(ep - h * ep, rate).yield) / (2 * h * ep);
    const double by_rate = (s.expand(ep, rate + h).yield - s.expand(ep, rate - h).yield) / (2 * h);
    EXPECT_NEAR(at.by_ep, by_ep, 1e-5 * by_ep);
    EXPECT_NEAR(at.by_log_rate, by_rate, 1e-5 * by_rate + 1);
  }
}

TEST(JohnsonCook, HardeningNearAStrainIsThatOfThePower) {
  for (const JohnsonCook& s : samples::of(JohnsonCook{}))
    for (const double ep : {1e-6, 0.05, 2.0})
      for (const double part : {0.0, 1e-12, 1e-5, 3e-3, 0.0099, 0.02, 1.0}) {
        const double exact = s.hardening(ep * (1 + part));
        EXPECT_NEAR(s.hardening(s.hardened(ep), ep * part), exact, 1e-15 * (1 + s.n) * exact)
            << ep << " " << part;
      }
}

/// Of the source for OFHC copper: 65 MPa + 890 MPa sqrt(0.2) exp(-298 (0.0028 - 0.000115 ln 1000)).
TEST(ZerilliArmstrong, FollowsItsFormulaForBothCrystals) {
  const auto samples = samples::of(ZerilliArmstrong{});
  EXPECT_NEAR(samples[0].yield({0.2, 1e3, 298}), 283.947e6, 1e3);
  const double thermal = std::exp(-298 * (.00698 - .000415 * std::log(1e3)));
  EXPECT_NEAR(samples[1].yield({0.1, 1e3, 298}), 65e6 + 1033e6 * thermal + 266e6 * std::pow(0.1, .289), 1);
  EXPECT_EQ(samples[1].yield({0.1, 1, 298}), samples[1].yield({0.1, 1e-4, 298}));
}

/// Copper at 10 GPa, 8 % compressed and 600 K, written out; the melting point follows Lindemann's law.
TEST(SteinbergGuinan, FollowsItsFormula) {
  const SteinbergGuinan s = samples::of(SteinbergGuinan{})[0];
  const double state = 1 + 28.3e-12 * 10e9 / std::cbrt(1.08) - .377e-3 * 300;
  EXPECT_NEAR(s.yield({.ep = 0.1, .temperature = 600, .pressure = 10e9, .compression = 1.08}),
              0.12e9 * std::pow(1 + 36 * 0.1, .45) * state, 1);
  EXPECT_NEAR(s.yield({.ep = 100, .temperature = 300}), 0.64e9, 1) << "hardening ends";
  EXPECT_NEAR(s.melting_at(1), 1790, 1e-9);
  EXPECT_EQ(s.yield({.temperature = 1800}), 0);
  EXPECT_GT(s.yield({.temperature = 1800, .compression = 1.1}), 0) << "compressed matter melts later";
}

/// The shear modulus follows the state as the yield stress does: with all of it their ratio stays.
TEST(SteinbergGuinan, ItsShearModulusFollowsTheState) {
  SteinbergGuinan s = samples::of(SteinbergGuinan{})[0];
  const YieldState pressed{.ep = 0.1, .temperature = 600, .pressure = 10e9, .compression = 1.08},
      rest{.ep = 0.1, .temperature = 300};
  EXPECT_FALSE(modulus_follows(s));
  EXPECT_EQ(s.modulus(pressed), s.shear_modulus);
  s.modulus_follows = 1;
  EXPECT_TRUE(modulus_follows(s));
  EXPECT_NEAR(s.modulus(pressed), 47.7e9 * (1 + 28.3e-12 * 10e9 / std::cbrt(1.08) - .377e-3 * 300), 1e-3);
  EXPECT_NEAR(s.modulus(pressed) / s.yield(pressed), s.modulus(rest) / s.yield(rest), 1e-9);
  EXPECT_GT(s.modulus({.temperature = 1e4}), 0) << "waves need one";
  s.modulus_follows = 0.5;
  EXPECT_NEAR(s.modulus(pressed) - s.shear_modulus,
              0.5 * 47.7e9 * (28.3e-12 * 10e9 / std::cbrt(1.08) - .377e-3 * 300), 1e-3);
  EXPECT_EQ(shear_modulus(Strength{s}, pressed), s.modulus(pressed));
  EXPECT_EQ(shear_modulus(Strength{Elastic{3e9}}, pressed), 3e9);
}

TEST(PrestonTonksWallace, HasItsLimits) {
  for (const PrestonTonksWallace& s : samples::of(PrestonTonksWallace{})) {
    const double g = 2 * s.shear_modulus, unit = s.gamma * s.unit_rate();
    EXPECT_NEAR(s.yield({100, 1e-3, 1e-9}), g * s.s0, 1e-6 * g) << "cold, hardened";
    const double thermal = std::erf(-s.kappa * 0.2 * std::log(1e3 / unit));
    EXPECT_NEAR(s.yield({0, 1e3, 0.2 * s.melting_temperature}),
                g * std::max(s.y0 - (s.y0 - s.y_inf) * thermal, s.y1 * std::pow(1e3 / unit, s.y2)), 1e-9 * g);
    EXPECT_NEAR(s.yield({0, 1e13, 300}), g * s.s0 * std::pow(1e13 / unit, s.beta), 1e-9 * g) << "overdriven";
    EXPECT_EQ(s.yield({0.1, 1e5, s.melting_temperature}), 0);
  }
}

TEST(PressureDependentYield, FollowsItsFormula) {
  const Lundborg rock{25e9, 50e6, 1.5, 2e9};
  EXPECT_NEAR(rock.yield({.pressure = 1e9}), 50e6 + 1.5e9 / (1 + 1.5 / 1.95), 1);
  EXPECT_NEAR(rock.yield({.pressure = 1e15}), 2e9, 1e4);
  EXPECT_NEAR(rock.yield({.pressure = -20e6}), 20e6, 1e-3);
  EXPECT_EQ(rock.yield({.pressure = -40e6}), 0);
  const DruckerPrager soil{1e9, 1e6, 0.6};
  EXPECT_NEAR(soil.yield({.pressure = 10e6}), 7e6, 1e-6);
  EXPECT_EQ(soil.yield({.pressure = -2e6}), 0);
}

TEST(Parameters, NameMembersOnceWithinTheirRange) {
  const auto check = [](const auto& model) {
    const auto list = model.parameters();
    for (std::size_t i = 0; i < list.size(); ++i) {
      const double value = model.*list[i].member;
      EXPECT_GE(value, list[i].minimum) << model.kind << " " << list[i].name;
      EXPECT_LE(value, list[i].maximum) << model.kind << " " << list[i].name;
      EXPECT_GT(std::string(list[i].doc).size(), 5u);
      for (std::size_t k = 0; k < i; ++k) {
        EXPECT_STRNE(list[i].name, list[k].name);
        EXPECT_NE(list[i].member, list[k].member);
      }
    }
  };
  samples::for_each<Strength>(check);
  samples::for_each<Eos>(check);
}

}  // namespace
}  // namespace recoil::strength_test
