#include "problem/rigid_start.hpp"

#include <gtest/gtest.h>

#include <string>

#include "../support/small_case.hpp"

namespace recoil::rigid_start_test {
namespace {

/// A rigid body and a block in a domain from -6 to 6 mm along x, which is periodic, and 0 to 3 mm along y.
std::string planar_case(const std::string& body) {
  return R"(
format = 1
[domain]
geometry = "planar"
x = ["-6 mm", "6 mm"]
y = ["0 mm", "3 mm"]
[domain.boundary]
x = "periodic"
[mesh]
finest = "0.1 mm"
[time]
end = "1 us"
[body.block]
material = "none"
shape = { kind = "box", x = ["2 mm", "4 mm"], y = ["0 mm", "3 mm"] }
[body.rigid]
rigid = true
)" + body;
}

RigidMotion<2> motion_of(const std::string& body) {
  const config::Case c = case_from(planar_case(body));
  return rigid_motion<2>(c.bodies[1], c, make_grid<2>(c));
}

const std::string slab = "shape = { kind = \"box\", x = [\"-5 mm\", \"-4 mm\"], y = [\"1 mm\", \"2 mm\"] }\n";

TEST(RigidStart, MovingBodiesComeBackAfterAPeriod) {
  EXPECT_EQ(motion_of(slab + "velocity = { x = \"-1 km/s\" }").period, (Vec<2>{{12e-3, 0}}));
  EXPECT_EQ(motion_of(slab + "mass = \"1 kg/m\"").period, (Vec<2>{{12e-3, 0}}));
  EXPECT_EQ(motion_of(slab).period, Vec<2>{}) << "a wall that never moves stays cut by the edge";
  const char* through = R"(shape = { kind = "box", x = ["-6 mm", "6 mm"], y = ["1 mm", "2 mm"] }
velocity = { x = "1 m/s" })";
  EXPECT_EQ(motion_of(through).period, Vec<2>{}) << "it fills the period";
}

/// It reaches one end of the period, and has a face there.
TEST(RigidStart, ABodyAtOneEndOfAPeriodEndsThere) {
  const RigidMotion<2> m = motion_of(R"(shape = { kind = "box", x = ["-6 mm", "-4 mm"], y = ["0 mm", "3 mm"] }
velocity = { x = "1 m/s" })");
  const RigidPose<2> now = pose_after(m, 0);
  EXPECT_NEAR(distance_at(m, now, Vec<2>{{5.5e-3, 1e-3}}), 0.5e-3, 1e-12);
  EXPECT_NEAR(distance_at(m, now, Vec<2>{{-5.8e-3, 1e-3}}), -0.2e-3, 1e-12);
}

TEST(RigidStart, TheCentreOfMassIsThatOfTheShapeUnlessGiven) {
  const RigidMotion<2> own = motion_of(slab + "mass = \"1 kg/m\"\nvelocity = { y = \"2 m/s\" }");
  EXPECT_NEAR(own.start_middle[0], -4.5e-3, 1e-12);
  EXPECT_NEAR(own.start_middle[1], 1.5e-3, 1e-12);
  EXPECT_EQ(own.centre, Vec<2>{}) << "it cannot turn: the point about which it does is of no account";
  EXPECT_NEAR(own.mass->start_moment[2], -4.5e-3 * 2, 1e-12);
  const RigidMotion<2> given =
      motion_of(slab + "mass = \"1 kg/m\"\ncentre-of-mass = { x = \"-4.2 mm\", y = \"1 mm\" }");
  EXPECT_EQ(given.start_middle, (Vec<2>{{-4.2e-3, 1e-3}}));
  EXPECT_EQ(given.centre, given.start_middle);
}

/// Of a wall that reaches beyond an open edge what lies in the domain counts.
TEST(RigidStart, ABodyCutByAnOpenEdge) {
  const RigidMotion<2> m =
      motion_of(R"(shape = { kind = "box", x = ["-5 mm", "-4 mm"], y = ["2 mm", "3 mm"] })");
  EXPECT_NEAR(m.start_middle[1], 2.5e-3, 1e-12);
}

}  // namespace
}  // namespace recoil::rigid_start_test
