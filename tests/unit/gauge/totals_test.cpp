#include "gauge/totals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>

#include "../support/small_case.hpp"
#include "format/run_units.hpp"

namespace recoil::totals_test {
namespace {

const char* ring = R"(
format = 1
[domain]
geometry = "axisymmetric"
r = ["0 mm", "20 mm"]
z = ["-2 mm", "14 mm"]
[mesh]
finest = "0.25 mm"
[time]
end = "1 us"
[body.rod]
material = "none"
shape = { kind = "cylinder", radius = "5 mm", z = ["0 mm", "12 mm"] }
velocity = { z = "-100 m/s" }
)";

TEST(Totals, OfACylinderWithAxis) {
  const config::Case c = case_from(ring);
  const State<2> state = state_of<2>(c);
  const auto t = find_totals(state, parallel::World{});
  ASSERT_EQ(t.bodies.size(), 1U);
  const auto& b = t.bodies[0];
  const double whole = run_units(c.domain.geometry).whole;
  const double volume = std::numbers::pi * 5e-3 * 5e-3 * 12e-3;
  EXPECT_NEAR(whole * b.volume / volume, 1, 1e-9);
  EXPECT_NEAR(whole * b.mass / (1000 * volume), 1, 1e-9);
  EXPECT_NEAR(b.momentum[1] / b.mass, -100, 1e-9);
  EXPECT_EQ(b.momentum[0], 0);
  EXPECT_NEAR(b.speed, 100 * b.mass, 1e-9 * b.mass);
  EXPECT_NEAR(b.kinetic, 0.5 * 1e4 * b.mass, 1e-9);
  EXPECT_NEAR(b.internal(), 0, 1e-9);
  EXPECT_NEAR(b.place[1] / b.mass, 6e-3, 1e-12);
  EXPECT_NEAR(b.place[0] / b.mass, 2.0 / 3 * 5e-3, 1e-5) << "mean radius of a disc";
  EXPECT_NEAR(b.highest[0], 5e-3, 1e-12);
  EXPECT_EQ(b.lowest[0], 0) << "it goes through the axis";
  EXPECT_NEAR(b.lowest[1], 0, 1e-12);
  EXPECT_NEAR(b.highest[1], 12e-3, 1e-12);
  EXPECT_EQ(b.cells, 20 * 48);
  EXPECT_EQ(b.plastic_strain, 0);
}

const char* quarter = R"(
format = 1
[domain]
geometry = "planar"
x = ["-3 mm", "1 mm"]
y = ["0 mm", "4 mm"]
boundary = { x = ["outflow", "symmetry"], y = ["symmetry", "outflow"] }
[mesh]
finest = "0.25 mm"
[time]
end = "1 us"
[body.disc]
material = "none"
shape = { kind = "disc", radius = "2.1 mm", centre = { x = "1 mm", y = "0 mm" } }
)";

TEST(Totals, ABodyReachesToThePlanesOfSymmetry) {
  const auto b = find_totals(state_of<2>(case_from(quarter)), parallel::World{}).bodies[0];
  EXPECT_EQ(b.highest[0], 1e-3);
  EXPECT_EQ(b.lowest[1], 0);
  EXPECT_NEAR(b.lowest[0], -1.1e-3, 1e-5);
  EXPECT_NEAR(b.highest[1], 2.1e-3, 1e-5);
}

const char* block = R"(
format = 1
[domain]
geometry = "3d"
x = ["0 mm", "8 mm"]
y = ["0 mm", "8 mm"]
z = ["0 mm", "8 mm"]
[mesh]
finest = "0.5 mm"
[time]
end = "1 us"
[body.block]
material = "none"
shape = { kind = "box", x = ["2 mm", "6 mm"], y = ["3 mm", "6 mm"], z = ["1 mm", "7 mm"] }
)";

