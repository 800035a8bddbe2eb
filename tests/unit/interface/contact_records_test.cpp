#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "walls_fixture.hpp"

namespace recoil::contact_records_test {
namespace {

/// What the walls leave for others to read: the ledger of pairs, the list of contacts, the bits of partners.
template <class D>
struct ContactRecords : Walls<D> {};
TYPED_TEST_SUITE(ContactRecords, Dimensions);

/// The ledger books what the bodies give each other, from the lower-numbered one's side.
TYPED_TEST(ContactRecords, TheLedgerAgreesWithTheWalls) {
  constexpr int dim = TestFixture::dim;
  const double weight = 1.0 / 6;
  auto p =
      this->facing(-0.1, moving<dim>(this->material, 60.0 * this->normal), moving<dim>(this->material, {}));
  find_all(p, this->dt, weight);
  find_all(p, this->dt, weight);
  Vec<dim> force;
  double power = 0, area = 0;
  p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>& cut, const Index<dim>&) {
    force += w.force;
    power += w.power;
    if (w.partners != 0) area += norm(cut.surface);
  });
  PairRecord<dim> sum;
  for (const auto& l : p.state.ledger) {
    const auto& r = l.pairs[0];
    sum.area += r.area;
    sum.force += r.force;
    sum.exchanged += r.exchanged;
    sum.gap += r.gap;
    sum.traction += r.traction;
    sum.velocity += r.velocity;
  }
  const Account<dim> exchanged = sum.exchanged.value();
  const double total_area = sum.area.value();
  EXPECT_NEAR(total_area / area, 1, 1e-6);
  EXPECT_LT(norm(sum.force.value() - force), 1e-12 * norm(force));
  EXPECT_LT(norm(exchanged.momentum - 2 * weight * this->dt * force), 1e-12 * norm(exchanged.momentum));
  EXPECT_NEAR(exchanged.energy / (2 * weight * this->dt * power), 1, 1e-12);
  EXPECT_NEAR(sum.traction.value() / total_area / (-30 * this->z), 1, 0.02);
  EXPECT_NEAR(sum.velocity.value() / total_area, 30, 0.5);
  EXPECT_NEAR(sum.gap.value() / total_area / this->grid.dx, -0.1, 0.02);
}

TYPED_TEST(ContactRecords, ContactIsRemembered) {
  constexpr int dim = TestFixture::dim;
  auto p = this->facing(0, moving<dim>(this->material, 60.0 * this->normal), moving<dim>(this->material, {}));
  find_all(p, this->dt);
  auto& b = p.state.bodies[1].at(0);
  remember_contact(b);
  for (std::size_t k = 0; k < b.contact.size(); ++k) {
    const int at = b.geometry.index[k];
    EXPECT_EQ(b.contact[k], at < 0 ? 0U : b.walls[at].partners);
  }
}

/// The list names every contact once, with what its walls bear.
TYPED_TEST(ContactRecords, TheListAgreesWithTheWalls) {
  constexpr int dim = TestFixture::dim;
  Vec<dim> along;
  if constexpr (dim > 1) {
    along[0] = -this->normal[1];
    along[1] = this->normal[0];
  }
  auto p = this->facing(-0.1, moving<dim>(this->material, 60.0 * this->normal + 300.0 * along),
                        moving<dim>(this->material, {}));
  p.state.contact[0] = {ContactLaw::Mode::friction, 0.3};
  find_all(p, this->dt);
  find_all(p, this->dt);
  int listed = 0, walls = 0;
  for (int s = 0; s < p.state.mesh.local(); ++s)
    for (const Contact<dim>& c : p.state.contacts[s]) {
      ++listed;
      const auto& b = p.state.bodies[c.first].at(s);
      const Wall<dim>& w = b.walls[b.geometry.index[c.cell]];
      ASSERT_EQ(c.first, 0);
      ASSERT_EQ(c.second, 1);
      ASSERT_FALSE(c.one_sided);
      ASSERT_EQ(c.traction, w.traction);
      ASSERT_EQ(c.shear, w.shear);
      ASSERT_EQ(c.direction, w.normal);
      ASSERT_LT(norm(c.area * (c.traction * c.direction + c.shear) - w.force), 1e-12 * norm(w.force));
      ASSERT_NEAR(c.slip == Vec<dim>{} ? 0 : dot(c.slip, unit(along)), dim == 1 ? 0 : norm(c.slip),
                  1e-3 * norm(c.slip));
      ASSERT_NEAR(c.gap, -0.1 * this->grid.dx, 0.06 * this->grid.dx);
    }
  p.for_each_wall(
      0, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>&) { walls += w.partners != 0; });
  EXPECT_GT(listed, 0);
  EXPECT_EQ(listed, walls);
}

