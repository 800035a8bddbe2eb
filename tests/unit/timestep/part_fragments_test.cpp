#include "timestep/part_fragments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "run.hpp"

namespace recoil::part_fragments_test {
namespace {

using config::Geometry;

constexpr double mm = 1e-3, speed = 100;

/// A body of two pieces that meet at the origin, and one that takes up its fragments.
std::vector<config::Body> two_pieces(const config::Shape& low, const config::Shape& high) {
  config::Body pair = body_of("pair", {config::Union{{low, high}}});
  pair.radial_velocity = -speed;
  config::Body other;
  other.name = "other";
  other.shape.form = config::Union{};
  other.fragments_of = "pair";
  return {pair, other};
}

/// The same pieces as bodies of their own.
std::vector<config::Body> two_bodies(const config::Shape& low, const config::Shape& high) {
  std::vector<config::Body> bodies{body_of("low", low), body_of("high", high)};
  for (config::Body& body : bodies) body.radial_velocity = -speed;
  return bodies;
}

template <int Dim>
void advance_parting(TestRun<Dim>& run, double until) {
  while (run.state.time < until * (1 - 1e-12)) {
    part_fragments(run.state, run.engine);
    advance(run.state, run.stepping, until, run.engine);
  }
}

/// Where each piece is after two that were one body have met and parted, as where they were two bodies.
template <int Dim>
void expect_as_two_bodies(const config::Case& one, const config::Case& two, double until, double equal) {
  TestRun<Dim> pieces(one, {samples::copper(), samples::copper()}),
      bodies(two, {samples::copper(), samples::copper()});
  advance_parting(pieces, until);
  advance_parting(bodies, until);
  // The heavier one has stayed; of equal ones the first.
  const std::size_t up = TestRun<Dim>::C::u + Dim - 1;
  const double mass = bodies.totals(0)[0], start = bodies.start[0][up];
  EXPECT_GT(std::abs(bodies.totals(0)[up] - start), 0.5 * std::abs(start)) << "they have met";
  const bool low_stayed = pieces.totals(0)[up] * bodies.totals(0)[up] > 0;
  for (const int m : {0, 1}) {
    const auto was = bodies.totals(low_stayed ? m : 1 - m), now = pieces.totals(m);
    EXPECT_NEAR(now[up], was[up], equal * mass * speed) << m;
    EXPECT_NEAR(now[TestRun<Dim>::C::energy], was[TestRun<Dim>::C::energy], equal * mass * speed * speed)
        << m;
  }
  for (std::size_t c : {std::size_t{0}, up}) {
    const double then = pieces.start[0][c] + pieces.start[1][c],
                 now = pieces.totals(0)[c] + pieces.totals(1)[c];
    EXPECT_NEAR(now, then, 1e-13 * pieces.start[0][0] * (c == 0 ? 1 : speed));
  }
}

TEST(PartFragments, PiecesOfOneBodyMeetAsTwoBodiesIn1d) {
  const auto domain = domain_of(Geometry::line, {-4 * mm}, {4 * mm});
  const auto low = box_shape({-2.2 * mm}, {-0.2 * mm}), high = box_shape({0.2 * mm}, {2.2 * mm});
  expect_as_two_bodies<1>(case_of(domain, 0.05 * mm, two_pieces(low, high)),
                          case_of(domain, 0.05 * mm, two_bodies(low, high)), 3.2e-6, 1e-6);
}

TEST(PartFragments, PiecesOfOneBodyMeetAsTwoBodiesInThePlane) {
  const auto domain = domain_of(Geometry::planar, {-2 * mm, -3 * mm}, {2 * mm, 3 * mm});
  const auto low = ball_shape({-0.2 * mm, -1.2 * mm}, 1 * mm),
             high = ball_shape({0.2 * mm, 1.2 * mm}, 1 * mm);
  expect_as_two_bodies<2>(case_of(domain, 0.1 * mm, two_pieces(low, high)),
                          case_of(domain, 0.1 * mm, two_bodies(low, high)), 5e-6, 5e-3);
}

/// Level sets are those of each piece alone, contents go unchanged, and what has gone is booked on both
/// sides.
TEST(PartFragments, LevelSetsAndBalances) {
  const auto domain = domain_of(Geometry::planar, {-2 * mm, -3 * mm}, {2 * mm, 3 * mm});
  const Vec<2> low{{-0.2 * mm, -1.2 * mm}}, high{{0.2 * mm, 1.2 * mm}};
  const double radius = 1 * mm, dx = 0.1 * mm;
  TestRun<2> run(
      case_of(domain, dx,
              two_pieces(ball_shape({low[0], low[1]}, radius), ball_shape({high[0], high[1]}, radius))),
      {samples::copper(), samples::copper()});
  const auto whole = run.totals(0);
  const auto moved = part_fragments(run.state, run.engine);
  ASSERT_EQ(moved.size(), 1U);
  EXPECT_EQ(moved[0].from, 0);
  EXPECT_EQ(moved[0].to, 1);
  const bool high_went = moved[0].position[1] > 0;
  EXPECT_NEAR(moved[0].mass, run.totals(1)[0], 1e-12 * moved[0].mass);
  for (std::size_t c = 0; c < whole.size(); ++c)
    EXPECT_NEAR(run.totals(0)[c] + run.totals(1)[c], whole[c], 1e-12 * std::abs(whole[c]) + 1e-12);
  for (const int m : {0, 1})
    EXPECT_NEAR(run.received(m).mass, (m == 0 ? -1 : 1) * moved[0].mass, 1e-12 * moved[0].mass);
  for (const int m : {0, 1}) {
    const Vec<2> centre = (m == 1) == high_went ? high : low;
    int compared = 0;
    for (int slot = 0; slot < run.state.mesh.local(); ++slot) {
      const auto& b = run.state.bodies[m].at(slot);
      if (!b.present) continue;
      const Box<2> cells = run.state.mesh.block(slot).cells;
      for_each(cells, [&](const Index<2>& i) {
        const auto k = static_cast<std::size_t>(run.state.grid().layout().at(i - cells.lo));
        const double exact = norm(run.state.grid().centre(i) - centre) - radius;
        if (std::abs(exact) > 4.5 * dx) return;
        ++compared;
        EXPECT_NEAR(b.phi[k], exact, 0.2 * dx) << m << " " << exact / dx;
        if (exact > 1.5 * dx) {
          EXPECT_EQ(b.volume[k], 0);
        }
      });
    }
    EXPECT_GT(compared, 400);
  }
}

/// Pieces that are far from each other share a body, and so do more pieces than there are bodies for.
TEST(PartFragments, StayTogetherWhereTheyAreFarOrTooMany) {
  const auto domain = domain_of(Geometry::line, {-8 * mm}, {8 * mm});
  TestRun<1> far(
      case_of(domain, 0.1 * mm, two_pieces(box_shape({-4 * mm}, {-2 * mm}), box_shape({2 * mm}, {4 * mm}))),
      {samples::copper(), samples::copper()});
  EXPECT_TRUE(part_fragments(far.state, far.engine).empty());
  EXPECT_EQ(far.counted().fragments_without_body, 0);

  const config::Shape three{
      config::Union{{box_shape({-4 * mm}, {-1.5 * mm}), box_shape({-1.2 * mm}, {0.8 * mm}),
                     box_shape({1.1 * mm}, {3 * mm})}}};
  auto bodies = two_pieces(three, three);
  bodies[0].shape = three;
  TestRun<1> crowd(case_of(domain, 0.1 * mm, bodies), {samples::copper(), samples::copper()});
  // The ones at the ends are 23 cells apart and share a body; the middle one goes.
  const auto moved = part_fragments(crowd.state, crowd.engine);
  ASSERT_EQ(moved.size(), 1U);
  EXPECT_NEAR(moved[0].position[0], -0.2 * mm, 1e-3 * mm);
  EXPECT_EQ(crowd.counted().fragments_without_body, 0);

  bodies[1] = body_of("lone", box_shape({-7 * mm}, {-5 * mm}));  // nobody takes up fragments
  TestRun<1> none(case_of(domain, 0.1 * mm, bodies), {samples::copper(), samples::copper()});
  EXPECT_TRUE(part_fragments(none.state, none.engine).empty());
}

/// A fragment goes to an empty body before it drives another one out of a body, and not to one that is just
/// being left: cells that both cut would go along.
TEST(PartFragments, OneMoveAtATime) {
  const auto domain = domain_of(Geometry::line, {-8 * mm}, {8 * mm});
  auto bodies = two_pieces(box_shape({-6 * mm}, {-3 * mm}), box_shape({-2.7 * mm}, {-0.2 * mm}));
  const config::Shape four{
      config::Union{{box_shape({-6 * mm}, {-3 * mm}), box_shape({-2.7 * mm}, {-0.2 * mm}),
                     box_shape({0.1 * mm}, {2.1 * mm}), box_shape({2.4 * mm}, {3.9 * mm})}}};
  bodies[0].shape = four;
  bodies.push_back(bodies[1]);
  bodies[2].name = "another";
  TestRun<1> run(case_of(domain, 0.1 * mm, bodies),
                 {samples::copper(), samples::copper(), samples::copper()});
  const double mass = run.totals(0)[0];
  const auto moved = part_fragments(run.state, run.engine);
  // From the heaviest on: it stays, the second goes, the third and the fourth alternate.
  ASSERT_EQ(moved.size(), 2U);
  for (const auto& f : moved) EXPECT_EQ(f.from, 0);
  EXPECT_NE(moved[0].to, 0);
  double sum = 0;
  for (const int m : {0, 1, 2}) {
    sum += run.totals(m)[0];
    const double pieces = run.totals(m)[0] / mass * 9;  // mm
    EXPECT_NEAR(pieces, std::round(pieces * 2) / 2, 1e-9) << "whole pieces";
  }
  EXPECT_NEAR(sum, mass, 1e-12 * mass);
  EXPECT_TRUE(part_fragments(run.state, run.engine).empty()) << "all are apart";
}

}  // namespace
}  // namespace recoil::part_fragments_test
