#include "contact/friction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../core/random.hpp"

namespace recoil::friction_test {
namespace {

constexpr double za = 8e6, zb = 20e6, infinite = std::numeric_limits<double>::infinity();  // Pa s/m

using V = Vec<3>;

/// Two surfaces that slide past each other at v and stick: tau* = v Za Zb/(Za + Zb), one velocity on both.
TEST(Friction, SticksBelowTheLimit) {
  const ShearContact<3> g = shear_contact<3>({V{{0, 0, 0}}, {}, za}, {V{{0, 10, 0}}, {}, zb}, infinite);
  EXPECT_NEAR(g.traction[1], 10 * za * zb / (za + zb), 1e-6);
  EXPECT_FALSE(g.slips);
  EXPECT_NEAR(g.first_velocity[1], g.second_velocity[1], 1e-12);
  EXPECT_NEAR(g.work_velocity[1], g.first_velocity[1], 1e-12);
}

TEST(Friction, SlipsAtTheLimitAlongTheSliding) {
  Random random(3);
  for (int n = 0; n < 200; ++n) {
    const V ua{{0, random(-50, 50), random(-50, 50)}}, ub{{0, random(-50, 50), random(-50, 50)}};
    const double limit = 1e6;
    const ShearContact<3> g = shear_contact<3>({ua, {}, za}, {ub, {}, zb}, limit);
    if (!g.slips) continue;
    ASSERT_NEAR(norm(g.traction), limit, 1e-9 * limit);
    const V sliding = g.second_velocity - g.first_velocity;
    ASSERT_NEAR(dot(g.traction, sliding), limit * norm(sliding), 1e-9 * limit * norm(sliding));
    // Heat on both sides: the work velocity lies between the walls.
    ASSERT_GE(dot(g.traction, g.work_velocity - g.first_velocity), 0);
    ASSERT_GE(-dot(g.traction, g.work_velocity - g.second_velocity), 0);
  }
}

TEST(Friction, NoLimitNoTraction) {
  const V shear{{0, 3e7, 0}};
  const ShearContact<3> g = shear_contact<3>({V{{0, 5, 0}}, shear, za}, {V{{0, -5, 0}}, shear, zb}, 0);
  EXPECT_EQ(norm(g.traction), 0);
  EXPECT_NEAR(g.first_velocity[1], 5 - 3e7 / za, 1e-12);
  EXPECT_NEAR(g.second_velocity[1], -5 + 3e7 / zb, 1e-12);
}

TEST(Friction, AFluidHoldsNothing) {
  EXPECT_EQ(norm(shear_contact<2>({Vec<2>{{0, 5}}, {}, 0}, {Vec<2>{{0, 0}}, {}, zb}, infinite).traction), 0);
  EXPECT_EQ(norm(shear_contact_rigid<2>({Vec<2>{{0, 5}}, {}, 0}, {}, infinite).traction), 0);
}

TEST(Friction, ARigidWallIsTheLimitOfAStiffBody) {
  const ShearSide<2> body{Vec<2>{{0, 30}}, Vec<2>{{0, 4e7}}, za};
  for (const double limit : {5e7, infinite}) {
    const ShearContact<2> rigid = shear_contact_rigid<2>(body, Vec<2>{{0, -3}}, limit),
                          stiff = shear_contact<2>(body, {Vec<2>{{0, -3}}, {}, 1e9 * za}, limit);
    EXPECT_NEAR(rigid.traction[1], stiff.traction[1], 1e-6 * std::abs(rigid.traction[1]));
    EXPECT_NEAR(rigid.first_velocity[1], stiff.first_velocity[1], 1e-6);
    EXPECT_NEAR(rigid.work_velocity[1], stiff.work_velocity[1], 1e-6);
  }
}

/// Mirrored bodies: the traction on the one is the opposite of that on the other.
TEST(Friction, ExchangingTheBodiesTurnsTheTraction) {
  const ShearSide<2> a{Vec<2>{{0, 7}}, Vec<2>{{0, 1e7}}, za}, b{Vec<2>{{0, -2}}, Vec<2>{{0, -2e7}}, zb};
  const auto reversed = [](const ShearSide<2>& s) {
    return ShearSide<2>{s.sliding, -s.traction, s.impedance};
  };
  const ShearContact<2> one = shear_contact<2>(a, b, 3e7),
                        other = shear_contact<2>(reversed(b), reversed(a), 3e7);
  EXPECT_NEAR(one.traction[1], -other.traction[1], 1e-3);
  EXPECT_NEAR(one.first_velocity[1], other.second_velocity[1], 1e-9);
}

}  // namespace
}  // namespace recoil::friction_test
