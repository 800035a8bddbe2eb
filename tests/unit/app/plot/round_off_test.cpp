#include "app/plot/round_off.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace recoil::app::round_off_test {
namespace {

const RoundOff copper{
    .stress = 20, .speed = 5e-7, .density = 9e-7, .temperature = 6e-6, .length = 1e-14, .number = 1e-10};

TEST(RoundOff, IsKnownByTheUnit) {
  EXPECT_DOUBLE_EQ(copper.in(unit_in("pressure [GPa]")), 2e-8);
  EXPECT_DOUBLE_EQ(copper.in(unit_in("velocity x [m/s]")), 5e-7);
  EXPECT_DOUBLE_EQ(copper.in(unit_in("plastic strain")), 1e-10);
  EXPECT_DOUBLE_EQ(copper.in(unit_in("mass [kg]")), 0);
}

TEST(RoundOff, NoiseIsNoPhysics) {
  const auto judge = [](double lowest, double highest) {
    return copper.judge("GPa", lowest, highest, RoundOff::of_dumps);
  };
  EXPECT_EQ(judge(-9e-14, 5e-14), Spread::round_off);  // a disc in free flight
  EXPECT_EQ(judge(-1e-6, 1e-6), Spread::real);         // 1 kPa, a loud sound
  EXPECT_EQ(judge(0, 0), Spread::real);
  EXPECT_EQ(judge(5, 5 + 1e-9), Spread::uniform);
  EXPECT_EQ(copper.judge("m/s", 984.8078, 984.8079, RoundOff::of_dumps), Spread::uniform);
  EXPECT_EQ(copper.judge("m/s", 984.8078, 984.8079, RoundOff::of_tables), Spread::real);
  EXPECT_EQ(copper.judge("J", 1e-20, 2e-20, RoundOff::of_dumps), Spread::real);
}

TEST(RoundOff, TheScaleIsNotNarrower) {
  const auto both = honest_range(Spread::round_off, 2e-8, -9e-14, 5e-14, true);
  EXPECT_EQ(both, std::make_pair(-2e-8, 2e-8));
  const auto one = honest_range(Spread::round_off, 2e-8, 1e-15, 9e-14, false);
  EXPECT_EQ(one, std::make_pair(0.0, 2e-8));
  const auto around = honest_range(Spread::uniform, 5e-7, 300, 300, false);
  EXPECT_EQ(around, std::make_pair(150.0, 450.0));
  EXPECT_FALSE(honest_range(Spread::real, 2e-8, -1, 1, true));
  EXPECT_EQ(noted("pressure [GPa]", Spread::round_off), "pressure [GPa], round-off only");
  EXPECT_EQ(noted("pressure [GPa]", Spread::real), "pressure [GPa]");
}

}  // namespace
}  // namespace recoil::app::round_off_test
