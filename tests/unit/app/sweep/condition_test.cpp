#include "app/sweep/condition.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "core/error.hpp"

namespace recoil::app::condition_test {
namespace {

RunQuantities made_up() {
  RunQuantities run;
  run.found.numbers = {{"body.plate.failed-mass", 0.5},
                       {"body.plate.position.x", 2e-3},
                       {"failure.plate.time", std::numeric_limits<double>::quiet_NaN()}};
  run.found.flags = {{"event.ricochet", true}, {"event.failure", false}};
  run.names = {"body.plate.failed-mass", "body.plate.position.x", "failure.plate.time", "event.ricochet"};
  run.found.units = {
      {"body.plate.failed-mass", "kg"}, {"body.plate.position.x", "mm"}, {"failure.plate.time", "us"}};
  return run;
}

bool holds(const std::string& text) { return parse_condition(text).holds(made_up()); }

std::string refused(const std::string& text) {
  try {
    parse_condition(text).holds(made_up());
  } catch (const InputError& e) {
    return e.what();
  }
  return "nothing is wrong with " + text;
}

TEST(Condition, ComparesInAnyUnit) {
  EXPECT_TRUE(holds("body.plate.failed-mass > 0"));
  EXPECT_TRUE(holds("body.plate.position.x>1.9 mm"));
  EXPECT_FALSE(holds("body.plate.position.x > 0.3cm"));
  EXPECT_TRUE(holds("body.plate.failed-mass >= 500 g"));
  EXPECT_FALSE(holds("body.plate.failed-mass < 500 g"));
  EXPECT_TRUE(holds("body.plate.failed-mass <= 500 g"));
}

TEST(Condition, AFlagStandsAlone) {
  EXPECT_TRUE(holds("event.ricochet"));
  EXPECT_FALSE(holds(" event.failure "));
}

TEST(Condition, WhatDidNotHappenIsNoTime) {
  EXPECT_FALSE(holds("failure.plate.time < 5 us"));
  EXPECT_FALSE(holds("failure.plate.time > 5 us"));
}

TEST(Condition, ItsDimensionIsKnownBeforeThereAreValues) {
  Quantities known;
  known.numbers = {{"body.plate.position.x", std::numeric_limits<double>::quiet_NaN()}};
  known.units = {{"body.plate.position.x", "mm"}};
  known.flags = {{"event.ricochet", false}};
  EXPECT_NO_THROW(parse_condition("body.plate.position.x > 3 um").check(known));
  EXPECT_NO_THROW(parse_condition("body.plate.position.x > 0").check(known));
  EXPECT_NO_THROW(parse_condition("event.ricochet").check(known));
  EXPECT_THROW(parse_condition("body.plate.position.x > 3 GPa").check(known), InputError);
  EXPECT_THROW(parse_condition("body.plate.position.x").check(known), InputError);
}

TEST(Condition, MistakesHaveACure) {
  EXPECT_NE(refused("body.plate.position.x > 3 us").find("compare it with a value in mm"), std::string::npos);
  EXPECT_NE(refused("body.plate.position.x > 3").find("[length]"), std::string::npos);
  EXPECT_NE(refused("body.plate.position.x").find("is a number"), std::string::npos);
  EXPECT_NE(refused("event.ricoche").find("did you mean 'event.ricochet'"), std::string::npos);
  EXPECT_NE(refused("> 3").find("names no quantity"), std::string::npos);
  EXPECT_NE(refused("body.plate.failed-mass = 0").find("one of < <= > >="), std::string::npos);
  EXPECT_NE(refused("body.plate.failed-mass > lots").find("= help"), std::string::npos);
}

}  // namespace
}  // namespace recoil::app::condition_test
