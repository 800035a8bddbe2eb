#include "state/contact_sums.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "../cutcell/bodies.hpp"

namespace recoil::contact_sums_test {
namespace {

/// Three bodies, the last one rigid, and no contact yet.
State<2> three_bodies() {
  const auto grid = make_test_grid<2>(10, 10, Edge::outflow, true);
  auto state =
      make_test_state<2>(grid, std::vector<Distance<2>>(3, half_space(middle_of(grid), Vec<2>{{1, 0}})));
  state.bodies[2].rigid.emplace();
  return state;
}

Contact<2> between(int first, int second) {
  Contact<2> c;
  c.first = first;
  c.second = second;
  c.direction = {{1, 0}};
  return c;
}

TEST(ContactSums, AreThoseOfTheList) {
  State<2> state = three_bodies();
  Contact<2> a = between(0, 1);
  a.point = {{2, 3}};
  a.area = 0.5;
  a.traction = -8;
  a.shear = {{0, 2}};
  a.work_velocity = 10;
  a.shear_velocity = {{0, -4}};
  a.gap = 0.025;
  state.contacts[0] = {a, a};
  book_contacts(state, 0, 0.1);
  const PairRecord<2>& r = state.ledger[0].pairs[pair_number(0, 1, 3)];
  // Twice 0.5 (-8, 2) N at (2, 3) m, and 0.5 (-80 - 8) W.
  EXPECT_EQ(r.force.value(), (Vec<2>{{-8, 2}}));
  EXPECT_NEAR(r.exchanged.momentum[0].value(), -0.8, 1e-15);
  EXPECT_NEAR(r.exchanged.momentum[1].value(), 0.2, 1e-15);
  EXPECT_NEAR(r.exchanged.energy.value(), -8.8, 1e-14);
  EXPECT_NEAR(r.moment[2].value(), 0.1 * (2 * 2 + 3 * 8), 1e-15);
  EXPECT_EQ(r.area.value(), 1);
  EXPECT_EQ(r.traction.value(), -8);
  EXPECT_EQ(r.velocity.value(), 10);
  EXPECT_EQ(r.gap.value(), 0.025);
  EXPECT_NEAR(r.widest_gap, 0.1, 1e-15);
  EXPECT_EQ(r.deepest_overlap, 0);
  EXPECT_EQ(r.place.value(), (Vec<2>{{2, 3}}));
}

/// A stage begins anew; what was exchanged stays.
TEST(ContactSums, WhatWasExchangedAddsUp) {
  State<2> state = three_bodies();
  Contact<2> c = between(1, 2);
  c.direction = {{0, 1}};
  c.point = {{1, 0}};
  c.area = 2;
  c.traction = -3;
  state.contacts[0] = {c};
  book_contacts(state, 0, 0.5);
  book_contacts(state, 0, 0.25);
  state.contacts[0].clear();
  book_contacts(state, 0, 1);
  const PairRecord<2>& r = state.ledger[0].pairs[pair_number(1, 2, 3)];
  EXPECT_EQ(r.exchanged.momentum.value(), (Vec<2>{{0, -4.5}}));
  EXPECT_EQ(r.moment.value(), (Vec<3>{{0, 0, -4.5}}));
  EXPECT_EQ(r.area.value(), 0);
  EXPECT_EQ(r.force.value(), (Vec<2>{}));
}

/// A rigid body that has moved across the edge of a period is pushed where it is, not where its image is.
TEST(ContactSums, MomentsOnAnImageActOnTheBody) {
  State<2> state = three_bodies();
  RigidMotion<2>& rigid = *state.bodies[2].rigid;
  rigid.period = {{0, 10}};
  rigid.centre = {{0, -6}};
  Contact<2> c = between(1, 2);
  c.point = {{1, 3}};
  c.area = 1;
  c.traction = -2;
  state.contacts[0] = {c};
  book_contacts(state, 0, 1);
  const PairRecord<2>& r = state.ledger[0].pairs[pair_number(1, 2, 3)];
  EXPECT_DOUBLE_EQ(r.moment[2].value(), -(3 - 10) * -2) << "the force of -2 N along x acts at y = -7";
}

/// Of one-sided contacts the lower-numbered body's counts, and the deformable one's beside a rigid body; the
/// force is always that on the lower-numbered one.
TEST(ContactSums, OneSidedContactsCountOnce) {
  State<2> state = three_bodies();
  Contact<2> c = between(1, 0);
  c.one_sided = true;
  c.area = 1;
  c.traction = -1;
  EXPECT_FALSE(counts(state, c));
  std::swap(c.first, c.second);
  EXPECT_TRUE(counts(state, c));
  EXPECT_EQ(force_on_lower(c), (Vec<2>{{-1, 0}}));
  std::swap(state.bodies[0], state.bodies[2]);  // now the first one is rigid
  std::swap(c.first, c.second);
  EXPECT_TRUE(counts(state, c));
  EXPECT_EQ(force_on_lower(c), (Vec<2>{{1, 0}}));
  c.area = 0;
  EXPECT_FALSE(counts(state, c));
}

}  // namespace
}  // namespace recoil::contact_sums_test
