#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "run.hpp"

namespace recoil::moving_strain_test {
namespace {

using config::Geometry;

constexpr double mm = 1e-3;
constexpr double dx = 0.2 * mm, width = 5 * dx, peak = 2;

/// f(block of the body, place among its arrays, centre of the cell).
template <int Dim, class F>
void each_cell(TestRun<Dim>& run, F&& f) {
  for (int s = 0; s < run.state.mesh.local(); ++s) {
    auto& b = run.state.bodies[0].at(s);
    if (!b.present) continue;
    const Box<Dim> own = run.state.mesh.block(s).cells;
    for_each(own, [&](const Index<Dim>& i) {
      f(b, static_cast<std::size_t>(run.state.grid().layout().at(i - own.lo)), run.state.grid().centre(i));
    });
  }
}

/// Sum of m ep^2 over sum of m ep: falls where differences of the strain ep are lost.
template <int Dim>
double contrast(TestRun<Dim>& run) {
  using C = Components<Dim>;
  double squares = 0, sum = 0;
  each_cell(run, [&](auto& b, std::size_t k, const Vec<Dim>&) {
    const double strain = b.contents[C::ep * b.volume.size() + k];
    sum += strain;
    if (b.contents[k] > 0) squares += strain * strain / b.contents[k];
  });
  return squares / sum;
}

/// A body whose plastic strain falls from its front inwards by 1/e in 5 cells flies 2 cells, in which the
/// profile of means settles, and then 10 more.
/// @returns the part of the contrast that the 10 cells take.
template <int Dim>
double lost_in_flight(const config::Domain& domain, const config::Body& body, const Vec<Dim>& towards,
                      double front) {
  using C = Components<Dim>;
  constexpr double speed = 200;
  TestRun<Dim> run(case_of(domain, dx, {body}), {samples::copper()});
  each_cell(run, [&](auto& b, std::size_t k, const Vec<Dim>& x) {
    const double depth = std::max(front - dot(towards, x), 0.0);
    b.contents[C::ep * b.volume.size() + k] = b.contents[k] * peak * std::exp(-depth / width);
  });
  const auto fly = [&](double cells) {
    const double until = run.state.time + cells * dx / speed;
    while (run.state.time < until) advance(run.state, run.stepping, until, run.engine);
  };
  fly(2);
  const double before = contrast(run);
  fly(10);
  each_cell(run, [&](auto& b, std::size_t k, const Vec<Dim>&) {
    const double strain = b.contents[C::ep * b.volume.size() + k];
    EXPECT_GE(strain * b.contents[k], 0);
    EXPECT_LE(strain, peak * std::max(b.contents[k], 0.0));
  });
  return 1 - contrast(run) / before;
}

/// A box of 6 mm x 4 mm, turned by an angle [rad], whose front flies along `course` [rad].
double lost_by_box(double angle, double course) {
  config::Box box{.lo = {2 * mm, -2.03 * mm}, .hi = {8 * mm, 2.03 * mm}, .rotation = angle};
  box.centre = {5 * mm, 0};
  const Vec<2> front{std::cos(angle), std::sin(angle)};
  const auto body = body_of("bar", {box}, {200 * std::cos(course), 200 * std::sin(course)});
  const auto domain = domain_of(Geometry::planar, {0, -6 * mm}, {14 * mm, 8 * mm});
  return lost_in_flight<2>(domain, body, front, 5 * mm * front[0] + 3 * mm);
}

TEST(MovingStrain, KeepsItsProfileIn1d) {
  const auto body = body_of("bar", box_shape({2 * mm}, {8 * mm}), {200});
  const double lost = lost_in_flight<1>(domain_of(Geometry::line, {0}, {14 * mm}), body, {1}, 8 * mm);
  EXPECT_LT(lost, 0.01);
  EXPECT_GT(lost, -1e-3);
}

TEST(MovingStrain, KeepsItsProfileAtAnyAngle) {
  for (const auto& [angle, course] : {std::pair{0.0, 0.0}, {0.0, 0.45}, {0.4637, 0.4637}, {0.4637, 1.2}}) {
    const double lost = lost_by_box(angle, course);
    EXPECT_LT(lost, 0.01) << angle << " " << course;
    EXPECT_GT(lost, -1e-3) << angle << " " << course;
  }
}

}  // namespace
}  // namespace recoil::moving_strain_test
