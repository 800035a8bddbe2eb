#include "material/strength/strength.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "../samples.hpp"

namespace recoil {
namespace {

TEST(Strength, YieldNeverFallsWithStrainOrRateNorRisesWithTemperature) {
  samples::for_each<Strength>([](const auto& s) {
    double before = 0;
    for (const double ep : {0.0, 1e-8, 1e-4, 0.01, 0.3, 2.0}) {
      const double y = s.yield(ep, 1e4, 400);
      EXPECT_GE(y, before) << s.kind;
      EXPECT_GE(s.yield(ep, 1e6, 400), y) << s.kind;
      EXPECT_LE(s.yield(ep, 1e4, 700), y) << s.kind;
      before = y;
    }
  });
}

TEST(Strength, OnlyFluidsHaveNoShearModulus) {
  samples::for_each<Strength>([](const auto& s) {
    const std::vector<Strength> list{s};
    EXPECT_EQ(shear_modulus(list[0]), s.shear_modulus);
    EXPECT_EQ(has_strength(list[0]), std::string(s.kind) != "none");
  });
  EXPECT_TRUE(std::isinf(Elastic{1e9}.yield(1, 1, 1e5)));
}

TEST(JohnsonCook, FollowsItsFormula) {
  const JohnsonCook s{47.7e9, 90e6, 292e6, .31, .025, 1.09, 1356};
  const double t = (600.0 - 298) / (1356 - 298);
  const double y = (90e6 + 292e6 * std::pow(0.2, .31)) * (1 + .025 * std::log(1e5)) * (1 - std::pow(t, 1.09));
  EXPECT_NEAR(s.yield(0.2, 1e5, 600), y, 1e-6);
  EXPECT_NEAR(s.yield(0, 0, 298), 90e6, 1e-6);
  EXPECT_NEAR(s.yield(0, 0.1, 200), 90e6, 1e-6) << "no rate below 1/s, no hardening by cold";
  EXPECT_EQ(s.yield(0.5, 1e6, 1356), 0) << "melted";
  EXPECT_EQ(s.yield(0.5, 1e6, 5000), 0) << "melted";
}

TEST(JohnsonCook, NoRateTermWhereItsConstantIsZero) {
  JohnsonCook s{47.7e9, 90e6, 292e6, .31, .025, 1.09, 1356};
  s.c = 0;
  EXPECT_EQ(s.yield(0.2, 1e6, 400), s.yield(0.2, 0, 400));
}

TEST(JohnsonCook, ExpansionHasTheSlopesOfTheYieldStress) {
  for (const JohnsonCook& s : samples::of(JohnsonCook{})) {
    const double ep = 0.05, rate = std::log(1e4), h = 1e-5;
    const auto at = s.expand(ep, rate);
    EXPECT_NEAR(at.yield, s.yield(ep, 1e4, 298), 1e-12 * at.yield);
    const double by_ep =
        (s.expand(ep + h * ep, rate).yield - s.expand(ep - h * ep, rate).yield) / (2 * h * ep);
    const double by_rate = (s.expand(ep, rate + h).yield - s.expand(ep, rate - h).yield) / (2 * h);
    EXPECT_NEAR(at.by_ep, by_ep, 1e-5 * by_ep);
    EXPECT_NEAR(at.by_log_rate, by_rate, 1e-5 * by_rate + 1);
  }
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
}  // namespace recoil
