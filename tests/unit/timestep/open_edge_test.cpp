#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "../core/dimensions.hpp"
#include "run.hpp"

/// Bodies that leave the domain through open edges: nothing should happen to them.
namespace recoil::open_edge_test {
namespace {

using config::Geometry;

constexpr double mm = 1e-3, us = 1e-6, radius = 2.2 * mm, u = 1000, start = -0.13 * mm, edge = 3 * mm;

/// A ball of copper that flies through the high edge along x, and in `slant` along y too.
template <int Dim>
config::Case leaving(double dx, double slant) {
  config::Vector lo{}, hi{}, centre{}, velocity{};
  for (std::size_t d = 0; d < Dim; ++d) lo[d] = -3 * mm, hi[d] = edge, centre[d] = 0.07 * mm;
  centre[0] = start;
  velocity[0] = u;
  if constexpr (Dim > 1) velocity[1] = slant;
  const Geometry geometry = Dim == 1 ? Geometry::line : Dim == 2 ? Geometry::planar : Geometry::space;
  auto c = case_of(domain_of(geometry, lo, hi), dx, {body_of("ball", ball_shape(centre, radius), velocity)});
  c.mesh.block = 16;
  return c;
}

/// The part of a line, a disc or a ball below a plane at distance d from its centre, in radii.
double part_below(int dim, double d) {
  d = std::clamp(d, -1.0, 1.0);
  if (dim == 1) return (1 + d) / 2;
  if (dim == 3) return (2 + 3 * d - d * d * d) / 4;
  return 1 - (std::acos(d) - d * std::sqrt(1 - d * d)) / std::numbers::pi;
}

/// The largest |rho/rho0 - 1| of cells that are at least half full.
template <int Dim>
double worst_compression(const TestRun<Dim>& run) {
  const Body<Dim>& body = run.state.bodies[0];
  double worst = 0;
  for (int s = 0; s < run.state.mesh.local(); ++s) {
    const BodyBlock<Dim>& b = body.at(s);
    const std::size_t n = b.volume.size();
    for (std::size_t k = 0; k < n; ++k) {
      if (b.volume[k] < 0.5 * run.state.grid().dx_power(Dim)) continue;
      const double rho = b.contents[k] / b.volume[k];
      worst = std::max(worst, std::abs(rho / density(body.material) - 1));
    }
  }
  return worst;
}

template <class D>
struct OpenEdge : testing::Test {};
TYPED_TEST_SUITE(OpenEdge, Dimensions);

TYPED_TEST(OpenEdge, WhatLeavesIsNotDisturbed) {
  constexpr int dim = TypeParam::value;
  const double dx = dim == 3 ? 0.4 * mm : 0.2 * mm;
  TestRun<dim> run(leaving<dim>(dx, 0), {samples::copper()});
  const double all = run.start[0][0], gone = (edge - start + radius) / u;
  while (run.state.time < gone + 2 * dx / u) {
    advance(run.state, run.stepping, 1, run.engine);
    const double inside = part_below(dim, (edge - start - u * run.state.time) / radius);
    // A line loses its last half cell, 2.3 % of it, at once; in 3-D cells are twice as large.
    ASSERT_NEAR(run.totals(0)[0] / all, inside,
                dim == 1   ? 0.025
                : dim == 2 ? 0.015
                           : 0.017)
        << run.state.time / us;
    ASSERT_LT(run.imbalance(0, u), 1e-12);
    ASSERT_LT(worst_compression(run), 1e-3) << run.state.time / us;
  }
  EXPECT_EQ(run.totals(0)[0], 0);
  EXPECT_EQ(run.counted().averaged_states, 0);
  EXPECT_EQ(run.counted().faces_without_value, 0);
}

/// Through two edges, and the corner between them.
TEST(OpenEdges, ABodyLeavesThroughACorner) {
  TestRun<2> run(leaving<2>(0.2 * mm, 700), {samples::copper()});
  while (run.state.time < 8 * us) {
    advance(run.state, run.stepping, 1, run.engine);
    ASSERT_LT(run.imbalance(0, u), 1e-12);
    ASSERT_LT(worst_compression(run), 5e-3) << run.state.time / us;
  }
  EXPECT_EQ(run.totals(0)[0], 0);
  EXPECT_EQ(run.counted().averaged_states, 0);
  EXPECT_EQ(run.counted().faces_without_value, 0);
}

}  // namespace
}  // namespace recoil::open_edge_test
