#include "gauge/probes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "../support/small_case.hpp"

namespace recoil::probes_test {
namespace {

const char* slab = R"(
format = 1
[domain]
geometry = "planar"
x = ["-4 mm", "4 mm"]
y = ["-4 mm", "4 mm"]
[mesh]
finest = "0.25 mm"
[time]
end = "1 us"
[body.slab]
material = "none"
shape = { kind = "box", x = ["-3 mm", "3 mm"], y = ["-1 mm", "0.1 mm"] }
velocity = { x = "7 m/s", y = "30 m/s" }
)";

template <class Probe>
SurfaceReading<2> reading(Probe&& probe) {
  ExactSums sums;
  const int item = sums.item(surface_sums<2>);
  probe(item, sums);
  sums.reduce(parallel::World{});
  return read_surface<2>(sums.total(item));
}

TEST(Probes, SurfaceAtRestKnowsItsNormal) {
  const State<2> state = state_of<2>(case_from(slab));
  const auto up = reading([&](int item, ExactSums& sums) {
    probe_surface_at_rest(state, SurfacePoint<2>{0, {{0, 0.1e-3}}, {}}, item, sums);
  });
  ASSERT_TRUE(up.found);
  EXPECT_NEAR(up.velocity[1], 30, 1e-9);
  EXPECT_NEAR(up.normal[0], 0, 1e-9);
  EXPECT_NEAR(up.normal[1], 1, 1e-9);
  const auto down = reading([&](int item, ExactSums& sums) {
    probe_surface_at_rest(state, SurfacePoint<2>{0, {{0, -1e-3}}, {}}, item, sums);
  });
  EXPECT_NEAR(down.normal[1], -1, 1e-9);
  const auto nowhere = reading([&](int item, ExactSums& sums) {
    probe_surface_at_rest(state, SurfacePoint<2>{0, {{0, 3e-3}}, {}}, item, sums);
  });
  EXPECT_FALSE(nowhere.found);
}

/// Gives a block two cut cells, one above the other, that face opposite ways.
State<2> with_walls() {
  State<2> state = state_of<2>(case_from(slab));
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    auto& b = state.bodies[0].at(slot);
    if (!b.present || !state.mesh.block(slot).cells.contains(state.grid().cell_of({{1e-5, 1e-5}}))) continue;
    for (const double sign : {1.0, -1.0}) {
      CutCell<2> cut;
      cut.surface = {{0, sign * 0.25e-3}};
      cut.point = {{0, sign * 0.1e-3}};
      Wall<2> wall;
      wall.normal = {{0, sign}};
      wall.mean_velocity = {{1, sign * 10}};
      b.geometry.cuts.push_back(cut);
      b.walls.push_back(wall);
    }
  }
  return state;
}

TEST(Probes, TheFarSideOfAThinBodyDoesNotCount) {
  const State<2> state = with_walls();
  SurfacePoint<2> point{0, {{0, 0.1e-3}}, {{0, 1}}};
  const auto r = reading([&](int item, ExactSums& sums) { probe_surface(state, point, item, sums); });
  ASSERT_TRUE(r.found);
  EXPECT_DOUBLE_EQ(r.velocity[1], 10);
  EXPECT_DOUBLE_EQ(r.velocity[0], 1);
  follow_surface(state.grid(), point, r, 1e-6);
  EXPECT_NEAR(point.at[1], 0.11e-3, 1e-12);
  EXPECT_EQ(point.at[0], 0) << "along the normal only";

  const SurfacePoint<2> unaware{0, {{0, 0}}, {}};
  const auto both = reading([&](int item, ExactSums& sums) { probe_surface(state, unaware, item, sums); });
  EXPECT_NEAR(both.velocity[1], 0, 1e-12) << "the middle, both sides alike";
}

TEST(Probes, WallsThreeCellsAwayCountWhereNoneIsNearer) {
  const State<2> state = with_walls();
  const SurfacePoint<2> point{0, {{0, 0.85e-3}}, {{0, 1}}};
  EXPECT_TRUE(reading([&](int item, ExactSums& sums) { probe_surface(state, point, item, sums); }).found);
  const SurfacePoint<2> lost{0, {{0, 1.2e-3}}, {{0, 1}}};
  EXPECT_FALSE(reading([&](int item, ExactSums& sums) { probe_surface(state, lost, item, sums); }).found);
}