TEST(Totals, AngularMomentumOfABlockThatFliesAndTurns) {
  State<3> state = state_of<3>(case_from(block));
  const Vec<3> centre{{4e-3, 4.5e-3, 4e-3}}, flight{{10, -20, 30}}, spin{{300, -200, 100}},
      edge{{4e-3, 3e-3, 6e-3}};
  using C = Components<3>;
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    auto& b = state.bodies[0].at(slot);
    const std::size_t n = b.volume.size();
    const Box<3> cells = state.mesh.block(slot).cells;
    for (std::size_t k = 0; b.present && k < n; ++k) {
      const Vec<3> x = state.grid().centre(cells.lo + state.grid().layout().index(static_cast<int>(k)));
      const Vec<3> u = flight + cross(spin, x - centre);
      for (std::size_t d = 0; d < 3; ++d)
        b.contents[(C::u + d) * n + k] = b.contents[k] * u[static_cast<int>(d)];
    }
  }
  const auto b = find_totals(state, parallel::World{}).bodies[0];
  const double dx2 = 0.25e-6;
  Vec<3> exact = b.mass * cross(centre, flight);
  for (int d = 0; d < 3; ++d) {
    const double p = edge[(d + 1) % 3], q = edge[(d + 2) % 3];
    exact[d] += b.mass * (p * p + q * q - 2 * dx2) / 12 * spin[d];  // each cell's matter in its middle
  }
  EXPECT_NEAR(norm(b.angular_momentum - exact) / norm(exact), 0, 1e-12);
}

