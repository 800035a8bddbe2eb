#include "app/plot/rigid_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "../../support/small_case.hpp"
#include "app/check/case_marks.hpp"
#include "picture/space/space_picture.hpp"

namespace recoil::app::rigid_scene_test {
namespace {

const char* three = R"(
format = 1
[domain]
geometry = "3d"
x = ["-4 mm", "4 mm"]
y = ["-4 mm", "4 mm"]
z = ["-4 mm", "4 mm"]
[mesh]
finest = "0.5 mm"
[time]
end = "10 us"
[body.block]
material = "none"
shape = { kind = "box", x = ["-1 mm", "1 mm"], y = ["-1 mm", "1 mm"], z = ["-1 mm", "1 mm"] }
velocity = { x = "30 m/s", y = "-40 m/s" }
[body.ball]
rigid = true
shape = { kind = "sphere", centre = { x = "-3 mm" }, radius = "0.5 mm" }
velocity = { z = "100 m/s" }
[body.piston]
rigid = true
shape = { kind = "box", x = ["-1 mm", "1 mm"], y = ["-1 mm", "1 mm"], z = ["-4 mm", "-2 mm"] }
velocity-history = [["0 us", { z = "0 m/s" }], ["10 us", { z = "40 m/s" }]]
[gauge.side]
kind = "surface-velocity"
body = "block"
at = { x = "1 mm" }
[gauge.inside]
kind = "point"
body = "block"
at = { x = "0 mm" }
[gauge.all]
kind = "body"
body = "block"
)";

/// What a dump would hold: the block, in cells that end 1 mm around it.
class Block : public Scene {
 public:
  SpaceBox box() const override { return {{{-2e-3, -2e-3, -2e-3}}, {{2e-3, 2e-3, 2e-3}}}; }
  double cell() const override { return 0.5e-3; }
  double distance(const Vec<3>& x) const override {
    return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])}) - 1e-3;
  }
  int body(const Vec<3>& /*x*/) const override { return 0; }
  double value(const Vec<3>& /*x*/, int /*body*/) const override { return 7; }
};

TEST(RigidScene, BodiesAreWhereTheCaseHasThemThen) {
  const config::Case c = case_from(three);
  const Block block;
  const RigidScene scene(block, 1, c, 10e-6, {}, {});
  ASSERT_FALSE(scene.empty());
  EXPECT_EQ(scene.box().lo[0], -4e-3) << "rigid bodies are known in all of the domain";
  // Exact: the ball has moved by 1 mm along z, the piston by 40 m/s * 10 us / 2 = 0.2 mm.
  EXPECT_NEAR(scene.distance(Vec<3>{{-3e-3, 0, 2e-3}}), 0.5e-3, 1e-12);
  EXPECT_NEAR(scene.distance(Vec<3>{{-3e-3, 0, 1e-3}}), -0.5e-3, 1e-12);
  EXPECT_NEAR(scene.distance(Vec<3>{{0, 0, -1.75e-3}}), 0.05e-3, 1e-12);
  EXPECT_EQ(scene.body(Vec<3>{{-3e-3, 0, 1e-3}}), 1);
  EXPECT_EQ(scene.body(Vec<3>{{0, 0, -1.85e-3}}), 2);
  EXPECT_EQ(scene.body(Vec<3>{{0, 0, 0.5e-3}}), 0);
  EXPECT_EQ(scene.value(Vec<3>{}, 0), 7);
  EXPECT_TRUE(std::isnan(scene.value(Vec<3>{{-3e-3, 0, 1e-3}}, 1)));
}

TEST(RigidScene, FreeBodiesAreWhereTheDumpHasThem) {
  config::Case c = case_from(three);
  c.bodies[1].mass = 1, c.bodies[2].mass = 1;
  const Block block;
  EXPECT_TRUE(RigidScene(block, 1, c, 10e-6, {}, {}).empty()) << "the case does not say where they are";
  // The piston, 2 mm x 2 mm x 2 mm about z = -3 mm, turned by 45 degrees about x, its centre moved by 3 mm
  // along x: the edge that points to z is sqrt(2) mm above the centre.
  const double s = std::sqrt(0.5);
  const Rotation turn{Vec<3>{{1, 0, 0}}, Vec<3>{{0, s, -s}}, Vec<3>{{0, s, s}}};
  const RigidPlace piston{2, {{0, 0, -3e-3}}, {{{3e-3, 0, -3e-3}}, turn}, {}, {}};
  const RigidScene scene(block, 1, c, 10e-6, {piston}, {"piston"});
  ASSERT_FALSE(scene.empty());
  const double top = -3e-3 + std::sqrt(2) * 1e-3;
  EXPECT_NEAR(scene.distance(Vec<3>{{3e-3, 0, top - 1e-4}}), -1e-4 * s, 1e-12);
  EXPECT_NEAR(scene.distance(Vec<3>{{3e-3, -1.5e-3 * s, -3e-3 + 1.5e-3 * s}}), 0.5e-3, 1e-12);
  EXPECT_EQ(scene.body(Vec<3>{{3e-3, 0, -3e-3}}), 1) << "the first behind the bodies with a field";
}

TEST(RigidScene, ShowsThoseThatAreAskedFor) {
  const config::Case c = case_from(three);
  const Block block;
  EXPECT_TRUE(RigidScene(block, 1, c, 0, {}, {"block"}).empty());
  const RigidScene ball(block, 1, c, 0, {}, {"block", "ball"});
  EXPECT_LT(ball.distance(Vec<3>{{-3e-3, 0, 0}}), 0);
  EXPECT_GT(ball.distance(Vec<3>{{0, 0, -3e-3}}), 0);
}

TEST(CaseMarks, GaugesWithAPlaceAndBodiesThatMove) {
  const config::Case c = case_from(three);
  const std::vector<GaugePlace> gauges = gauge_places(c);
  ASSERT_EQ(gauges.size(), 2U);
  EXPECT_EQ(gauges[0].name, "side");
  EXPECT_EQ(gauges[0].at[0], 1e-3);
  const std::vector<StartMotion> motions = start_motions(c);
  ASSERT_EQ(motions.size(), 3U);
  EXPECT_EQ(motions[0].label, "50 m/s");
  EXPECT_EQ(motions[0].velocity[1], -40);
  EXPECT_EQ(motions[2].label, "driven");
}

}  // namespace
}  // namespace recoil::app::rigid_scene_test
