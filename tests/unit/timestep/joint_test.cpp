#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

#include "run.hpp"

/// Waves through the joint of two glued bodies with free sides.
namespace recoil::joint_test {
namespace {

using config::Geometry;

constexpr double mm = 1e-3, us = 1e-6;

Material beryllium() {
  Material m;
  m.name = "beryllium";
  m.eos = LinearEos{1845, 119e9};
  m.strength = Elastic{151e9};
  m.thermal.specific_heat = 1825;
  return m;
}

double kinetic(const TestRun<2>& run) {
  using C = Components<2>;
  double sum = 0;
  for (int m = 0; m < run.state.count(); ++m)
    for (int s = 0; s < run.state.mesh.local(); ++s) {
      const BodyBlock<2>& b = run.state.bodies[m].at(s);
      const std::size_t n = b.volume.size();
      for (std::size_t k = 0; k < n; ++k) {
        if (!(b.contents[k] > 0)) continue;
        const Vec<2> p{{b.contents[C::u * n + k], b.contents[(C::u + 1) * n + k]}};
        sum += 0.5 * dot(p, p) / b.contents[k];
      }
    }
  return sum;
}

/// A bar of 20 mm x 5 mm that swings along its length, of two parts. In one piece it keeps 0.998 of its
/// energy over two periods. The joint is a fifth of a cell beyond a line of the mesh. Where the two corners
/// at its ends share a cell, the contact's direction was between their surfaces, whose free sides turned it:
/// 0.81 was left (docs/decisions/0079).
TEST(Joint, WavesCrossItAtFreeSides) {
  config::Body left = body_of("left", box_shape({-10 * mm, -2.5 * mm, 0}, {2.1 * mm, 2.5 * mm, 0}));
  config::Body right = body_of("right", box_shape({2.1 * mm, -2.5 * mm, 0}, {10 * mm, 2.5 * mm, 0}));
  left.velocity_field.x = right.velocity_field.x = "20*m/s * sin(pi*x/(20*mm))";
  config::Case c = case_of(domain_of(Geometry::planar, {-12 * mm, -4 * mm, 0}, {12 * mm, 4 * mm, 0}),
                           0.5 * mm, {left, right});
  c.contact.usual.mode = config::ContactChoice::Mode::bonded;
  TestRun<2> run(c, {beryllium(), beryllium()});
  const double start = kinetic(run);
  double last = 0;  // the largest about the end of the second period
  while (run.state.time < 6.4 * us) {
    run.steps(1);
    if (run.state.time > 5.8 * us) last = std::max(last, kinetic(run));
  }
  EXPECT_GT(last / start, 0.9);
  EXPECT_LT(last / start, 1);
  EXPECT_LT(run.imbalance(0, 20), 1e-11);
}

}  // namespace
}  // namespace recoil::joint_test
