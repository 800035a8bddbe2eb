#include "contact/touch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../core/random.hpp"

namespace recoil::touch_test {
namespace {

constexpr double za = 15e6, zb = 40e6;  // Pa s/m

TEST(Touch, Table) {
  struct Row {
    const char* what;
    double ua, sa, ub, sb, gap_speed;
    bool touching;
  };
  for (const Row& r :
       {Row{"approach", 100, 0, 0, 0, 0, true}, Row{"the same velocity", 50, 0, 50, 0, 0, false},
        Row{"flying apart", 0, 0, 10, 0, 0, false}, Row{"pressed", 0, -1e9, 0, -1e9, 0, true},
        Row{"pulled", 0, 1e8, 0, 1e8, 0, false},
        Row{"a gap too wide for this step", 100, 0, 0, 0, 101, false},
        Row{"a gap that closes in this step", 100, 0, 0, 0, 60, true},
        Row{"pressed, but parting faster", 0, -1e8, 100, -1e8, 0, false}}) {
    EXPECT_EQ(touch({r.ua, r.sa, za}, {r.ub, r.sb, zb}, r.gap_speed).touching, r.touching) << r.what;
    const Touch rigid = touch_rigid({r.ua, r.sa, za}, r.ub, r.gap_speed);
    EXPECT_EQ(rigid.touching, r.ub - r.ua + r.sa / za + r.gap_speed < 0) << r.what;
  }
}

/// Two bodies at rest stresses that meet at relative speed v: sigma* = -v Za Zb/(Za + Zb).
TEST(Touch, Impact) {
  const Touch t = touch({100, 0, za}, {0, 0, zb}, 0);
  EXPECT_NEAR(t.traction, -100 * za * zb / (za + zb), 1e-3);
  EXPECT_NEAR(t.first_velocity, 100 * za / (za + zb), 1e-10);
  EXPECT_NEAR(t.second_velocity, t.first_velocity, 1e-10);
  EXPECT_NEAR(t.work_velocity, t.first_velocity, 1e-10);
}

TEST(Touch, EqualStressesPassThrough) {
  const Touch t = touch({20, -2e9, za}, {20, -2e9, zb}, 0);
  EXPECT_NEAR(t.traction, -2e9, 1e-3);
  EXPECT_NEAR(t.work_velocity, 20, 1e-9);
}

TEST(Touch, WhateverTheStates) {
  Random random(9);
  int touching = 0;
  for (int n = 0; n < 2000; ++n) {
    const ContactSide a{random(-500, 500), random(-5e9, 2e9), random(1e6, 1e8)};
    const ContactSide b{random(-500, 500), random(-5e9, 2e9), random(1e6, 1e8)};
    const double gap_speed = n % 2 == 0 ? 0 : random(0, 200);
    const Touch t = touch(a, b, gap_speed);
    ASSERT_LE(t.traction, 0);  // never pulls
    ASSERT_EQ(t.touching, t.traction < 0);
    // Seen from the other side, with e turned round.
    const Touch back =
        touch({-b.velocity, b.stress, b.impedance}, {-a.velocity, a.stress, a.impedance}, gap_speed);
    ASSERT_EQ(back.touching, t.touching);
    if (!t.touching) {
      ASSERT_EQ(t.work_velocity, 0);
      continue;
    }
    ++touching;
    ASSERT_NEAR(back.traction / t.traction, 1, 1e-12);
    ASSERT_NEAR(back.work_velocity, -t.work_velocity, 1e-9);
    ASSERT_NEAR(back.first_velocity, -t.second_velocity, 1e-9);
    // The wall moves to where its characteristic meets the traction; the gap closes at gap_speed.
    ASSERT_NEAR(t.first_velocity - t.traction / a.impedance, free_velocity(a.velocity, a.stress, a.impedance),
                1e-9);
    ASSERT_NEAR(t.first_velocity - t.second_velocity, gap_speed, 1e-9);
    // The work velocity lies between the walls' and balances their momentum.
    ASSERT_NEAR((a.impedance + b.impedance) * t.work_velocity,
                a.impedance * t.first_velocity + b.impedance * t.second_velocity, 1e-3);
    ASSERT_LE(t.work_velocity, std::fmax(t.first_velocity, t.second_velocity) + 1e-9);
    ASSERT_GE(t.work_velocity, std::fmin(t.first_velocity, t.second_velocity) - 1e-9);
  }
  EXPECT_GT(touching, 500);
}

/// Where contact is lost the traction goes to zero, so that it does not jump.
TEST(Touch, SwitchesContinuously) {
  const double speed = 40;
  EXPECT_NEAR(touch({speed, 0, za}, {0, 0, zb}, speed * (1 - 1e-9)).traction, 0, 1);
  EXPECT_EQ(touch({speed, 0, za}, {0, 0, zb}, speed).traction, 0);
}

TEST(Touch, ARigidBodyIsTheLimitOfAStiffOne) {
  const ContactSide body{120, -3e8, za};
  const Touch rigid = touch_rigid(body, 30, 0);
  const Touch stiff = touch(body, {30, 0, 1e9 * za}, 0);
  EXPECT_TRUE(rigid.touching);
  EXPECT_NEAR(rigid.traction / stiff.traction, 1, 1e-6);
  EXPECT_EQ(rigid.first_velocity, 30);
  EXPECT_EQ(rigid.work_velocity, 30);
  EXPECT_EQ(rigid.second_velocity, 30);
  EXPECT_NEAR(touch_rigid(body, 30, 50).first_velocity, 80, 1e-9);  // closes the gap in this step
}

TEST(Touch, AFreeSurfaceDoublesTheVelocityOfAWave) {
  const double u = 100;
  EXPECT_NEAR(free_velocity(u, -za * u, za), 2 * u, 1e-10);
}

}  // namespace
}  // namespace recoil::touch_test
