#include "gauge/point_probe.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "../support/small_case.hpp"

namespace recoil::point_probe_test {
namespace {

constexpr double dx = 0.25e-3;

/// Its upper face cuts a row of cells at 0.4 of their height; it goes through the plane of symmetry x = 0.
const char* slab = R"(
format = 1
[domain]
geometry = "planar"
x = ["0 mm", "4 mm"]
y = ["-4 mm", "4 mm"]
boundary = { x = ["symmetry", "outflow"] }
[mesh]
finest = "0.25 mm"
[time]
end = "1 us"
[body.slab]
material = "none"
shape = { kind = "box", x = ["-3 mm", "3 mm"], y = ["-2 mm", "0.1 mm"] }
)";

/// Gives every fragment the velocity that `field` has in its middle.
template <class F>
State<2> moving(const char* text, F&& field) {
  State<2> state = state_of<2>(case_from(text));
  using C = Components<2>;
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    auto& b = state.bodies[0].at(slot);
    const std::size_t n = b.volume.size();
    const Box<2> cells = state.mesh.block(slot).cells;
    for (std::size_t k = 0; b.present && k < n; ++k) {
      const Index<2> i = cells.lo + state.grid().layout().index(static_cast<int>(k));
      Vec<2> x = state.grid().centre(i);
      if (x[1] > 0) x[1] -= 0.5 * (1 - b.volume[k] / state.grid().full_volume(i)) * dx;
      const Vec<2> u = field(x);
      for (std::size_t d = 0; d < 2; ++d)
        b.contents[(C::u + d) * n + k] = b.contents[k] * u[static_cast<int>(d)];
      b.contents[C::energy * n + k] += 0.5 * b.contents[k] * dot(u, u);
    }
  }
  return state;
}

struct Found {
  bool there = false;
  std::vector<double> values;
  Vec<2> velocity() const { return {{values[1], values[2]}}; }
};

Found find(const State<2>& state, const BodyPoint<2>& point) {
  ExactSums sums;
  const int item = sums.item(point_sums<2>);
  probe_point(state, point, item, sums);
  sums.reduce(parallel::World{});
  const auto total = sums.total(item);
  return {sums.any(item), {total.begin(), total.end()}};
}

Found find(const State<2>& state, double x, double y) {
  return find(state, {.body = 0, .at = {{x, y}}, .velocity = {}});
}

Vec<2> linear(const Vec<2>& x) { return {{3e4 * x[0], 10 + 2e4 * x[0] - 5e4 * x[1]}}; }

TEST(PointProbe, IsExactInALinearField) {
  const State<2> state = moving(slab, linear);
  for (const auto& x : {Vec<2>{{1.03e-3, -0.71e-3}}, Vec<2>{{1e-3, -1e-3}}, Vec<2>{{1.125e-3, -0.875e-3}}}) {
    const Found f = find(state, x[0], x[1]);
    ASSERT_TRUE(f.there);
    EXPECT_NEAR(norm(f.velocity() - linear(x)), 0, 1e-11);
    EXPECT_NEAR(f.values[0], 1000, 1e-9);
    EXPECT_NEAR(f.values[point_sums<2> - 4], 298, 1e-9);
  }
}

TEST(PointProbe, IsExactAtASurfaceFromItsOwnSide) {
  const State<2> state = moving(slab, linear);
  for (const double y : {0.1e-3, 0.02e-3, -0.1e-3, 0.15e-3}) {
    const Found f = find(state, 1.07e-3, y);
    ASSERT_TRUE(f.there) << y;
    EXPECT_NEAR(norm(f.velocity() - linear({{1.07e-3, y}})), 0, 1e-6) << y;
  }
  EXPECT_FALSE(find(state, 1.07e-3, 0.24e-3).there) << "more than half a cell outside";
  EXPECT_FALSE(find(state, 1.07e-3, 9e-3).there) << "not in the domain";
}

