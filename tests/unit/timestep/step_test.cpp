#include "timestep/step.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "run.hpp"

namespace recoil::step_test {
namespace {

using config::Boundary;
using config::Geometry;

constexpr double mm = 1e-3, us = 1e-6;

/// Aluminium 2 mm at 450 m/s onto copper 15 mm.
config::Case flyer(double dx) {
  auto c = case_of(domain_of(Geometry::line, vector_of(-4 * mm), vector_of(17.5 * mm)), dx,
                   {body_of("flyer", box_shape(vector_of(-2 * mm), vector_of(0)), vector_of(450)),
                    body_of("target", box_shape(vector_of(0), vector_of(15 * mm)))});
  c.mesh.offset = 0.37;
  return c;
}

TEST(Flyer, BudgetsCloseAndThePlatesPart) {
  TestRun<1> run(flyer(0.2 * mm), {samples::aluminium(), samples::copper()});
  double opens = -1, stress = 0, velocity = 0;
  int n = 0;
  while (run.state.time < 1 * us) {
    advance(run.state, run.stepping, 1 * us, run.engine);
    const double area = run.contact_area(0);
    if (area > 0) opens = run.state.time;
    if (area > 0 && run.state.time > 0.2 * us && run.state.time < 0.5 * us) {
      ++n;
      for (const auto& l : run.state.ledger) {
        stress += l.pairs[0].traction.value();
        velocity += l.pairs[0].velocity.value();
      }
    }
  }
  EXPECT_EQ(run.state.time, 1 * us);  // the last step ends there
  EXPECT_LT(run.imbalance(0, 450), 1e-12);
  EXPECT_LT(run.imbalance(1, 450), 1e-12);
  EXPECT_GT(opens, 0.70 * us);
  EXPECT_LT(opens, 0.74 * us);
  EXPECT_NEAR(stress / n, -5.09e9, 0.03e9);  // the plane wave of the two Hugoniots
  EXPECT_NEAR(velocity / n, 133.3, 1);
  EXPECT_EQ(run.counted().averaged_states, 0);
  EXPECT_EQ(run.counted().faces_without_value, 0);
}

TEST(Flyer, ATurnedPictureGivesTheSame) {
  // The mirror image of flyer() about x = 0 flies the other way.
  auto mirrored = case_of(domain_of(Geometry::line, vector_of(-17.6 * mm), vector_of(4 * mm)), 0.2 * mm,
                          {body_of("flyer", box_shape(vector_of(0), vector_of(2 * mm)), vector_of(-450)),
                           body_of("target", box_shape(vector_of(-15 * mm), vector_of(0)))});
  auto plain = flyer(0.2 * mm);
  plain.domain.hi[0] = 17.6 * mm;
  plain.mesh.offset = mirrored.mesh.offset = 0;
  const std::vector<Material> materials{samples::aluminium(), samples::copper()};
  TestRun<1> a(plain, materials), b(mirrored, materials);
  a.steps(40);
  b.steps(40);
  EXPECT_NEAR(a.state.time / b.state.time, 1, 1e-9);
  for (int m = 0; m < 2; ++m) {
    const auto p = a.totals(m), q = b.totals(m);
    EXPECT_NEAR(p[1], -q[1], 1e-9 * p[0] * 450);
    EXPECT_NEAR(p[Components<1>::energy], q[Components<1>::energy], 1e-9 * p[0] * 450 * 450);
  }
}

/// A body that nothing touches moves on as it is: no force, no change of shape, to round-off.
template <int Dim>
void fly_free(const config::Case& c, int steps, double speed) {
  TestRun<Dim> run(c, {samples::copper()});
  run.steps(steps);
  EXPECT_LT(run.imbalance(0, speed), 1e-13);
  const auto now = run.totals(0);
  for (std::size_t k = Components<Dim>::s; k < now.size(); ++k)
    EXPECT_NEAR(now[k], 0, 1e-3 * now[0]) << k;  // 1e-3 Pa
  double worst = 0;
  for (const auto& b : run.state.bodies[0].blocks)
    for (std::size_t k = 0; k < b.volume.size(); ++k)
      if ((b.role[k] & regular) != 0)
        worst = std::max(worst, std::abs(b.average[Components<Dim>::p * b.volume.size() + k]));
  EXPECT_LT(worst, 1) << "Pa";
  EXPECT_EQ(run.counted().averaged_states, 0);
  EXPECT_EQ(run.counted().faces_without_value, 0);
}

TEST(FreeFlight, Disc) {
  const config::Vector u = vector_of(300, 170);
  const auto shape = ball_shape(vector_of(0.03 * mm, 0.01 * mm), 1 * mm);
  auto c = case_of(domain_of(Geometry::planar, vector_of(-3 * mm, -3 * mm), vector_of(3 * mm, 3 * mm)),
                   0.2 * mm, {body_of("disc", shape, u)});
  c.mesh.block = 15;
  fly_free<2>(c, 10, 350);
}

TEST(FreeFlight, BallInSpace) {
  const auto shape = ball_shape(vector_of(0, 0, 0), 0.8 * mm);
  const auto domain =
      domain_of(Geometry::space, vector_of(-2 * mm, -2 * mm, -2 * mm), vector_of(2 * mm, 2 * mm, 2 * mm));
  fly_free<3>(case_of(domain, 0.2 * mm, {body_of("ball", shape, vector_of(300, 170, -90))}), 4, 360);
}

TEST(FreeFlight, RodAlongTheAxis) {
  const auto domain = domain_of(Geometry::axisymmetric, vector_of(0, -3 * mm), vector_of(2 * mm, 3 * mm));
  const auto shape = box_shape(vector_of(0, -1.5 * mm), vector_of(0.95 * mm, 1.5 * mm));
  fly_free<2>(case_of(domain, 0.2 * mm, {body_of("rod", shape, vector_of(0, 400))}), 10, 400);
}

/// The plates of flyer() along one axis of more, between planes of symmetry.
template <int Dim>
config::Case aligned(int axis, double dx) {
  const auto e = static_cast<std::size_t>(axis);
  config::Vector lo{}, hi{}, u{};
  for (std::size_t d = 0; d < 3; ++d) hi[d] = 3 * dx;
  lo[e] = -3 * mm;
  hi[e] = 4 * mm;
  u[e] = 450;
  auto domain = domain_of(Dim == 2 ? Geometry::planar : Geometry::space, lo, hi, Boundary::symmetry);
  domain.boundary[e] = {Boundary::outflow, Boundary::outflow};
  auto low = lo, high = hi;
  low[e] = -2 * mm;
  high[e] = 0;
  auto c = case_of(domain, dx, {body_of("flyer", box_shape(low, high), u)});
  low[e] = 0;
  high[e] = 3 * mm;
  c.bodies.push_back(body_of("target", box_shape(low, high)));
  c.mesh.offset = 0.37;
  c.mesh.block = 16;
  return c;
}

/// Cells along the axis of both, after the same steps of one length.
template <int Dim>
void compare_with_line(int axis, int steps, double tolerance = 1e-9) {
  const double dx = 0.2 * mm, dt = 15e-9;
  const std::vector<Material> materials{samples::aluminium(), samples::copper()};
  auto line = flyer(dx);
  line.domain.lo[0] = -3 * mm;
  line.domain.hi[0] = 4 * mm;
  std::get<config::Box>(line.bodies[1].shape.form).hi[0] = 3 * mm;
  TestRun<1> one(line, materials);
  TestRun<Dim> more(aligned<Dim>(axis, dx), materials);
  one.stepping.fixed_dt = more.stepping.fixed_dt = dt;
  one.steps(steps);
  more.steps(steps);
  using A = Components<1>;
  using B = Components<Dim>;
  const double side = std::pow(dx, Dim - 1);
  EXPECT_GT(one.contact_area(0), 0);
  EXPECT_NEAR(more.contact_area(0) / side / std::pow(3, Dim - 1), 1, 1e-9);
  for (int m = 0; m < 2; ++m) {
    const auto a = one.cells(m), b = more.cells(m);
    const Box<Dim> domain = more.state.grid().domain();
    for_each(domain, [&](const Index<Dim>& i) {
      const double* q1 = a.data() + static_cast<std::size_t>(i[axis]) * (A::contents + 1);
      const double* q2 = b.data() + static_cast<std::size_t>(domain.at(i)) * (B::contents + 1);
      const double rho = density(materials[m]);
      ASSERT_NEAR(q2[0] / side, q1[0], tolerance * dx);
      ++q1;
      ++q2;
      ASSERT_NEAR(q2[0] / side, q1[0], tolerance * rho * dx);
      ASSERT_NEAR(q2[B::u + axis] / side, q1[A::u], tolerance * rho * 450 * dx);
      ASSERT_NEAR(q2[B::energy] / side, q1[A::energy], tolerance * rho * 450 * 450 * dx);
      for (int d = 0; d < Dim; ++d) {
        if (d == axis) continue;
        ASSERT_NEAR(q2[B::u + d] / side, 0, tolerance * rho * 450 * dx);
      }
      const int c = B::stress(axis, axis);
      const double normal = c >= 0 ? q2[B::s + c] : -q2[B::s] - q2[B::s + 1];
      ASSERT_NEAR(normal / side, q1[A::s], tolerance * rho * 1e9 * dx);
      ASSERT_NEAR(q2[B::ep] / side, q1[A::ep], tolerance * rho * dx);
    });
  }
}

TEST(AlignedPlates, AlongXAreTheSameAsOnALine) { compare_with_line<2>(0, 30); }
TEST(AlignedPlates, AlongYAreTheSameAsOnALine) { compare_with_line<2>(1, 30); }
TEST(AlignedPlates, AlongXInSpaceAreTheSameAsOnALine) { compare_with_line<3>(0, 5); }
TEST(AlignedPlates, AlongZInSpaceAreTheSameAsOnALine) { compare_with_line<3>(2, 5); }

/// A disc that hits a plate askew, for a few steps.
config::Case oblique(int block) {
  auto c =
      case_of(domain_of(Geometry::planar, vector_of(-3 * mm, -3 * mm), vector_of(3 * mm, 3 * mm)), 0.15 * mm,
              {body_of("disc", ball_shape(vector_of(-1.005 * mm, 0), 1 * mm), vector_of(600, 200)),
               body_of("plate", box_shape(vector_of(0, -2.5 * mm), vector_of(1 * mm, 2.5 * mm)))});
  c.mesh.block = block;
  c.mesh.offset = 0.21;
  return c;
}

TEST(Determinism, ThreadsAndBlocksGiveTheSameBits) {
  const std::vector<Material> materials{samples::aluminium(), samples::copper()};
  std::vector<std::vector<double>> found;
  std::vector<double> time;
  for (const auto& [block, threads] :
       {std::pair{14, 1}, std::pair{14, 2}, std::pair{10, 1}, std::pair{41, 1}}) {
    TestRun<2> run(oblique(block), materials, threads);
    run.steps(8);
    EXPECT_GT(run.contact_area(0), 0);
    EXPECT_LT(run.imbalance(0, 600), 1e-12);
    EXPECT_LT(run.imbalance(1, 600), 1e-12);
    time.push_back(run.state.time);
    found.push_back(run.cells(0));
    const auto more = run.cells(1);
    found.back().insert(found.back().end(), more.begin(), more.end());
  }
  for (std::size_t k = 1; k < found.size(); ++k) {
    EXPECT_EQ(time[k], time[0]) << k;
    ASSERT_EQ(found[k].size(), found[0].size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < found[k].size(); ++i) different += found[k][i] != found[0][i];
    EXPECT_EQ(different, 0U) << k;
  }
}

/// A bar on a rigid wall: the wall takes momentum and no energy.
TEST(Taylor, BudgetsCloseAgainstARigidWall) {
  const auto domain =
      domain_of(Geometry::axisymmetric, vector_of(0, -0.8 * mm), vector_of(2.4 * mm, 3.2 * mm));
  auto c =
      case_of(domain, 0.2 * mm,
              {body_of("bar", box_shape(vector_of(0, 0), vector_of(1.1 * mm, 2.3 * mm)), vector_of(0, -227)),
               body_of("wall", box_shape(vector_of(0, -0.8 * mm), vector_of(2.4 * mm, 0)))});
  c.bodies[1].rigid = true;
  TestRun<2> run(c, {samples::copper(), Material{}});
  run.steps(25);
  EXPECT_LT(run.imbalance(0, 227), 1e-12);
  EXPECT_GT(run.received(0).momentum[1], 0.05 * run.start[0][0] * 227);
  EXPECT_EQ(run.received(0).energy, 0);
  EXPECT_EQ(run.received(0).mass, 0);
  EXPECT_GT(run.totals(0)[Components<2>::ep], 0);
  EXPECT_EQ(run.counted().averaged_states, 0);
}

TEST(Advance, KeepsToTheGivenLengthAndEnd) {
  TestRun<1> run(flyer(0.5 * mm), {samples::aluminium(), samples::copper()});
  run.stepping.fixed_dt = 3e-9;
  EXPECT_EQ(advance(run.state, run.stepping, 1e-6, run.engine), 3e-9);
  EXPECT_NEAR(advance(run.state, run.stepping, 4e-9, run.engine), 1e-9, 1e-20);
  EXPECT_EQ(run.state.step, 2);
  // dt = cfl dx/(|u| + c_L), of the flyer
  TestRun<1> fresh(flyer(0.5 * mm), {samples::aluminium(), samples::copper()});
  fresh.stepping.cfl = 0.5;
  EXPECT_NEAR(advance(fresh.state, fresh.stepping, 1, fresh.engine),
              0.5 * 0.5 * mm / (450 + longitudinal_speed(samples::aluminium())), 1e-15);
}

/// Linear sound bears a CFL number of 1.435 in three stages and of 1 in one.
TEST(Advance, SaysWhereAStepIsLongerThanAStableOne) {
  for (const auto& [stages, bears] : {std::pair{StepStages::three, 1.4}, {StepStages::one, 1.0}}) {
    TestRun<1> run(flyer(0.5 * mm), {samples::aluminium(), samples::copper()});
    run.stepping.stages = stages;
    const double crossing = 0.5 * mm / (450 + longitudinal_speed(samples::aluminium()));
    run.stepping.fixed_dt = 0.99 * bears * crossing;
    advance(run.state, run.stepping, 1, run.engine);
    EXPECT_FALSE(run.engine.unstable);
    run.stepping.fixed_dt = 1.1 * bears * crossing;
    advance(run.state, run.stepping, 1, run.engine);
    EXPECT_TRUE(run.engine.unstable);
    run.stepping.fixed_dt.reset();
    advance(run.state, run.stepping, 1, run.engine);
    EXPECT_FALSE(run.engine.unstable);
  }
}

TEST(Advance, ACollapsedStepIsAnError) {
  TestRun<1> run(flyer(0.5 * mm), {samples::aluminium(), samples::copper()});
  run.stepping.cfl = 1e-12;
  EXPECT_THROW(run.steps(1), PhysicsError);
}

TEST(StepParts, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (int p = 0; p < static_cast<int>(StepPhase::count); ++p)
    names.insert(name_of(static_cast<StepPhase>(p)));
  EXPECT_EQ(static_cast<int>(names.size()), static_cast<int>(StepPhase::count));
}

}  // namespace
}  // namespace recoil::step_test
