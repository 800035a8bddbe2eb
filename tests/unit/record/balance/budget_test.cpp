#include "record/balance/budget.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace recoil::budget_test {
namespace {

/// Two deformable bodies and a rigid wall. Pairs: 0-1, 0-2, 1-2.
Totals<2> start() {
  Totals<2> t;
  t.bodies.resize(3);
  t.edges.resize(3);
  t.pairs.resize(3);
  t.bodies[0] = {.mass = 2,
                 .momentum = {{20, 0}},
                 .kinetic = 100,
                 .energy = 100,
                 .speed = 20,
                 .place = {},
                 .angular_momentum = {},
                 .lowest = {},
                 .highest = {}};
  t.bodies[1] = {.mass = 4,
                 .momentum = {},
                 .kinetic = 0,
                 .energy = 10,
                 .speed = 0,
                 .place = {},
                 .angular_momentum = {},
                 .lowest = {},
                 .highest = {}};
  return t;
}

BudgetWatch<2> watch(std::vector<bool> balanced = {true, true}) {
  BudgetWatch<2> w({"a", "b", "wall"}, {false, false, true}, std::move(balanced));
  w.begin(start());
  return w;
}

TEST(Budget, ExchangeEdgesAndRigidBodiesAreAccountedFor) {
  auto w = watch();
  Totals<2> t = start();
  t.pairs[0] = {0, -30, {{-8, 0}}};       // a gives to b
  t.pairs[2] = {0, -5, {{-6, 1}}};        // the wall brakes b
  t.edges[0] = {{0.5, 7, {{2, 0}}}, {}};  // a loses some matter
  t.bodies[0].mass = 1.5, t.bodies[0].energy = 100 - 30 - 7, t.bodies[0].momentum = {{20 - 8 - 2, 0}};
  t.bodies[1].energy = 10 + 30 - 5, t.bodies[1].momentum = {{8 - 6, 1}}, t.bodies[1].speed = 3;
  w.look(t);
  ASSERT_EQ(w.worst().size(), 3U);
  EXPECT_EQ(w.worst()[0].name, "total");
  EXPECT_EQ(w.worst()[2].name, "b");
  for (const Drift& d : w.worst()) {
    EXPECT_NEAR(d.mass, 0, 1e-15) << d.name;
    EXPECT_NEAR(d.momentum, 0, 1e-15) << d.name;
    EXPECT_NEAR(d.energy, 0, 1e-15) << d.name;
  }
}

TEST(Budget, ConvertedEnergyIsTheLargestChangeOfInternalEnergy) {
  auto w = watch();
  EXPECT_EQ(w.converted(), 0);
  Totals<2> t = start();
  t.bodies[0].kinetic = 60, t.bodies[0].energy = 90;  // internal energy 30 more, that of b 2 less
  t.bodies[1].energy = 8;
  w.look(t);
  EXPECT_EQ(w.converted(), 32);
  w.look(start());
  EXPECT_EQ(w.converted(), 32);
}

TEST(Budget, ErrorsShowWhereTheyAreAndStay) {
  auto w = watch();
  Totals<2> t = start();
  t.bodies[1].mass = 4.04, t.bodies[1].momentum = {{0, 0.5}}, t.bodies[1].energy = 11, t.bodies[1].speed = 10;
  w.look(t);
  const auto& total = w.now()[0];
  const auto &a = w.now()[1], &b = w.now()[2];
  EXPECT_EQ(a.mass + a.momentum + a.energy, 0);
  EXPECT_NEAR(b.mass, 0.01, 1e-12);
  EXPECT_NEAR(b.momentum, 0.05, 1e-12);
  EXPECT_NEAR(b.energy, 1.0 / 11, 1e-12);
  EXPECT_NEAR(total.mass, 0.04 / 6, 1e-12);
  EXPECT_NEAR(total.momentum, 0.5 / 30, 1e-12);
  EXPECT_NEAR(total.energy, 1.0 / 111, 1e-12);
  w.look(start());
  EXPECT_EQ(w.now()[2].mass, 0);
  EXPECT_NEAR(w.worst()[2].mass, 0.01, 1e-12);
}

TEST(Budget, RadialMomentumOfARingIsNotKept) {
  auto w = watch({false, true});
  Totals<2> t = start();
  t.bodies[0].momentum = {{25, 0}};
  w.look(t);
  EXPECT_EQ(w.worst()[1].momentum, 0);
  t.bodies[0].momentum = {{25, 1}};
  w.look(t);
  EXPECT_GT(w.worst()[1].momentum, 0);
}

TEST(Budget, ABodyAtRestIsMeasuredWithAPartOfWhatMovesAndWithALeastSpeed) {
  auto w = watch();
  Totals<2> t = start();
  t.bodies[1].momentum = {{1e-3, 0}};
  w.look(t);
  EXPECT_NEAR(w.now()[2].momentum, 1e-3 / (0.1 * 4), 1e-12);  // 4 kg at 0.1 m/s
  t.bodies[0].speed = 1e5;
  w.look(t);
  EXPECT_NEAR(w.now()[2].momentum, 1e-3 / (1e-4 * 1e5), 1e-12);
}

}  // namespace
}  // namespace recoil::budget_test