// Beyond a plane of symmetry lies the image of the surface: a slanted wall beside it and its image give a
// point on the plane a velocity and a normal along it, and it stays there.
TEST(Probes, APointOnAPlaneOfSymmetryStaysThere) {
  std::string half = slab;
  const std::string whole = "x = [\"-4 mm\", \"4 mm\"]";
  half.replace(half.find(whole), whole.size(),
               "x = [\"0 mm\", \"4 mm\"]\nboundary = { x = [\"symmetry\", \"outflow\"] }");
  State<2> state = state_of<2>(case_from(half.c_str()));
  CutCell<2> cut;
  cut.surface = {{0.15e-3, 0.2e-3}};
  cut.point = {{0.1e-3, 0.05e-3}};
  Wall<2> wall;
  wall.normal = {{0.6, 0.8}};
  wall.mean_velocity = {{9, 12}};
  for (int slot = 0; slot < state.mesh.local(); ++slot)
    if (state.mesh.block(slot).cells.contains(state.grid().cell_of({{1e-5, 1e-5}}))) {
      state.bodies[0].at(slot).geometry.cuts.push_back(cut);
      state.bodies[0].at(slot).walls.push_back(wall);
    }
  SurfacePoint<2> point{0, {{0, 0.1e-3}}, {}};
  for (int k = 0; k < 2; ++k) {
    const auto r = reading([&](int item, ExactSums& sums) { probe_surface(state, point, item, sums); });
    ASSERT_TRUE(r.found);
    EXPECT_EQ(r.velocity[0], 0);
    EXPECT_NEAR(r.velocity[1], 12, 1e-12);
    EXPECT_EQ(r.normal, (Vec<2>{{0, 1}}));
    follow_surface(state.grid(), point, r, 1e-6);
  }
  EXPECT_EQ(point.at[0], 0);
  const auto at_rest = reading([&](int item, ExactSums& sums) {
    probe_surface_at_rest(state, SurfacePoint<2>{0, {{0, 0.1e-3}}, {}}, item, sums);
  });
  EXPECT_EQ(at_rest.velocity[0], 0) << "of the sliding slab the image slides the other way";
  EXPECT_NEAR(at_rest.velocity[1], 30, 1e-9);
}

/// Two walls at equal distances from the edge of a period, one on each side: a point on the edge sees both.
TEST(Probes, APointAtTheEdgeOfAPeriodSeesBothSides) {
  std::string periodic = slab;
  const std::string whole = "x = [\"-4 mm\", \"4 mm\"]";
  periodic.replace(periodic.find(whole), whole.size(),
                   "x = [\"-4 mm\", \"4 mm\"]\nboundary = { x = \"periodic\" }");
  State<2> state = state_of<2>(case_from(periodic));
  for (const double side : {-1.0, 1.0}) {
    const Vec<2> at{{side * -3.9e-3, 0.05e-3}};
    const int slot = state.mesh.find(at);
    CutCell<2> cut;
    cut.surface = {{0.15e-3 * side, 0.2e-3}};
    cut.point = at;
    Wall<2> wall;
    wall.normal = {{0.6 * side, 0.8}};
    wall.mean_velocity = {{9 * side, 12}};
    Body<2>& body = state.bodies[0];
    enter_block(body, slot, state.grid());
    body.at(slot).geometry.cuts.push_back(cut);
    body.at(slot).walls.push_back(wall);
  }
  for (const double x : {-4e-3, 4e-3}) {
    const SurfacePoint<2> point{0, {{x, 0.1e-3}}, {}};
    const auto r = reading([&](int item, ExactSums& sums) { probe_surface(state, point, item, sums); });
    ASSERT_TRUE(r.found);
    EXPECT_NEAR(r.velocity[0], 0, 1e-12);
    EXPECT_NEAR(r.velocity[1], 12, 1e-12);
  }
  SurfacePoint<2> leaves{0, {{3.95e-3, 0}}, {}};
  follow_surface(state.grid(), leaves, {true, {{100, 0}}, {{1, 0}}}, 1e-6);
  EXPECT_NEAR(leaves.at[0], -3.95e-3, 1e-12);
}

}  // namespace
}  // namespace recoil::probes_test