/// Its coordinates would jump by the length of the domain where it crosses the edge.
TEST(Totals, ABodyHasNoPlaceAlongAPeriodicAxis) {
  const State<2> state = state_of<2>(case_from(R"(
format = 1
[domain]
geometry = "planar"
x = ["0 mm", "16 mm"]
y = ["0 mm", "16 mm"]
[domain.boundary]
y = ["periodic", "periodic"]
[mesh]
finest = "0.5 mm"
[time]
end = "1 us"
[body.rod]
material = "none"
shape = { kind = "box", x = ["4 mm", "9 mm"], y = ["6 mm", "12 mm"] }
velocity = { y = "-100 m/s" }
)"));
  const auto t = find_totals(state, parallel::World{});
  const auto& b = t.bodies[0];
  EXPECT_TRUE(std::isfinite(b.place[0]));
  EXPECT_TRUE(std::isfinite(b.lowest[0]));
  EXPECT_TRUE(std::isnan(b.place[1]));
  EXPECT_TRUE(std::isnan(b.lowest[1]));
  EXPECT_TRUE(std::isnan(b.highest[1]));
  EXPECT_TRUE(std::isnan(b.angular_momentum[2]));
  EXPECT_TRUE(std::isfinite(b.momentum[1]));
}

/// Volumes may be below zero by a tenth of a cell, and the masses of such slivers are then as well.
TEST(Totals, TheKineticEnergyOfSliversGoesWithTheSurface) {
  State<2> state = state_of<2>(case_from(ring));
  using C = Components<2>;
  const auto before = find_totals(state, parallel::World{}).bodies[0];
  const Vec<2> rim{{4.9e-3, 5e-3}};
  const int slot = state.mesh.find(rim);
  auto& b = state.bodies[0].at(slot);
  const Grid<2>& grid = state.grid();
  const auto k =
      static_cast<std::size_t>(grid.layout().at(grid.cell_of(rim) - state.mesh.block(slot).cells.lo));
  const std::size_t n = b.volume.size();
  const double taken = -1.05, held = b.contents[k];  // of what the cell holds, and it lacks some momentum
  const double less = 1e-3 * held * 100;
  b.volume[k] *= 1 + taken;
  for (std::size_t c = 0; c < C::contents; ++c) b.contents[c * n + k] *= 1 + taken;
  b.contents[(C::u + 1) * n + k] += less;
  b.contents[C::energy * n + k] -= 100 * less;
  b.near_surface = true;
  b.extension_velocity[n + k] = -100;
  const auto after = find_totals(state, parallel::World{}).bodies[0];
  EXPECT_NEAR(after.mass, before.mass + taken * held, 1e-12 * before.mass);
  EXPECT_NEAR(after.internal(), before.internal(), 1e-9 * before.kinetic);
  b.extension_velocity[n + k] = 0;
  const auto unknown = find_totals(state, parallel::World{}).bodies[0];
  EXPECT_EQ(unknown.energy, after.energy);
  EXPECT_NEAR(unknown.kinetic - after.kinetic, 0.5e4 * 0.05 * held + 100 * less, 1e-9 * before.kinetic)
      << "no velocity, no kinetic energy";
}

/// Its surface may lie in coarse cells, of which few centres are near it.
TEST(Totals, ARigidBodyReachesAsFarAsItsShape) {
  State<1> state = state_of<1>(case_from(R"(
format = 1
[domain]
geometry = "1d"
x = ["-30 mm", "40 mm"]
[mesh]
finest = "0.05 mm"
levels = 3
[time]
end = "1 us"
[body.flyer]
rigid = true
mass = "60 kg/m2"
shape = { kind = "box", x = ["-8 mm", "-0.03 mm"] }
[body.target]
material = "none"
shape = { kind = "box", x = ["0 mm", "20 mm"] }
)"));
  for (const double moved : {0.0, -3e-3, -15e-3}) {
    state.bodies[0].rigid->centre[0] = state.bodies[0].rigid->start_centre[0] + moved;
    const auto b = find_totals(state, parallel::World{}).bodies[0];
    EXPECT_NEAR(b.lowest[0], -8e-3 + moved, 1e-12);
    EXPECT_NEAR(b.highest[0], -0.03e-3 + moved, 1e-12);
  }
  state.bodies[0].rigid->centre[0] -= 60e-3;
  EXPECT_TRUE(std::isnan(find_totals(state, parallel::World{}).bodies[0].lowest[0])) << "it has left";
}

TEST(Totals, DoNotDependOnThreads) {
  State<2> state = state_of<2>(case_from(ring));
  for (auto& block : state.bodies[0].blocks)
    for (std::size_t k = 0; k < block.contents.size(); ++k)
      block.contents[k] *= 1 + 0.3 * std::sin(static_cast<double>(k * k));
  const auto one = find_totals(state, parallel::World{});
  parallel::Team team(3);
  const auto three = find_totals(state, parallel::World{}, &team);
  EXPECT_EQ(one.bodies[0].mass, three.bodies[0].mass);
  EXPECT_EQ(one.bodies[0].kinetic, three.bodies[0].kinetic);
  EXPECT_EQ(one.bodies[0].energy, three.bodies[0].energy);
  EXPECT_EQ(one.bodies[0].momentum, three.bodies[0].momentum);
}

TEST(Totals, LedgersOfAllBlocksCount) {
  State<2> state = state_of<2>(case_from(ring));
  state.bodies.resize(2);
  state.bodies[1].blocks.resize(state.bodies[0].blocks.size());
  for (std::size_t slot = 0; slot < state.ledger.size(); ++slot) {
    auto& ledger = state.ledger[slot];
    ledger.pairs.resize(1);
    ledger.edges.resize(2);
    ledger.pairs[0].exchanged.energy += 2;
    ledger.pairs[0].exchanged.momentum += Vec<2>{{1, -3}};
    ledger.pairs[0].moment += Vec<3>{{0, 0, 7}};
    ledger.edges[1].leave(5, {{2, -1}});
  }
  const double blocks = static_cast<double>(state.ledger.size());
  ASSERT_GT(blocks, 3);
  const auto t = find_totals(state, parallel::World{});
  EXPECT_EQ(t.edges[1].mass, 5 * blocks);
  EXPECT_EQ(t.edges[1].place, (Vec<2>{{10 * blocks, -5 * blocks}}));
  EXPECT_EQ(t.edges[0].mass, 0);
  EXPECT_EQ(received(t, 0).energy, 2 * blocks);
  EXPECT_EQ(received(t, 1).momentum, (Vec<2>{{-blocks, 3 * blocks}}));
  EXPECT_EQ(received_moment(t, 0), (Vec<3>{{0, 0, 7 * blocks}}));
  EXPECT_EQ(received_moment(t, 1), (Vec<3>{{0, 0, -7 * blocks}}));
  EXPECT_TRUE(std::isnan(t.bodies[1].highest[0])) << "a body that is nowhere has no extent";
}

}  // namespace
}  // namespace recoil::totals_test