TEST(PointProbe, MirrorsAtAPlaneOfSymmetry) {
  const State<2> state = moving(slab, [](const Vec<2>& x) { return Vec<2>{{3e4 * x[0], 7}}; });
  for (const double x : {0.0, 0.04e-3, 0.125e-3}) {
    const Found f = find(state, x, -1e-3);
    ASSERT_TRUE(f.there);
    EXPECT_NEAR(f.velocity()[0], 3e4 * x, 1e-11);
    EXPECT_NEAR(f.velocity()[1], 7, 1e-11);
  }
}

TEST(PointProbe, AFaceIsNoTossOfACoin) {
  const State<2> state = moving(slab, [](const Vec<2>& x) { return Vec<2>{{x[0] < 1e-3 ? 4.0 : 8.0, 0}}; });
  for (const double off : {-1e-13, 0.0, 1e-13})
    EXPECT_NEAR(find(state, 1e-3 + off, -1e-3).velocity()[0], 6, 1e-6);
}

TEST(PointProbe, StressesAndStrainStayAdmissibleAtAFront) {
  State<2> state = moving(slab, linear);
  using C = Components<2>;
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    auto& b = state.bodies[0].at(slot);
    const std::size_t n = b.volume.size();
    const Box<2> cells = state.mesh.block(slot).cells;
    for (std::size_t k = 0; b.present && k < n; ++k)
      if (state.grid().centre(cells.lo + state.grid().layout().index(static_cast<int>(k)))[1] < -0.25e-3)
        b.contents[C::ep * n + k] = 0.4 * b.contents[k];
  }
  const Found f = find(state, 1e-3, 0.1e-3);
  ASSERT_TRUE(f.there);
  EXPECT_EQ(f.values[point_sums<2> - 5], 0) << "a linear fit alone would be below zero";
}

const char* disc = R"(
format = 1
[domain]
geometry = "planar"
x = ["-4 mm", "4 mm"]
y = ["-4 mm", "4 mm"]
[mesh]
finest = "0.25 mm"
[time]
end = "1 us"
[body.disc]
material = "none"
shape = { kind = "box", x = ["-4 mm", "4 mm"], y = ["-4 mm", "4 mm"] }
)";

/// How far from its start a point ends that turns once about the origin in so many steps.
double error_of_a_turn(int steps) {
  constexpr double spin = 1e5;  // rad/s
  State<2> state = moving(disc, [](const Vec<2>& x) { return Vec<2>{{-spin * x[1], spin * x[0]}}; });
  const Vec<2> start{{1.9e-3, 0.3e-3}};
  BodyPoint<2> point{.body = 0, .follows = true, .at = start, .velocity = {}};
  const double dt = 2 * std::numbers::pi / spin / steps;
  for (int n = 0; n <= steps; ++n) {
    if (n > 0) state.time += dt;
    const Found f = find(state, point);
    follow_point(point, state.time, f.there, std::span<const double>(f.values));
  }
  return norm(point.at - start);
}

TEST(PointProbe, FollowsTheMatterToSecondOrder) {
  const double coarse = error_of_a_turn(200), fine = error_of_a_turn(400);
  EXPECT_LT(coarse, 0.02 * dx * 200 / 100);
  EXPECT_NEAR(coarse / fine, 4, 0.3);
}

/// Matter that flows through a period of 8 mm.
const char* stream = R"(
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
)";

TEST(PointProbe, ComesInAgainAcrossTheEdgeOfAPeriod) {
  State<2> state = moving(stream, [](const Vec<2>&) { return Vec<2>{{0, 500}}; });
  BodyPoint<2> point{.body = 0, .follows = true, .at = {{2e-3, 3.9e-3}}, .velocity = {}};
  for (int n = 0; n <= 100; ++n) {
    if (n > 0) state.time += 0.2e-6;
    const Found f = find(state, point);
    ASSERT_TRUE(f.there) << n;
    follow_point(point, state.time, f.there, std::span<const double>(f.values));
    EXPECT_NEAR(f.velocity()[1], 500, 1e-9);
  }
  EXPECT_NEAR(point.at[1], 3.9e-3 + 10e-3 - 16e-3, 1e-9);
}

}  // namespace
}  // namespace recoil::point_probe_test
