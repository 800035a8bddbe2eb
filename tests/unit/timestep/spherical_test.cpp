#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "run.hpp"

/// One dimension with spherical symmetry. Sums are per steradian.
namespace recoil::spherical_test {
namespace {

using config::Geometry;
using C = Components<1>;

constexpr double mm = 1e-3, us = 1e-6, GPa = 1e9;

config::Body shell_of(const char* name, double from, double to, double velocity = 0) {
  return body_of(name, box_shape(vector_of(from), vector_of(to)), vector_of(velocity));
}

config::Case spheres(double dx, std::vector<config::Body> bodies) {
  auto domain = domain_of(Geometry::spherical, vector_of(0), vector_of(10 * mm));
  domain.boundary[0][0] = config::Boundary::axis;
  return case_of(domain, dx, std::move(bodies));
}

/// A shell of aluminium that strikes a copper sphere.
config::Case imploding() {
  return spheres(0.1 * mm, {shell_of("shell", 5 * mm, 6.53 * mm, -500), shell_of("sphere", 0, 4.97 * mm)});
}

/// f(place, radius of the centre) for the cells of a body with matter.
template <class F>
void for_each_cell(const TestRun<1>& run, int body, F&& f) {
  for (int s = 0; s < run.state.mesh.local(); ++s) {
    const auto& b = run.state.bodies[body].at(s);
    const Box<1> cells = run.state.mesh.block(s).cells;
    if (!b.present) continue;
    for_each(cells, [&](const Index<1>& i) {
      const auto k = static_cast<std::size_t>(run.state.grid().layout().at(i - cells.lo));
      if (b.contents[k] > 0) f(b, k, run.state.grid().centre(i)[0]);
    });
  }
}

TEST(Spherical, MassIsThatOfTheShapes) {
  const TestRun<1> run(imploding(), {samples::aluminium(), samples::copper()});
  const auto volume = [](double from, double to) { return (std::pow(to, 3) - std::pow(from, 3)) / 3; };
  const double shell = 2700 * volume(5 * mm, 6.53 * mm), sphere = 8930 * volume(0, 4.97 * mm);
  EXPECT_NEAR(run.start[0][0], shell, 1e-5 * shell);
  EXPECT_NEAR(run.start[1][0], sphere, 1e-5 * sphere);
}

TEST(Spherical, WhatIsAtRestStaysSo) {
  auto c = imploding();
  c.bodies[0].velocity = {};
  TestRun<1> run(c, {samples::aluminium(), samples::copper()});
  run.steps(20);
  for (int m = 0; m < 2; ++m)
    for_each_cell(run, m, [&](const BodyBlock<1>& b, std::size_t k, double r) {
      ASSERT_EQ(b.contents[C::u * b.volume.size() + k], 0) << r;
    });
}

TEST(Spherical, OnePressureEverywhereMovesNothing) {
  auto c = spheres(0.1 * mm, {shell_of("shell", 5.03 * mm, 9 * mm), shell_of("sphere", 0, 5.03 * mm)});
  for (auto& b : c.bodies) b.pressure = 2 * GPa;
  TestRun<1> run(c, {samples::aluminium(), samples::copper()});
  while (run.state.time < 0.2 * us) advance(run.state, run.stepping, 0.2 * us, run.engine);
  for (int m = 0; m < 2; ++m)
    for_each_cell(run, m, [&](const BodyBlock<1>& b, std::size_t k, double r) {
      const double velocity = b.contents[C::u * b.volume.size() + k] / b.contents[k];
      EXPECT_LT(r < 5.5 * mm ? std::abs(velocity) : 0, 1e-7) << r;
    });
}

TEST(Spherical, UniformExpansionHasNoShear) {
  auto c = spheres(0.1 * mm, {shell_of("sphere", 0, 8 * mm)});
  c.bodies[0].velocity_field.r = "20*m/s * r/(8*mm)";
  TestRun<1> run(c, {samples::copper()});
  while (run.state.time < 0.5 * us) advance(run.state, run.stepping, 0.5 * us, run.engine);
  int seen = 0;
  for_each_cell(run, 0, [&](const BodyBlock<1>& b, std::size_t k, double r) {
    if (r > 3.5 * mm) return;  // the release has not come so far
    const auto n = b.volume.size();
    EXPECT_NEAR(b.contents[k] / b.volume[k], 8930 * (1 - 3 * 2500 * 0.5 * us), 0.2) << r;
    EXPECT_LT(std::abs(b.contents[C::s * n + k] / b.contents[k]), 100)
        << r;  // Pa, of a bulk stress of 0.5 GPa
    ++seen;
  });
  EXPECT_EQ(seen, 35);
}

TEST(Spherical, ShellsThatMeetKeepTheirBalances) {
  for (const StepStages stages : {StepStages::three, StepStages::one}) {
    TestRun<1> run(imploding(), {samples::aluminium(), samples::copper()});
    run.stepping.stages = stages;
    while (run.state.time < 3 * us) advance(run.state, run.stepping, 3 * us, run.engine);
    EXPECT_LT(run.imbalance(0, 500), 1e-13);
    EXPECT_LT(run.imbalance(1, 500), 1e-13);
    EXPECT_GT(run.received(1).energy, 0.1 * run.start[0][C::energy]);
  }
}

}  // namespace
}  // namespace recoil::spherical_test
