#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <variant>

#include "../core/dimensions.hpp"
#include "core/error.hpp"
#include "run.hpp"

/// Pressures from outside on surfaces.
namespace recoil::load_test {
namespace {

using config::Boundary;
using config::Geometry;

constexpr double mm = 1e-3, us = 1e-6, GPa = 1e9;

config::Load load_on(const char* body) {
  config::Load load;
  load.name = "load";
  load.body = body;
  return load;
}

/// A plate of 4 mm with a load on its left face.
template <int Dim>
config::Case plate(const config::Load& load) {
  const double dx = Dim == 3 ? 0.5 * mm : 0.25 * mm;
  config::Vector lo{}, hi{}, from{}, to{};
  for (std::size_t d = 0; d < Dim; ++d) hi[d] = to[d] = 4 * dx;
  lo[0] = -2 * mm, hi[0] = 8 * mm;
  to[0] = 4 * mm;
  const Geometry geometry = Dim == 1 ? Geometry::line : Dim == 2 ? Geometry::planar : Geometry::space;
  auto domain = domain_of(geometry, lo, hi, Boundary::symmetry);
  domain.boundary[0] = {Boundary::outflow, Boundary::outflow};
  auto c = case_of(domain, dx, {body_of("plate", box_shape(from, to))});
  c.loads = {load};
  c.loads[0].facing = {-1, 0, 0};
  return c;
}

template <int Dim>
Account<Dim> given(const State<Dim>& state, std::size_t body = 0) {
  Account<Dim> sum;
  for (const auto& l : state.ledger) {
    const Account<Dim> own = l.loads[body].received.value();
    sum.energy += own.energy;
    sum.momentum += own.momentum;
  }
  return sum;
}

template <class D>
struct Loads : testing::Test {
  static constexpr int dim = D::value;
};
TYPED_TEST_SUITE(Loads, Dimensions);

TYPED_TEST(Loads, GiveABodyExactlyTheirImpulseAndWork) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  auto load = load_on("plate");
  load.history = {{0, 0}, {0.2 * us, 2 * GPa}, {0.3 * us, 0}};  // corners within steps
  const auto c = plate<dim>(load);
  TestRun<dim> run(c, {samples::aluminium()});
  while (run.state.time < 0.5 * us) advance(run.state, run.stepping, 0.5 * us, run.engine);
  const Account<dim> received = given(run.state);
  double area = 1;
  for (int d = 1; d < dim; ++d) area *= 4 * c.mesh.finest;
  const double impulse = 0.3 * GPa * us * area;
  EXPECT_NEAR(received.momentum[0], impulse, 1e-12 * impulse);
  const auto now = run.totals(0), &then = run.start[0];
  EXPECT_NEAR(now[C::u] - then[C::u], impulse, 1e-12 * impulse);
  EXPECT_NEAR(now[C::energy] - then[C::energy], received.energy, 1e-12 * received.energy);
  EXPECT_GT(received.energy, 0);
  EXPECT_NEAR(now[0], then[0], 1e-12 * then[0]);
}

TYPED_TEST(Loads, LeaveTheirPressureBehindTheWave) {
  constexpr int dim = TestFixture::dim;
  auto load = load_on("plate");
  load.pressure = "0.05*GPa";
  TestRun<dim> run(plate<dim>(load), {samples::aluminium()});
  while (run.state.time < 0.5 * us) advance(run.state, run.stepping, 0.5 * us, run.engine);
  // A weak elastic wave: u = p/(rho c_L), in matter that is at rest before it.
  const auto& m = samples::aluminium();
  const double rho = std::visit([](const auto& e) { return e.rho0; }, m.eos);
  const double now = run.totals(0)[Components<dim>::u];
  double area = 1;
  for (int d = 1; d < dim; ++d) area *= 4 * run.state.grid().dx;
  EXPECT_NEAR(now, 0.05 * GPa * 0.5 * us * area, 1e-12 * now);
  const double work = given(run.state).energy, speed = work / now;
  EXPECT_NEAR(speed * rho * 6300, 0.05 * GPa, 0.1 * 0.05 * GPa) << "the face moves with p/(rho c_L)";
}

TEST(SurfaceLoad, ActsOnlyOnWhatFacesItsDirectionAndByPart) {
  auto load = load_on("plate");
  load.pressure = "1*GPa";
  load.part = "x > 2*mm";  // not at the face that looks this way
  TestRun<1> run(plate<1>(load), {samples::aluminium()});
  run.steps(5);
  EXPECT_EQ(given(run.state).momentum[0], 0);
  load.part = "t > 1*ms ? 1 : 0.5";
  TestRun<1> half(plate<1>(load), {samples::aluminium()});
  half.steps(5);
  EXPECT_NEAR(given(half.state).momentum[0], 0.5 * GPa * half.state.time, 1e-6);
}

TEST(SurfaceLoad, WithoutADirectionPressesFromAllSides) {
  auto load = load_on("plate");
  load.pressure = "0.1*GPa";
  auto c = plate<1>(load);
  c.loads[0].facing = {};
  TestRun<1> run(c, {samples::aluminium()});
  run.steps(40);
  EXPECT_NEAR(given(run.state).momentum[0], 0, 1e-9);
  EXPECT_GT(given(run.state).energy, 0);
}

TEST(SurfaceLoad, BelowZeroPulls) {
  auto load = load_on("plate");
  load.pressure = "-0.1*GPa";
  TestRun<1> run(plate<1>(load), {samples::aluminium()});
  run.steps(10);
  EXPECT_LT(run.totals(0)[Components<1>::u], 0);
}

TEST(SurfaceLoad, WithoutAFiniteValueStopsTheRun) {
  auto load = load_on("plate");
  load.pressure = "GPa*sqrt(-t/us)";
  TestRun<1> run(plate<1>(load), {samples::aluminium()});
  EXPECT_THROW(run.steps(1), PhysicsError);
}

TEST(SurfaceLoad, OfOneStageGivesTheSameImpulse) {
  auto load = load_on("plate");
  load.history = {{0, 0}, {0.2 * us, 2 * GPa}, {0.3 * us, 0}};
  TestRun<1> run(plate<1>(load), {samples::aluminium()});
  run.stepping.stages = StepStages::one;
  while (run.state.time < 0.5 * us) advance(run.state, run.stepping, 0.5 * us, run.engine);
  EXPECT_NEAR(given(run.state).momentum[0], 0.3 * GPa * us, 1e-9);
}

}  // namespace
}  // namespace recoil::load_test