/// However many bodies share a cell, no pair is left out: of seven only the last two meet.
TEST(WallsOfMany, NoPairIsLeftOut) {
  const auto grid = make_test_grid<2>(20, 10, Edge::outflow, true);
  const auto material = samples::copper();
  const Vec<2> middle = middle_of(grid) + Vec<2>{{0.07, 0.11}};
  std::vector<Distance<2>> shapes(6, half_space(middle, Vec<2>{{0, 1}}));
  shapes.push_back(half_space(middle, Vec<2>{{0, -1}}));
  std::vector<Primitives<2>> states(5, moving<2>(material, {{0, -500}}));  // these recede
  states.push_back(moving<2>(material, {{0, 80}}));
  states.push_back(moving<2>(material, {}));
  Prepared<2> p(grid, shapes, states);
  find_all(p, 1e-5);
  for (int a = 0; a < 7; ++a)
    for (int b = a + 1; b < 7; ++b) {
      double area = 0;
      for (const auto& l : p.state.ledger) area += l.pairs[pair_number(a, b, 7)].area.value();
      if (a == 5)
        EXPECT_GT(area, 15 * grid.dx);
      else
        EXPECT_EQ(area, 0) << a << ' ' << b;
    }
}

/// Two bodies side by side on a third: the pairs share the cell's area, and all forces balance.
TEST(WallsOfThree, ForcesOfAllPairsBalance) {
  const auto grid = make_test_grid<2>(20, 10, Edge::outflow, true);
  const auto material = samples::copper();
  const Vec<2> middle = middle_of(grid) + Vec<2>{{0.07, 0.11}};
  const Distance<2> below = half_space(middle, Vec<2>{{0, 1}}), above = half_space(middle, Vec<2>{{0, -1}}),
                    left = half_space(middle, Vec<2>{{1, 0}}), right = half_space(middle, Vec<2>{{-1, 0}});
  Prepared<2> p(
      grid,
      {below, [&](const Vec<2>& x) { return std::max(above(x), left(x)); },
       [&](const Vec<2>& x) { return std::max(above(x), right(x)); }},
      {moving<2>(material, {{0, 80}}), moving<2>(material, {{30, 0}}), moving<2>(material, {{-20, 0}})});
  find_all(p, 1e-5);
  Vec<2> force;
  double power = 0, size = 0;
  for (int m = 0; m < 3; ++m)
    p.for_each_wall(m, [&](const Wall<2>& w, const CutCell<2>&, const Index<2>&) {
      force += w.force;
      power += w.power;
      size += norm(w.force);
    });
  EXPECT_GT(size, 0);
  EXPECT_LT(norm(force), 1e-12 * size);
  EXPECT_LT(std::abs(power), 1e-10 * size);
  for (int pair = 0; pair < 3; ++pair) {
    double area = 0;
    for (const auto& l : p.state.ledger) area += l.pairs[pair].area.value();
    EXPECT_GT(area, 5 * grid.dx) << pair;
  }
}

}  // namespace
}  // namespace recoil::contact_records_test
