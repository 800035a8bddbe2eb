#include "record/validity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>

namespace recoil::validity_test {
namespace {

Evidence flyer_and_target() {
  Evidence e;
  e.dimensions = 2;
  for (const char* name : {"flyer", "target"}) {
    BodyEvidence& b = e.bodies.emplace_back();
    b.name = name;
    b.cell_steps = b.looked_at = 1e6;
    b.thickness = 40;
  }
  e.budgets = {{"total", 1e-15, 1e-15, 1e-15}, {"flyer", 1e-14, 1e-14, 1e-14}, {"target", 0, 0, 0}};
  return e;
}

Verdict judged(const Evidence& e, const config::Limits& limits = {}) { return judge(e, limits); }

TEST(Validity, ARunWithNothingBeyondALimitIsValid) {
  Evidence e = flyer_and_target();
  e.bodies[0].averaged = 10;  // 1e-5 of its states
  e.counters = {{"averaged-states", 10}, {"volume-bounds", 20000}, {"3^d-neighbourhoods", 1000000}};
  const Verdict v = judged(e);
  EXPECT_EQ(v.kind, Verdict::Kind::valid);
  EXPECT_TRUE(v.reasons.empty());
  EXPECT_TRUE(v.notes.empty());
}

TEST(Validity, StepsLongerThanAStableOneAreJudgedByTheirOwnName) {
  Evidence e = flyer_and_target();
  e.steps = 1000, e.unstable_steps = 3;
  const Verdict few = judged(e);
  EXPECT_EQ(few.kind, Verdict::Kind::doubtful);
  ASSERT_EQ(few.reasons.size(), 1U);
  EXPECT_EQ(few.reasons[0].what, "unstable-steps");
  EXPECT_NE(few.reasons[0].text.find("3 of 1000 steps were longer than a stable one"), std::string::npos);
  ASSERT_EQ(few.cures.size(), 1U);
  EXPECT_NE(few.cures[0].find("fixed-dt"), std::string::npos);
  e.unstable_steps = 30;
  const Verdict many = judged(e);
  EXPECT_EQ(many.kind, Verdict::Kind::stopped);
  EXPECT_EQ(many.reasons[0].what, "unstable-steps-stop");
  config::Limits none;
  none.unstable_steps = none.unstable_steps_stop = 1;
  EXPECT_EQ(judged(e, none).kind, Verdict::Kind::valid);
}

TEST(Validity, ReplacedStatesAreJudgedBodyByBody) {
  Evidence e = flyer_and_target();
  e.bodies[1].cell_steps = 1e9;  // a large body does not hide a small one
  e.bodies[0].averaged = 4000;
  e.bodies[0].averaged_first = 1e-6, e.bodies[0].averaged_last = 2e-6;
  e.bodies[0].averaged_place = {0.001, 0.002, 0};
  const Verdict v = judged(e);
  ASSERT_EQ(v.reasons.size(), 1U);
  EXPECT_EQ(v.kind, Verdict::Kind::doubtful);
  EXPECT_EQ(v.reasons[0].body, "flyer");
  EXPECT_EQ(v.reasons[0].text,
            "0.4 % of the cell states of flyer replaced (averaged-states 4000, all of them), from 1 to 2 us, "
            "last at "
            "(1, 2) mm");
  EXPECT_DOUBLE_EQ(v.reasons[0].value, 4e-3);
  EXPECT_EQ(v.reasons[0].place.size(), 2U);
  config::Limits wide;
  wide.averaged_states = 0.01;
  EXPECT_EQ(judged(e, wide).kind, Verdict::Kind::valid);
}

TEST(Validity, TooManyReplacedStatesOfTheLastStepsStopARun) {
  Evidence e = flyer_and_target();
  e.recent_averaged = 200, e.recent_cell_steps = 20000;
  EXPECT_EQ(judged(e).kind, Verdict::Kind::valid);
  e.recent_averaged = 201;
  const Verdict v = judged(e);
  EXPECT_EQ(v.kind, Verdict::Kind::stopped);
  EXPECT_EQ(v.reasons[0].what, "averaged-states-stop");
}

TEST(Validity, OpenBudgetsAreDoubtfulAndThenStop) {
  Evidence e = flyer_and_target();
  e.budgets[1].energy = 2e-9;
  Verdict v = judged(e);
  EXPECT_EQ(v.kind, Verdict::Kind::doubtful);
  EXPECT_EQ(v.reasons.at(0).what, "budget");
  EXPECT_EQ(v.reasons.at(0).body, "flyer");
  e.budgets[0].mass = 2e-6;
  v = judged(e);
  EXPECT_EQ(v.kind, Verdict::Kind::stopped);
  EXPECT_EQ(v.reasons.at(0).what, "budget-stop") << "what stops comes first";
  config::Limits strict;
  strict.budget_stop = 1e-20;
  EXPECT_EQ(judged(flyer_and_target(), strict).kind, Verdict::Kind::stopped) << "also below the other limit";
  e.budgets[0].mass = std::nan("");
  EXPECT_EQ(judged(e).kind, Verdict::Kind::stopped);
}

TEST(Validity, SchemesThatKeepNothingAreNotJudgedByBudgets) {
  Evidence e = flyer_and_target();
  e.conservative = false;
  e.budgets[1].mass = 0.02;
  const Verdict v = judged(e);
  EXPECT_EQ(v.kind, Verdict::Kind::valid);
  ASSERT_EQ(v.notes.size(), 1U);
  EXPECT_NE(v.notes[0].find("budgets are not judged"), std::string::npos);
}

TEST(Validity, EveryOtherFindingHasALimitOfItsOwn) {
  Evidence e = flyer_and_target();
  e.counters = {{"capped-speeds", 100}};  // 5e-5 of 2e6
  EXPECT_EQ(judged(e).reasons.at(0).what, "capped-speeds");
  e.counters = {{"capped-speeds", 20}};
  EXPECT_TRUE(judged(e).reasons.empty());
  for (std::size_t k = 0; k < state_checks; ++k) {
    Evidence one = flyer_and_target();
    one.bodies[1].states[k].count = 900000;
    one.bodies[1].states[k].amount = 900000;
    one.converted = 1e6, one.steps = 1;
    const Verdict v = judged(one);
    if (k == static_cast<std::size_t>(StateCheck::molten)) {
      EXPECT_EQ(v.kind, Verdict::Kind::valid) << "a model that melts is right to";
      ASSERT_EQ(v.remarks.size(), 1U);
      EXPECT_NE(v.remarks[0].find("90 % of the cell states of target were molten"), std::string::npos);
      continue;
    }
    ASSERT_EQ(v.reasons.size(), 1U);
    EXPECT_EQ(v.reasons[0].what, name_of(static_cast<StateCheck>(k)));
    EXPECT_EQ(v.reasons[0].body, "target");
  }
  e.counters = {{"cleared-strains", 2100}};  // 1.05e-3 of 2e6
  EXPECT_EQ(judged(e).reasons.at(0).what, "cleared-strains");
  e.counters.clear();
  e.bodies[0].thickness = 3.9;
  EXPECT_EQ(judged(e).reasons.at(0).what, "thickness");
}

/// Of matter without room and of missing heat it counts how much there is, not in how many cells: of the heat
/// on average over the steps, beside the internal energy that all bodies took up. What is below the limit is
/// told.
TEST(Validity, MatterWithoutRoomAndMissingHeatAreMeasured) {
  Evidence e = flyer_and_target();
  StateFinding& overfilled = e.bodies[0].states[static_cast<std::size_t>(StateCheck::overfilled)];
  StateFinding& cold = e.bodies[1].states[static_cast<std::size_t>(StateCheck::negative_heat)];
  e.converted = 5000, e.steps = 10000;                // J
  overfilled.count = 10000, overfilled.amount = 900;  // 1 % of the cells, 9e-4 of the matter
  cold.count = 10000, cold.amount = 4e5;              // 40 J on average, 0.8 %
  Verdict v = judged(e);
  EXPECT_EQ(v.kind, Verdict::Kind::valid);
  ASSERT_EQ(v.remarks.size(), 2U);
  EXPECT_NE(v.remarks[0].find("0.09 % of the matter of flyer had no room in its cells"), std::string::npos)
      << v.remarks[0];
  EXPECT_NE(
      v.remarks[1].find("target had states colder than at the start: the heat that they lack is 0.8 % of the "
                        "internal energy that all bodies took up"),
      std::string::npos)
      << v.remarks[1];
  EXPECT_NE(v.remarks[1].find("the limit is 1 %"), std::string::npos) << v.remarks[1];
  overfilled.amount = 1100, cold.amount = 6e5;
  v = judged(e);
  EXPECT_EQ(v.kind, Verdict::Kind::doubtful);
  EXPECT_EQ(v.reasons.size(), 2U);
  EXPECT_TRUE(v.remarks.empty());
  overfilled.amount = 5, cold.amount = 400;  // next to nothing is not told
  EXPECT_TRUE(judged(e).remarks.empty());
}

TEST(Validity, ACentreOfMassThatItsMomentumHasNotCarriedIsJudgedInCells) {
  Evidence e = flyer_and_target();
  e.cell = 2e-4;
  e.centres = {{"flyer", 1.9e-4, 5e-3, 1e-6}, {"target", 0, 0, 0}};
  EXPECT_EQ(judged(e).kind, Verdict::Kind::valid);
  e.centres[0].off = 2e-3;
  const Verdict v = judged(e);
  EXPECT_EQ(v.kind, Verdict::Kind::doubtful);
  ASSERT_EQ(v.reasons.size(), 1U);
  EXPECT_EQ(v.reasons[0].what, "centre-of-mass");
  EXPECT_EQ(v.reasons[0].text,
            "the centre of mass of flyer is 2 mm (10 cells, the limit is 1) away from where its momentum has "
            "carried "
            "it on a way of 5 mm, at 1 us");
  e.centres[0].way = 0.3;  // less than 1 % of it
  EXPECT_EQ(judged(e).kind, Verdict::Kind::valid);
  e.centres[0].way = 5e-3;
  e.conservative = false;
  EXPECT_EQ(judged(e).kind, Verdict::Kind::valid);
}

TEST(Validity, AnErrorStops) {
  Evidence e = flyer_and_target();
  e.failure = "the density of flyer is not a number\n   = help: none";
  const Verdict v = judged(e);
  EXPECT_EQ(v.kind, Verdict::Kind::stopped);
  EXPECT_EQ(v.reasons.at(0).text, "the density of flyer is not a number");
}

TEST(Validity, WhatHelpsIsSaidOnce) {
  Evidence e = flyer_and_target();
  for (BodyEvidence& b : e.bodies) b.states[static_cast<std::size_t>(StateCheck::tension)].count = 500000;
  const Verdict v = judged(e);
  EXPECT_EQ(v.reasons.size(), 2U);
  ASSERT_EQ(v.cures.size(), 1U);
  EXPECT_NE(v.cures[0].find("damage"), std::string::npos);
}

}  // namespace
}  // namespace recoil::validity_test
