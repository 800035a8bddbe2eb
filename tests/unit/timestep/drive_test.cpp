#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "../core/dimensions.hpp"
#include "material/detonation.hpp"
#include "run.hpp"
#include "state/detonation_front.hpp"

/// What bodies are driven by: detonations, and rigid bodies with a velocity over time.
namespace recoil::drive_test {
namespace {

using config::Boundary;
using config::Geometry;

constexpr double mm = 1e-3, us = 1e-6;
const Jwl tnt{1630, 371.2e9, 3.231e9, 4.15, 0.95, 0.3, 7e9, 6930};

Material explosive() {
  Material m = samples::aluminium();
  m.eos = tnt;
  m.strength = NoStrength{};
  return m;
}

TEST(DetonationFront, ArrivesFirstFromTheNearestPoint) {
  const DetonationFront<2> front{{{{0, 0}}, {{10 * mm, 0}}}, {}, 1 * us, 5000, 1, {}, {}, {}};
  EXPECT_DOUBLE_EQ(front.arrival({{3 * mm, 4 * mm}}), 1 * us + 5 * mm / 5000);
  EXPECT_DOUBLE_EQ(front.arrival({{9 * mm, 0}}), 1 * us + 1 * mm / 5000);
}

/// Periods of 24 mm. The explosive reaches from -16 to 4 mm, so that its lower part has come in at the high
/// end.
TEST(DetonationFront, FollowsTheExplosiveAcrossThePeriod) {
  DetonationFront<2> front{{{{-10 * mm, 0}}}, {}, 0, 5000, 1, {}, {}, {}};
  front.period = {{24 * mm, 0}};
  front.middle = {{-6 * mm, 0}};
  EXPECT_NEAR(front.arrival({{-1 * mm, 0}}), 9 * mm / 5000, 1e-15);
  EXPECT_NEAR(front.arrival({{10 * mm, 0}}), 4 * mm / 5000, 1e-15) << "at -14 mm";
  EXPECT_NEAR(front.arrival({{3 * mm, 0}}), 13 * mm / 5000, 1e-15) << "not through the void";
  front.across = {{1, 0}};
  EXPECT_NEAR(front.arrival({{3 * mm, 0}}), 11 * mm / 5000, 1e-15)
      << "it fills the period: the other way around";
}

TEST(DetonationFront, APlaneRunsBothWays) {
  const DetonationFront<2> front{{{{2 * mm, 0}}}, {{1, 0}}, 0, 5000, 1, {}, {}, {}};
  EXPECT_DOUBLE_EQ(front.arrival({{7 * mm, 90 * mm}}), 5 * mm / 5000);
  EXPECT_DOUBLE_EQ(front.arrival({{1 * mm, -5 * mm}}), 1 * mm / 5000);
}

/// A charge of 10 mm from a wall on along one axis, lit at the wall.
template <int Dim>
config::Case charge(int axis, double dx, int block = 32) {
  const auto e = static_cast<std::size_t>(axis);
  config::Vector lo{}, hi{};
  for (std::size_t d = 0; d < Dim; ++d) hi[d] = 3 * dx;
  hi[e] = 12 * mm;
  const Geometry geometry = Dim == 1 ? Geometry::line : Dim == 2 ? Geometry::planar : Geometry::space;
  auto domain = domain_of(geometry, lo, hi, Boundary::symmetry);
  domain.boundary[e][1] = Boundary::outflow;
  auto high = hi;
  high[e] = 10 * mm;
  auto c = case_of(domain, dx, {body_of("charge", box_shape(lo, high))});
  c.bodies[0].detonation.points = {{}};
  c.bodies[0].detonation.direction[e] = 1;
  c.mesh.block = block;
  return c;
}

template <class D>
struct Detonations : testing::Test {
  static constexpr int dim = D::value;
};
TYPED_TEST_SUITE(Detonations, Dimensions);

TYPED_TEST(Detonations, SetFreeTheEnergyOfWhatHasDetonated) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  TestRun<dim> run(charge<dim>(dim - 1, 0.25 * mm), {explosive()});
  while (run.state.time < 0.5 * us) advance(run.state, run.stepping, 0.5 * us, run.engine);
  double released = 0;
  for (const auto& l : run.state.ledger) released += l.released[0].value();
  const auto now = run.totals(0);
  EXPECT_NEAR(released, tnt.detonated_energy() * now[C::ep], 1e-12 * released);
  EXPECT_NEAR(now[C::energy] - run.start[0][C::energy], released, 1e-12 * released);
  EXPECT_NEAR(now[0], run.start[0][0], 1e-12 * now[0]);
  const double expected = 6930 * 0.5 * us / (10 * mm);  // the part that the front has passed
  EXPECT_NEAR(now[C::ep] / now[0], expected, 0.01);
}

TYPED_TEST(Detonations, DoNotKnowBlocks) {
  constexpr int dim = TestFixture::dim;
  TestRun<dim> one(charge<dim>(0, 0.25 * mm, 16), {explosive()}),
      other(charge<dim>(0, 0.25 * mm, 32), {explosive()});
  one.steps(dim == 3 ? 3 : 20), other.steps(dim == 3 ? 3 : 20);
  EXPECT_EQ(one.cells(0), other.cells(0));
}

TEST(Detonation, LeavesTheStateOfTheExactWaveAtTheWall) {
  // Chapman and Jouguet's state, and from there by the centred wave to rest: 5.6395 GPa.
  TestRun<1> run(charge<1>(0, 0.1 * mm), {explosive()});
  while (run.state.time < 1.2 * us) advance(run.state, run.stepping, 1.2 * us, run.engine);
  const auto& b = run.state.bodies[0].at(0);
  const double mass = b.contents[10], rho = mass / b.volume[10], u = b.contents[b.volume.size() + 10] / mass,
               e = b.contents[Components<1>::energy * b.volume.size() + 10] / mass - 0.5 * u * u;
  EXPECT_NEAR(tnt.pressure(rho, e), 5.6395e9, 0.02 * 5.6395e9);
  EXPECT_NEAR(u, 0, 20);
  EXPECT_NEAR(b.contents[Components<1>::ep * b.volume.size() + 10], mass, 1e-12 * mass);
}

TEST(VelocityHistory, IsStraightBetweenItsTimes) {
  const VelocityHistory<1> h{{1 * us, 3 * us}, {{{10}}, {{30}}}};
  EXPECT_DOUBLE_EQ(h.at(0)[0], 10);
  EXPECT_DOUBLE_EQ(h.at(2 * us)[0], 20);
  EXPECT_DOUBLE_EQ(h.at(9 * us)[0], 30);
  EXPECT_DOUBLE_EQ(h.mean(0, 4 * us)[0], (10 + 40 + 30) / 4.0);
  EXPECT_DOUBLE_EQ(h.mean(1.5 * us, 1.5 * us)[0], 15);
  EXPECT_DOUBLE_EQ(fastest<1>(h), 30);
}

TEST(VelocityHistory, MovesARigidBodyAndItsContact) {
  auto c = case_of(domain_of(Geometry::line, {-3 * mm, 0, 0}, {12 * mm, 0, 0}), 0.05 * mm,
                   {body_of("piston", box_shape({-2 * mm, 0, 0}, {0, 0, 0})),
                    body_of("block", box_shape({0, 0, 0}, {10 * mm, 0, 0}))});
  c.bodies[0].rigid = true;
  c.bodies[0].velocity_history = {{0, {0, 0, 0}}, {0.5 * us, {100, 0, 0}}};
  TestRun<1> run(c, {Material{}, samples::aluminium()});
  while (run.state.time < 1 * us) advance(run.state, run.stepping, 1 * us, run.engine);
  const RigidMotion<1>& piston = *run.state.bodies[0].rigid;
  EXPECT_NEAR(piston.centre[0] - piston.start_centre[0], 100 * 0.75 * us, 1e-12);
  EXPECT_DOUBLE_EQ(piston.velocity[0], 100);
  EXPECT_LT(run.imbalance(1, 100), 1e-12);
  EXPECT_GT(run.totals(1)[1], 0);
}

/// Its left face flies from -5 mm to the right face of the block at 4 mm, 3 mm away across the edge.
TEST(RigidBodies, MeetTheBodyBehindTheEdgeOfAPeriod) {
  for (const double mass : {0.0, 10.0}) {
    auto c = case_of(domain_of(Geometry::line, {-6 * mm, 0, 0}, {6 * mm, 0, 0}, Boundary::periodic), 0.1 * mm,
                     {body_of("piston", box_shape({-5 * mm, 0, 0}, {-4 * mm, 0, 0}), {-900, 0, 0}),
                      body_of("block", box_shape({2 * mm, 0, 0}, {4 * mm, 0, 0}))});
    c.bodies[0].rigid = true;
    c.bodies[0].mass = mass;
    TestRun<1> run(c, {Material{}, samples::aluminium()});
    const auto go_to = [&](double time) {
      while (run.state.time < time) advance(run.state, run.stepping, time, run.engine);
    };
    go_to(3.3 * us);
    EXPECT_EQ(run.received(1).momentum[0], 0) << "the gap is open until 3.333 us";
    go_to(3.6 * us);
    EXPECT_LT(run.received(1).momentum[0], 0);
    EXPECT_LT(run.imbalance(1, 900), 1e-12);
    if (mass == 0) {
      EXPECT_NEAR(run.state.bodies[0].rigid->centre[0], -900 * run.state.time, 1e-12);
    }
  }
}

/// The products of a bare charge fill the domain and leave it on all sides.
TEST(Detonation, ProductsLeaveThroughOpenEdges) {
  const auto domain = domain_of(Geometry::planar, vector_of(-12 * mm, -12 * mm), vector_of(12 * mm, 12 * mm));
  const auto shape = box_shape(vector_of(-3 * mm, -3 * mm), vector_of(3 * mm, 3 * mm));
  auto c = case_of(domain, 0.5 * mm, {body_of("charge", shape)});
  c.bodies[0].detonation.points = {vector_of(0, 0)};
  TestRun<2> run(c, {explosive()});
  double before = run.start[0][0];
  while (run.state.time < 10 * us) {
    advance(run.state, run.stepping, 1, run.engine);
    const double mass = run.totals(0)[0];
    ASSERT_LE(mass, before * (1 + 1e-12)) << "nothing comes in";
    before = mass;
  }
  EXPECT_LT(before, 0.3 * run.start[0][0]);
  EXPECT_EQ(run.counted().averaged_states, 0);
}

}  // namespace
}  // namespace recoil::drive_test
