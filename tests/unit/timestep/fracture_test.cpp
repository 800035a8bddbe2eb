#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include "../core/dimensions.hpp"
#include "dynamics/primitives.hpp"
#include "run.hpp"
#include "spall_plates.hpp"

namespace recoil::fracture_test {
namespace {

using config::Boundary;
using config::Geometry;

constexpr double mm = 1e-3;

Material breaking(double threshold) {
  Material m = samples::aluminium();
  m.damage = TensileDamage{threshold, 1, 20e-9};
  return m;
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

/// A body that fills a closed domain at a tension of twice the threshold fails by Tuler and Butcher's law at
/// the time tau, whatever part of it a step is: in the step in which its damage reaches 1, not some steps
/// later, by its own state and by the mean around.
TYPED_TEST(Fracture, FailsInTheStepInWhichDamageReachesOne) {
  constexpr int dim = TestFixture::dim;
  constexpr double dx = 0.1 * mm, threshold = 1e9, time = 20e-9;
  config::Vector lo{}, hi{}, out{};
  for (std::size_t d = 0; d < dim; ++d) hi[d] = 8 * dx, lo[d] = 0, out[d] = 12 * dx;
  const Geometry geometry = dim == 1 ? Geometry::line : dim == 2 ? Geometry::planar : Geometry::space;
  config::Vector before{};
  for (std::size_t d = 0; d < dim; ++d) before[d] = -4 * dx;
  auto c =
      case_of(domain_of(geometry, lo, hi, Boundary::symmetry), dx, {body_of("b", box_shape(before, out))});
  c.bodies[0].pressure = -2 * threshold;
  for (const StepStages stages : {StepStages::three, StepStages::one})
    for (const double length : {0.0, 2.5 * dx})
      for (const double steps : {3.5, 8.5}) {
        Material m = breaking(threshold);
        m.damage = TensileDamage{threshold, 1, time};
        m.damage_average.length = length;
        TestRun<dim> run(c, {m});
        run.stepping.stages = stages;
        run.stepping.fixed_dt = time / steps;
        run.steps(static_cast<int>(steps));
        EXPECT_EQ(failed_mass(run, 0), 0);
        using C = Components<dim>;
        const auto totals = run.totals(0);
        EXPECT_NEAR(totals[C::damage] / totals[C::rho], std::floor(steps) / steps, 1e-6);
        run.steps(1);
        EXPECT_NEAR(failed_mass(run, 0) / run.start[0][0], 1, 1e-12);
        EXPECT_NEAR(run.totals(0)[C::damage] / run.totals(0)[C::rho], 1, 1e-12);
      }
}

/// The largest tension [Pa] that matter bears in cells of one body that mostly failed, fuller than a half.
double tension_of_broken(const TestRun<2>& run, int m) {
  using C = Components<2>;
  double most = 0;
  const Body<2>& body = run.state.bodies[static_cast<std::size_t>(m)];
  for (int s = 0; s < run.state.mesh.local(); ++s) {
    if (!body.present(s)) continue;
    const auto& b = body.at(s);
    for_each(run.state.mesh.block(s).cells, [&](const Index<2>& i) {
      const auto k =
          static_cast<std::size_t>(run.state.grid().layout().at(i - run.state.mesh.block(s).cells.lo));
      if (b.volume[k] < 0.5 * run.state.grid().full_volume(i)) return;
      const auto w = std::visit(
          [&](const auto& eos) {
            return to_primitives<2>(eos, contents_of(b, static_cast<int>(k)), b.volume[k]);
          },
          body.material.eos);
      if (w[C::damage] > 0.9 && w[C::damage] < failed_damage) most = std::max(most, -w[C::p]);
    });
  }
  return most;
}

/// A plate that breaks into pieces of some cells: where intact matter comes to voids, no cell pulls with tens
/// of GPa, by its own state, by the mean around, and without a rate.
TEST(Fracture, BrokenMatterDoesNotPull) {
  constexpr double dx = 0.2 * mm;
  auto c =
      case_of(domain_of(Geometry::axisymmetric, {0, -5 * mm, 0}, {8 * mm, 5 * mm, 0}, Boundary::outflow), dx,
              {body_of("striker", box_shape({-5 * mm, 0.1 * mm, 0}, {5 * mm, 3 * mm, 0}), {0, -700, 0}),
               body_of("target", box_shape({-7 * mm, -4 * mm, 0}, {7 * mm, 0, 0}))});
  for (const auto& [damage, length] : {std::pair{Damage{TensileDamage{1.5e9, 2, 50e-9}}, 0.0},
                                       std::pair{Damage{TensileDamage{1.5e9, 2, 50e-9}}, 0.6 * mm},
                                       std::pair{Damage{MinimumPressure{1.2e9}}, 0.0}}) {
    Material m = samples::aluminium();
    m.damage = damage, m.damage_average.length = length;
    TestRun<2> run(c, {m, samples::copper()});
    double most = 0;
    while (run.state.time < 2.5e-6) {
      advance(run.state, run.stepping, 2.5e-6, run.engine);
      most = std::max(most, tension_of_broken(run, 0));
    }
    EXPECT_GT(failed_mass(run, 0), 0.01 * run.start[0][0]);
    EXPECT_LT(most, 8e9) << length;
    EXPECT_LT(run.imbalance(0, 400), 1e-12);
  }
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

/// A body in 1-D whose surface is near its second block of 16 cells and far from the third.
struct LongBody {
  static constexpr double dx = 0.1 * mm;
  TestRun<1> run{plate(), {breaking(1e9)}};
  BodyBlock<1>& near = run.state.bodies[0].at(1);

  LongBody() {
    EXPECT_TRUE(near.near_surface);
    EXPECT_FALSE(run.state.bodies[0].at(2).near_surface);
  }
  static config::Case plate() {
    auto c = case_of(domain_of(Geometry::line, {-10 * dx, 0, 0}, {110 * dx, 0, 0}, Boundary::outflow), dx,
                     {body_of("b", box_shape({0, 0, 0}, {100 * dx, 0, 0}))});
    c.mesh.block = 16;
    return c;
  }
};

/// A fragment that the level set has lost far within a body, small enough to have no value, in the third cell
/// from a block without a surface: the face between the blocks has one flux all the same.
TEST(Fracture, LostFragmentBesideABlockWithoutASurfaceKeepsTheMass) {
  using C = Components<1>;
  LongBody body;
  TestRun<1>& run = body.run;
  BodyBlock<1>& near = body.near;
  const std::size_t n = near.volume.size();
  const auto scale = [&](std::size_t k, double part) {
    for (std::size_t q = 0; q < C::contents; ++q) near.contents[q * n + k] *= part;
  };
  near.volume[13] *= 0.1;
  scale(13, 0.1);
  scale(14, 1.05);
  scale(15, 1.02);
  run.start[0] = run.totals(0);
  run.steps(4);
  EXPECT_LT(run.imbalance(0, 1000), 1e-14);
}

/// A cell of failed matter far within a body, thinner than what stencils use elsewhere, in the last cell of a
/// block that a surface is near: the block beside has none. Both must see the same.
TEST(Fracture, ThinMatterAtTheEdgeOfABlockKeepsItsMass) {
  using C = Components<1>;
  LongBody body;
  TestRun<1>& run = body.run;
  BodyBlock<1>& near = body.near;
  const std::size_t n = near.volume.size(), k = 15;
  for (std::size_t q = 0; q < C::contents; ++q) near.contents[q * n + k] = 0;
  const double mass = 5e-4 * 2700 * near.volume[k];
  near.contents[k] = near.contents[C::damage * n + k] = mass;
  near.contents[C::energy * n + k] = 1e6 * mass;
  run.start[0] = run.totals(0);
  run.steps(8);
  EXPECT_LT(run.imbalance(0, 1000), 1e-14);
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
}  // namespace recoil::fracture_test
