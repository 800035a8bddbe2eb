#include "record/lift_off.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "../support/small_case.hpp"
#include "record/events.hpp"

namespace recoil::lift_off_test {
namespace {

const char* stacked = R"(
format = 1
[domain]
geometry = "planar"
x = ["0 mm", "4 mm"]
y = ["0 mm", "4 mm"]
[mesh]
finest = "0.25 mm"
[time]
end = "1 us"
[body.low]
material = "none"
shape = { kind = "box", x = ["0 mm", "4 mm"], y = ["0 mm", "2.1 mm"] }
[body.high]
material = "none"
shape = { kind = "box", x = ["0 mm", "4 mm"], y = ["2.1 mm", "4 mm"] }
)";

/// 16 x 16 cells whose row 8 is cut for both bodies; the cells [first, touching) of it touch.
void set_contact(State<2>& state, int touching, bool second_near = true, double gap = 0.2, int first = 0) {
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    const Box<2> cells = state.mesh.block(slot).cells;
    state.contacts[slot].clear();
    for (int i = first; i < touching; ++i) {
      if (!cells.contains({{i, 8}})) continue;
      Contact<2>& c = state.contacts[slot].emplace_back();
      c.cell = state.grid().layout().at(Index<2>{{i, 8}} - cells.lo);
      c.second = 1;
    }
    for (std::size_t m = 0; m < 2; ++m) {
      auto& b = state.bodies[m].at(slot);
      const double part = m == 1 && !second_near ? 5 : 0.5 * gap;  // dx, far from the truth elsewhere
      std::fill(b.phi.begin(), b.phi.end(), part * 0.25e-3);
    }
  }
}

void step(State<2>& state, LiftOffWatch<2>& watch, int steps) {
  for (int n = 0; n < steps; ++n) {
    ++state.step;
    state.time += 1e-9;
    watch.note(state);
  }
}

TEST(LiftOff, AnEdgeThatPeelsIsFound) {
  State<2> state = state_of<2>(case_from(stacked));
  ASSERT_EQ(state.mesh.local(), 1);
  LiftOffWatch<2> watch({lift_off_steps * 1e-9});
  set_contact(state, 16);
  step(state, watch, lift_off_steps);
  EXPECT_TRUE(watch.collect(state, parallel::World{}).empty());
  set_contact(state, 10);
  step(state, watch, lift_off_steps);
  const auto places = watch.collect(state, parallel::World{});
  ASSERT_EQ(places.size(), 5U) << "cells 11 to 15; 10 has a neighbour that touches";
  EXPECT_EQ(places[0].pair, 0);
  EXPECT_NEAR(places[0].time, lift_off_steps * 1e-9, 1e-15);
  EXPECT_NEAR(places[0].at[0], 11.5 * 0.25e-3, 1e-12);
  step(state, watch, lift_off_steps);
  EXPECT_TRUE(watch.collect(state, parallel::World{}).empty()) << "each place once";
}

/// The cells [0, 8) part first, the others a little later: cell 7 has a neighbour that has touched lately.
std::vector<LiftOffWatch<2>::Place> parted(int block) {
  config::Case c = case_from(stacked);
  c.mesh.block = block;
  State<2> state = state_of<2>(c);
  EXPECT_EQ(state.mesh.local(), (16 / block) * (16 / block));
  LiftOffWatch<2> watch({lift_off_steps * 1e-9});
  set_contact(state, 16);
  step(state, watch, lift_off_steps);
  set_contact(state, 16, true, 0.2, 8);
  step(state, watch, lift_off_steps - 1);
  set_contact(state, 0);
  step(state, watch, 1);
  return watch.collect(state, parallel::World{});
}

TEST(LiftOff, DoesNotDependOnTheSizeOfBlocks) {
  const auto one = parted(16), four = parted(8);
  ASSERT_EQ(one.size(), 7U);
  ASSERT_EQ(four.size(), one.size());
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_EQ(four[k].at, one[k].at);
}

/// The events tell the first place of the list.
TEST(LiftOff, PlacesComeInTheOrderOfTime) {
  config::Case c = case_from(stacked);
  c.mesh.block = 8;
  State<2> state = state_of<2>(c);
  LiftOffWatch<2> watch({lift_off_steps * 1e-9});
  set_contact(state, 16, true, 0.2, 12);
  step(state, watch, 1);
  set_contact(state, 4);
  step(state, watch, 1);
  set_contact(state, 0);
  step(state, watch, lift_off_steps + 1);
  const auto places = watch.collect(state, parallel::World{});
  ASSERT_EQ(places.size(), 8U);
  EXPECT_NEAR(places.front().at[0], 12.5 * 0.25e-3, 1e-12) << "the later block parted earlier";
  EXPECT_LT(places.front().time, places.back().time);
}

TEST(LiftOff, SlowPartingCountsWhenItShows) {
  State<2> state = state_of<2>(case_from(stacked));
  LiftOffWatch<2> watch({lift_off_steps * 1e-9});
  set_contact(state, 16);
  step(state, watch, lift_off_steps);
  set_contact(state, 10, true, 0.05);
  step(state, watch, 4 * lift_off_steps);
  EXPECT_TRUE(watch.collect(state, parallel::World{}).empty()) << "still within a tenth of a cell";
  set_contact(state, 10, true, 0.15);
  step(state, watch, 1);
  const auto places = watch.collect(state, parallel::World{});
  ASSERT_EQ(places.size(), 5U);
  EXPECT_NEAR(places[0].time, lift_off_steps * 1e-9, 1e-15);
}

TEST(LiftOff, ASurfaceThatHasGoneAwayIsNone) {
  State<2> state = state_of<2>(case_from(stacked));
  LiftOffWatch<2> watch({lift_off_steps * 1e-9});
  set_contact(state, 16);
  step(state, watch, lift_off_steps);
  set_contact(state, 0, false);
  step(state, watch, lift_off_steps);
  EXPECT_TRUE(watch.collect(state, parallel::World{}).empty());
}

}  // namespace
}  // namespace recoil::lift_off_test
