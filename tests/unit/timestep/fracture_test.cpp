#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "../core/dimensions.hpp"
#include "dynamics/primitives.hpp"
#include "run.hpp"

namespace recoil {
namespace {

using config::Boundary;
using config::Geometry;

constexpr double mm = 1e-3;

Material breaking(double threshold) {
  Material m = samples::aluminium();
  m.damage = TensileDamage{threshold, 1, 20e-9};
  return m;
}

/// Aluminium of 1 mm at 400 m/s on 2 mm along one axis, between planes of symmetry: the target spalls.
template <int Dim>
config::Case plates(int axis, double dx, int block = 32) {
  const auto e = static_cast<std::size_t>(axis);
  config::Vector lo{}, hi{}, u{};
  for (std::size_t d = 0; d < Dim; ++d) hi[d] = 3 * dx;
  lo[e] = -2 * mm, hi[e] = 3.6 * mm, u[e] = 400;
  const Geometry geometry = Dim == 1 ? Geometry::line : Dim == 2 ? Geometry::planar : Geometry::space;
  auto domain = domain_of(geometry, lo, hi, Boundary::symmetry);
  domain.boundary[e] = {Boundary::outflow, Boundary::outflow};
  auto low = lo, high = hi;
  low[e] = -1 * mm, high[e] = 0;
  auto c = case_of(domain, dx, {body_of("flyer", box_shape(low, high), u)});
  low[e] = 0, high[e] = 2 * mm;
  c.bodies.push_back(body_of("target", box_shape(low, high)));
  c.mesh.offset = 0.37;
  c.mesh.block = block;
  return c;
}

template <int Dim>
double failed_mass(const TestRun<Dim>& run, int m) {
  using C = Components<Dim>;
  double sum = 0;
  for (const auto& b : run.state.bodies[m].blocks)
    for (std::size_t k = 0; k < b.volume.size(); ++k)
      if (b.contents[C::damage * b.volume.size() + k] >= failed_damage * b.contents[k]) sum += b.contents[k];
  return sum;
}

/// Mean velocity of what is behind the middle of the target: of the scab, where it has broken off.
template <int Dim>
double speed_behind(const TestRun<Dim>& run, int axis, double place) {
  using C = Components<Dim>;
  double mass = 0, momentum = 0;
  for (int s = 0; s < run.state.mesh.local(); ++s) {
    const auto& b = run.state.bodies[1].at(s);
    if (!b.present) continue;
    const Box<Dim> own = run.state.mesh.block(s).cells;
    for_each(own, [&](const Index<Dim>& i) {
      if (run.state.grid().centre(i)[axis] < place) return;
      const auto k = static_cast<std::size_t>(run.state.grid().layout().at(i - own.lo));
      mass += b.contents[k];
      momentum += b.contents[static_cast<std::size_t>(C::u + axis) * b.volume.size() + k];
    });
  }
  return momentum / mass;
}

template <class D>
struct Fracture : testing::Test {
  static constexpr int dim = D::value;
};
TYPED_TEST_SUITE(Fracture, Dimensions);

/// The scab keeps most of the momentum that it was given, and flies off; no budget opens.
TYPED_TEST(Fracture, AScabFliesOff) {
  constexpr int dim = TestFixture::dim;
  for (const StepStages stages : {StepStages::three, StepStages::one}) {
    TestRun<dim> run(plates<dim>(dim - 1, 0.1 * mm), {breaking(1e12), breaking(1e9)});
    run.stepping.stages = stages;
    while (run.state.time < 1.5e-6) advance(run.state, run.stepping, 1.5e-6, run.engine);
    EXPECT_EQ(failed_mass(run, 0), 0);
    EXPECT_GT(failed_mass(run, 1), 0.05 * run.start[1][0]);
    EXPECT_LT(run.imbalance(0, 400), 1e-12);
    EXPECT_LT(run.imbalance(1, 400), 1e-12);
    EXPECT_GT(speed_behind(run, dim - 1, 2.2 * mm), 260) << "178 m/s without failure";
  }
}

/// A body that may fail but does not, and one that cannot, are the same to the last bit.
TYPED_TEST(Fracture, WhatDoesNotFailIsAsItWas) {
  constexpr int dim = TestFixture::dim;
  TestRun<dim> may(plates<dim>(0, 0.1 * mm), {breaking(1e12), breaking(1e12)}),
      cannot(plates<dim>(0, 0.1 * mm), {samples::aluminium(), samples::aluminium()});
  may.steps(60);
  cannot.steps(60);
  EXPECT_EQ(may.state.time, cannot.state.time);
  EXPECT_EQ(may.cells(1), cannot.cells(1));
}

TYPED_TEST(Fracture, BlocksAndThreadsDoNotMatter) {
  constexpr int dim = TestFixture::dim;
  TestRun<dim> one(plates<dim>(0, 0.1 * mm, 16), {breaking(1e9), breaking(1e9)}),
      other(plates<dim>(0, 0.1 * mm, 28), {breaking(1e9), breaking(1e9)}, 2);
  one.steps(50 + 90 * dim);
  other.steps(50 + 90 * dim);
  EXPECT_GT(failed_mass(one, 1), 0);
  EXPECT_EQ(one.state.time, other.state.time);
  EXPECT_EQ(one.cells(1), other.cells(1));
}

/// An aluminium sphere of 4 mm at 6 km/s on a block, which breaks up and flies apart over many blocks of
/// cells: budgets close, and hardly a state has to be replaced.
TEST(FractureAtHypervelocity, BudgetsClose) {
  auto domain = domain_of(Geometry::axisymmetric, {0, -6 * mm, 0}, {9 * mm, 7 * mm, 0}, Boundary::outflow);
  auto c = case_of(domain, mm / 4, {body_of("sphere", ball_shape({0, -2 * mm, 0}, 2 * mm), {0, 6000, 0})});
  c.bodies.push_back(body_of("block", box_shape({0, 0, 0}, {9 * mm, 7 * mm, 0})));
  c.mesh.block = 16;
  TestRun<2> run(c, {breaking(1e9), breaking(1e9)});
  while (run.state.time < 2.2e-6) advance(run.state, run.stepping, 2.2e-6, run.engine);
  for (int m = 0; m < 2; ++m) EXPECT_LT(run.imbalance(m, 6000), 1e-12);
  const Counters counted = run.counted();
  EXPECT_LE(counted.averaged_states, 3);
  EXPECT_GT(failed_mass(run, 0) + failed_mass(run, 1), 0);
  EXPECT_GT(counted.opened_cells + counted.restored_cells, 0);
}

/// The averages of one stage do not remember those of another: resumed runs have the same bits.
TEST(Fracture, AVoidThatHasClosedKeepsNoEnergy) {
  using C = Components<2>;
  TestRun<2> run(plates<2>(0, 0.1 * mm), {breaking(1e9), breaking(1e9)});
  Body<2>& target = run.state.bodies[1];
  int slot = 0;
  while (!target.present(slot)) ++slot;
  BodyBlock<2>& b = target.at(slot);
  const std::size_t n = b.volume.size();
  std::size_t k = 0;
  while (!(b.volume[k] > 0.99 * run.state.grid().dx_power(2))) ++k;
  b.contents[C::rho * n + k] *= 0.9;  // in tension
  b.contents[C::damage * n + k] = b.contents[C::rho * n + k];
  Counters counters;
  choose_roles(run.state, target, slot, counters);
  average_primitives(run.state, target, slot, counters);
  EXPECT_EQ(b.average[C::p * n + k], 0);
  EXPECT_NE(b.average[C::extra * n + k], 0);
  b.contents[C::energy * n + k] += 1e7 * b.contents[C::rho * n + k];  // hot: under pressure again
  average_primitives(run.state, target, slot, counters);
  EXPECT_GT(b.average[C::p * n + k], 0);
  EXPECT_EQ(b.average[C::extra * n + k], 0);
}

}  // namespace
}  // namespace recoil
