#include "record/balance/centre_watch.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

namespace recoil::centre_watch_test {
namespace {

/// A body of 2 kg that moves at 10 m/s along x from x = 1 m, and a wall.
Totals<2> start() {
  Totals<2> t;
  t.bodies.resize(2);
  t.edges.resize(2);
  t.bodies[0].mass = 2;
  t.bodies[0].momentum = {{20, 0}};
  t.bodies[0].place = {{2, 0}};
  return t;
}

CentreWatch<2> watch(std::vector<bool> balanced = {true, true}) {
  CentreWatch<2> w({"ball", "wall"}, {false, true}, std::move(balanced));
  w.begin(start());
  return w;
}

TEST(CentreWatch, ABodyThatGoesWithItsMomentumIsNotOff) {
  auto w = watch();
  for (const double time : {0.5, 1.0}) {
    Totals<2> t = start();
    t.time = time;
    t.bodies[0].place[0] += 20 * time;
    w.look(t);
  }
  ASSERT_EQ(w.worst().size(), 1U);
  EXPECT_EQ(w.worst()[0].name, "ball");
  EXPECT_NEAR(w.worst()[0].off, 0, 1e-15);
}

TEST(CentreWatch, MatterThatStandsStillWithItsMomentumIsSeen) {
  auto w = watch();
  Totals<2> t = start();
  t.time = 1;
  t.bodies[0].place[0] += 15;  // a quarter of it has stayed
  w.look(t);
  EXPECT_NEAR(w.worst()[0].off, 2.5, 1e-14);
  EXPECT_EQ(w.worst()[0].time, 1);
  EXPECT_NEAR(w.worst()[0].way, 10, 1e-14);
  t.time = 2, t.bodies[0].place[0] += 25;  // it has caught up: the worst stays
  w.look(t);
  EXPECT_NEAR(w.worst()[0].off, 2.5, 1e-14);
  EXPECT_EQ(w.worst()[0].time, 1);
}

TEST(CentreWatch, AChangeOfMomentumBetweenLooksMayComeEarlyOrLate) {
  for (const double way : {20.0, 25.0, 30.0}) {  // from 20 to 30 kg m/s at the end, on the way, at the start
    auto w = watch();
    Totals<2> t = start();
    t.time = 1;
    t.bodies[0].momentum = {{30, 0}};
    t.bodies[0].place[0] += way;
    w.look(t);
    EXPECT_NEAR(w.worst()[0].off, 0, 1e-14) << way;
  }
  auto w = watch();
  Totals<2> t = start();
  t.time = 1;
  t.bodies[0].momentum = {{30, 0}};
  t.bodies[0].place[0] += 32;
  w.look(t);
  EXPECT_NEAR(w.worst()[0].off, 1, 1e-14);
}

TEST(CentreWatch, WhatLeavesThroughEdgesTakesItsPlaceAlong) {
  auto w = watch();
  Totals<2> t = start();
  t.time = 1;
  t.bodies[0].place[0] += 20;
  w.look(t);
  t.bodies[0].mass -= 0.5, t.bodies[0].place[0] -= 0.5 * 11;  // half a kilogram leaves at x = 11 m
  t.edges[0].mass = 0.5, t.edges[0].place = {{0.5 * 11, 0}};
  w.look(t);
  EXPECT_NEAR(w.worst()[0].off, 0, 1e-14);
}

/// A quarter of the body goes to another one that takes up its fragments, and stands still there.
TEST(CentreWatch, FragmentsCountWithTheirSource) {
  CentreWatch<2> w({"ball", "chip"}, {false, false}, {true, true}, {-1, 0});
  w.begin(start());
  ASSERT_EQ(w.worst().size(), 1U);
  Totals<2> t = start();
  t.time = 1;
  t.bodies[0].mass = 1.5, t.bodies[0].momentum = {{15, 0}}, t.bodies[0].place = {{1.5 * 11, 0}};
  t.bodies[1].mass = 0.5, t.bodies[1].momentum = {{5, 0}}, t.bodies[1].place = {{0.5 * 11, 0}};
  w.look(t);
  EXPECT_NEAR(w.worst()[0].off, 0, 1e-14);
  t.time = 2;
  t.bodies[0].place = {{1.5 * 21, 0}};
  w.look(t);
  EXPECT_NEAR(w.worst()[0].off, 2.5, 1e-14);
}

TEST(CentreWatch, PeriodicAxesAndRadiiDoNotCount) {
  auto periodic = watch();
  Totals<2> t = start();
  t.time = 1;
  t.bodies[0].place = {{22, std::numeric_limits<double>::quiet_NaN()}};
  periodic.look(t);
  EXPECT_NEAR(periodic.worst()[0].off, 0, 1e-14);
  auto around_axis = watch({false, true});
  t.bodies[0].place = {{40, 0}};
  around_axis.look(t);
  EXPECT_NEAR(around_axis.worst()[0].off, 0, 1e-14);
  t.bodies[0].place = {{40, 4}};
  around_axis.look(t);
  EXPECT_NEAR(around_axis.worst()[0].off, 2, 1e-14);
}

}  // namespace
}  // namespace recoil::centre_watch_test
