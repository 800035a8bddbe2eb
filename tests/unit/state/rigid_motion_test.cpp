#include "state/rigid_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>

namespace recoil::rigid_motion_test {
namespace {

/// A body whose distance is that from the plane x = 1: tells how far and which way it has turned.
RigidMotion<2> plate() {
  RigidMotion<2> m;
  m.distance = [](const Vec<2>& x) { return x[0] - 1; };
  return m;
}

TEST(RigidMotion, APrescribedBodyKeepsVelocityAndSpin) {
  RigidMotion<2> m = plate();
  set_moving(m, {{2, 0}}, {{0, 0, std::numbers::pi / 2}});
  for (int step = 0; step < 10; ++step) move_rigid(m, 0.1, Vec<2>{{1e6, 0}}, {}, 5.0);
  EXPECT_NEAR(m.centre[0], 2, 1e-12);
  const RigidPose<2> now = pose_after(m, 0);
  // A quarter turn: the plane x = 1 lies at y = 1 above the centre.
  EXPECT_NEAR(distance_at(m, now, Vec<2>{{7, 0.25}}), -0.75, 1e-12);
  const Vec<2> u = velocity_at(m, Vec<2>{{2, 3}});
  EXPECT_NEAR(u[0], 2 - 3 * std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(u[1], 0, 1e-12);
}

TEST(RigidMotion, PoseAheadIsWhereThePrescribedBodyGoes) {
  RigidMotion<2> m = plate();
  set_moving(m, {{2, -1}}, {{0, 0, 0.3}});
  const RigidPose<2> ahead = pose_after(m, 0.5);
  move_rigid(m, 0.5, {}, {}, 0);
  EXPECT_NEAR(distance_at(m, ahead, Vec<2>{{0.3, 0.7}}), distance_at(m, pose_after(m, 0), Vec<2>{{0.3, 0.7}}),
              1e-13);
}

TEST(RigidMotion, AFreeBodyTakesImpulseAndMoment) {
  RigidMotion<2> m = plate();
  set_moving(m, {{1, 0}}, {});
  set_free(m, 4, Vec<3>{{0, 0, 2}});
  EXPECT_NEAR(m.mass->energy, 2, 1e-12);
  const double dt = 1e-6;
  move_rigid(m, dt, Vec<2>{{0, 8}}, Vec<3>{{0, 0, 6}}, 3.0);
  EXPECT_NEAR(m.velocity[0], 1, 1e-12);
  EXPECT_NEAR(m.velocity[1], 2, 1e-12);
  EXPECT_NEAR(m.spin[2], 3, 1e-4);  // about the centre, which has moved by a micrometre
  EXPECT_NEAR(m.mass->energy, 5, 1e-12);
  EXPECT_NEAR(kinetic_energy(m), 0.5 * 4 * 5 + 0.5 * 2 * 9, 1e-3);
}

TEST(RigidMotion, WithoutInertiaItDoesNotTurn) {
  RigidMotion<3> m;
  m.distance = [](const Vec<3>& x) { return x[0]; };
  set_moving(m, {}, {{1, 2, 3}});
  set_free(m, 1, Vec<3>{});
  move_rigid(m, 0.1, {}, Vec<3>{{1, 1, 1}}, 0);
  EXPECT_EQ(norm(m.spin), 0);
}

/// A slab from x = -5 to -4 in a domain of -6 to 6 that is periodic.
RigidMotion<2> slab() {
  RigidMotion<2> m;
  m.distance = [](const Vec<2>& x) { return std::abs(x[0] + 4.5) - 0.5; };
  m.start_middle = {{-4.5, 0}};
  m.period = {{12, 0}};
  return m;
}

TEST(RigidMotion, ABodyAcrossTheEdgeOfAPeriodIsOnBothSides) {
  RigidMotion<2> m = slab();
  set_moving(m, {{-1.7, 0.5}}, {});
  for (int period = 0; period < 3; ++period) {
    const RigidPose<2> pose = pose_after(m, 1 + period * 12 / 1.7);  // from -6.7 to -5.7
    EXPECT_NEAR(distance_at(m, pose, Vec<2>{{-5.9, 3}}), -0.2, 1e-12);
    EXPECT_NEAR(distance_at(m, pose, Vec<2>{{5.5, -3}}), -0.2, 1e-12);
    EXPECT_NEAR(distance_at(m, pose, Vec<2>{{4.3, 0}}), 1, 1e-12);
    EXPECT_NEAR(distance_at(m, pose, Vec<2>{{-4.7, 0}}), 1, 1e-12);
    EXPECT_NEAR(nearest_image(m, pose, Vec<2>{{5.5, 1}})[0], -6.5 - 12 * period, 1e-12);
    EXPECT_NEAR(middle_at(m, pose)[1], 0.5 * (1 + period * 12 / 1.7), 1e-12);
  }
}

/// Whichever side of the edge one sees of it, what is a quarter beyond its middle goes up by spin times that.
TEST(RigidMotion, ATurningBodyAcrossTheEdgeHasOneCentre) {
  RigidMotion<2> m = slab();
  m.centre = {{-1.5, 0}};  // it has gone from 0 to there: the middle is at -6
  set_moving(m, {}, {{0, 0, 2}});
  EXPECT_NEAR(velocity_at(m, Vec<2>{{-5.75, 0}})[1], 2 * (-5.75 + 1.5), 1e-12);
  EXPECT_NEAR(velocity_at(m, Vec<2>{{5.75, 0}})[1], 2 * (-6.25 + 1.5), 1e-12);
}

/// A body that cannot turn and is not at the origin has the angular momentum of its centre of mass.
TEST(RigidMotion, AngularMomentumAtTheStartIsThatOfTheMiddle) {
  RigidMotion<2> m = slab();
  set_moving(m, {{3, 4}}, {});
  set_free(m, 2, Vec<3>{});
  EXPECT_DOUBLE_EQ(m.mass->start_moment[2], 2 * (-4.5 * 4));
}

/// A free top with three different moments: angular momentum stays, its energy nearly.
TEST(RigidMotion, ATopKeepsItsAngularMomentum) {
  RigidMotion<3> m;
  m.distance = [](const Vec<3>& x) { return x[0]; };
  set_moving(m, {}, {{1, 0.1, 3}});
  set_free(m, 1, Vec<3>{{1, 2, 3}});
  const double energy = kinetic_energy(m);
  for (int step = 0; step < 2000; ++step) move_rigid(m, 1e-3, {}, {}, 0);
  EXPECT_NEAR(kinetic_energy(m), energy, 2e-3 * energy);
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t other = 0; other < 3; ++other)
      EXPECT_NEAR(dot(m.turn[row], m.turn[other]), row == other ? 1 : 0, 1e-12);
}

}  // namespace
}  // namespace recoil::rigid_motion_test
