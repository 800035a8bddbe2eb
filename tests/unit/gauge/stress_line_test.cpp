#include "gauge/stress_line.hpp"

#include <gtest/gtest.h>

#include <cstddef>

#include "../support/small_case.hpp"

namespace recoil::stress_line_test {
namespace {

State<1> slab() {
  return state_of<1>(case_from(R"(
format = 1
[domain]
geometry = "1d"
x = ["-1 mm", "9 mm"]
[mesh]
finest = "0.1 mm"
[time]
end = "1 us"
[body.slab]
material = "none"
shape = { kind = "box", x = ["0 mm", "8 mm"] }
velocity = { x = "100 m/s" }
)"));
}

/// Compresses the matter of one cell by so much.
void squeeze(State<1>& state, double x, double part) {
  const Index<1> i = state.grid().cell_of({{x}});
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    const Box<1> cells = state.mesh.block(slot).cells;
    if (!cells.contains(i)) continue;
    auto& b = state.bodies[0].at(slot);
    const auto k = static_cast<std::size_t>(state.grid().layout().at(i - cells.lo));
    for (std::size_t c = 0; c < b.contents.size(); c += b.volume.size()) b.contents[c + k] *= 1 + part;
  }
}

TEST(StressLine, RidesAndKeepsThePeak) {
  State<1> state = slab();
  StressLine<1> line = stress_line<1>(0, {{0}}, {{8e-3}}, 4);
  ASSERT_EQ(line.stations.size(), 4U);
  EXPECT_NEAR(line.stations[0].at[0], 2e-3, 1e-12);
  ExactSums sums;
  const int first = line_items(line, sums);
  const auto look = [&](double time, double dt) {
    sums.clear();
    collect_line(state, line, first, sums);
    sums.reduce(parallel::World{});
    follow_line(line, time, dt, first, sums);
  };
  look(0, 0);
  EXPECT_NEAR(line.stations[1].peak, 0, 1);
  // 4 mm is a face: half of the stress of the cell behind it. K = 15 GPa.
  squeeze(state, 4.05e-3, 1e-3);
  look(1e-6, 1e-6);
  EXPECT_NEAR(line.stations[1].peak, 7.5e6, 1e3);
  EXPECT_EQ(line.stations[1].time, 1e-6);
  EXPECT_NEAR(line.stations[1].at[0], 4.1e-3, 1e-9) << "100 m/s for 1 us";
  EXPECT_NEAR(line.stations[2].peak, 0, 1);
  squeeze(state, 4.05e-3, -0.5e-3);
  look(2e-6, 0);
  EXPECT_NEAR(line.stations[1].peak, 7.5e6, 1e3) << "the largest stays";
  EXPECT_EQ(line.stations[1].time, 1e-6);
}

TEST(StressLine, GoesOnAcrossTheEdgeOfAPeriod) {
  const State<2> state = state_of<2>(case_from(R"(
format = 1
[domain]
geometry = "planar"
x = ["0 mm", "4 mm"]
y = ["-4 mm", "4 mm"]
boundary = { y = "periodic" }
[mesh]
finest = "0.25 mm"
[time]
end = "1 us"
[body.slab]
material = "none"
shape = { kind = "box", x = ["1 mm", "3 mm"], y = ["-4 mm", "4 mm"] }
velocity = { y = "500 m/s" }
)"));
  StressLine<2> line = stress_line<2>(0, {{2e-3, 0}}, {{2e-3, 3.9e-3}}, 1);
  ExactSums sums;
  const int first = line_items(line, sums);
  for (int n = 1; n <= 50; ++n) {
    sums.clear();
    collect_line(state, line, first, sums);
    sums.reduce(parallel::World{});
    EXPECT_TRUE(sums.any(first)) << n;
    follow_line(line, n * 0.4e-6, 0.4e-6, first, sums);
  }
  EXPECT_NEAR(line.stations[0].at[1], 3.9e-3 + 10e-3, 1e-9);
}

}  // namespace
}  // namespace recoil::stress_line_test
