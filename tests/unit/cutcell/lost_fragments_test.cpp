#include <algorithm>
#include <cmath>
#include <cstddef>

#include "../core/dimensions.hpp"
#include "../core/random.hpp"
#include "bodies.hpp"
#include "cutcell/lost_fragment.hpp"
#include "cutcell/moves.hpp"

namespace recoil::lost_fragments_test {
namespace {

TEST(BordersCrossed, KeepTheVelocityOnAverage) {
  Random random(7);
  const double dx = 2e-4;
  for (const double u : {5850.0, -313.0, 0.0}) {
    double time = 0;
    int borders = 0;
    for (int n = 0; n < 2000; ++n) {
      const double dt = random(0.2, 1) * 1e-8;
      borders += borders_crossed(u, time, dt, dx);
      time += dt;
    }
    EXPECT_NEAR(borders, u * time / dx, 1);
  }
}

/// Matter that can fail in single cells far from the body, which ends 2.2 cells from the low edge of axis 0.
template <class D>
struct LostFragments : testing::Test {
  static constexpr int dim = D::value;
  using C = Components<dim>;
  static constexpr double u = 1000;
  const Grid<dim> grid = make_test_grid<dim>(20, 10, Edge::outflow);
  const double dt = 0.3 * grid.dx / u;
  const double whole = grid.dx_power(dim);
  ExactEdgeAccount<dim> edges;
  State<dim> state = with_bodies();

  State<dim> with_bodies() const {
    Vec<dim> normal, point = grid.origin, beyond = grid.origin;
    normal[0] = 1;
    point[0] += 2.2 * grid.dx;
    beyond[0] -= 20 * grid.dx;  // the second body has no surface here
    auto s = make_test_state<dim>(grid, {half_space(point, normal), half_space(beyond, normal)});
    cut_all(s);
    s.bodies[0].material.damage = TensileDamage{1e9, 1, 1e-8};
    for_each_piece(s, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
      b.phi[k] = std::min(b.phi[k], grid.dx);  // as if restored: within reach
    });
    return s;
  }
  static bool is_at(const Index<dim>& i, int first) {
    for (int d = 1; d < dim; ++d)
      if (i[d] != 9) return false;
    return i[0] == first;
  }
  /// Puts so many cells of matter, which moves with u along axis 0, in the cell `first`.
  void put(int body, int first, double cells, double speed, double damage = 1) {
    auto q = per_volume<dim>(samples::copper(), some_primitives<dim>(samples::copper()));
    for (int d = 0; d < dim; ++d) q[C::u + static_cast<std::size_t>(d)] = d == 0 ? q[0] * speed : 0;
    q[C::damage] = damage * q[0];
    for_each_piece(state, body, [&](auto& b, const Index<dim>& i, std::size_t k) {
      if (is_at(i, first)) set_piece(b, k, cells * whole, q);
    });
  }
  double cells_at(int first) {
    double sum = 0;
    for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
      if (is_at(i, first)) sum = b.volume[k] / whole;
    });
    return sum;
  }
  void step(double length) {
    update_all(state, 0, [&](int s, Scratch& scratch) {
      empty_outside(state, state.bodies[0], s, length, edges, scratch);
    });
    state.time += length;
  }
  void steps_to(double end) {
    while (state.time < end) step(std::min(dt, end - state.time));
  }
  double time_of(double n) const { return (n + 0.5) * grid.dx / u; }
};
TYPED_TEST_SUITE(LostFragments, Dimensions);

/// Two cells of a failed fragment: the fuller one takes from the other what it has room for, and keeps what
/// it has. They do not change places.
TYPED_TEST(LostFragments, GatherInTheFullerCell) {
  this->put(0, 7, 0.8, 0);
  this->put(0, 8, 0.5, 0);
  this->step(0);
  EXPECT_GT(this->cells_at(7), 0.8);
  EXPECT_LE(this->cells_at(7), 1 + 1e-12);
  EXPECT_NEAR(this->cells_at(8), 1.3 - this->cells_at(7), 1e-12);
}

/// Through a border of blocks, at 10, and out of the domain, at 20.
TYPED_TEST(LostFragments, GoOnWithTheirVelocity) {
  this->put(0, 7, 0.8, this->u);
  const double mass = totals(this->state, 0)[0];
  for (const int n : {1, 5, 12}) {
    this->steps_to(this->time_of(n));
    ASSERT_NEAR(this->cells_at(7 + n), 0.8, 1e-12) << n;
    ASSERT_NEAR(totals(this->state, 0)[0], mass, 1e-13 * mass);
  }
  this->steps_to(this->time_of(13));
  EXPECT_EQ(totals(this->state, 0)[0], 0);
  EXPECT_NEAR(this->edges.value().mass, mass, 1e-13 * mass);
  EXPECT_NEAR(this->edges.value().momentum[0], mass * this->u, 1e-10 * mass * this->u);
}

/// Two cells side by side with a level set of their own leave each other no room to gather in.
TYPED_TEST(LostFragments, GoOnAsWellIfTheyHaveNotFailed) {
  this->put(0, 6, 1, this->u, 0.3);
  this->put(0, 7, 1, this->u, 0.3);
  for_each_piece(this->state, 0, [&](auto& b, const Index<TestFixture::dim>& i, std::size_t k) {
    if (this->is_at(i, 6) || this->is_at(i, 7)) b.phi[k] = -0.3 * this->grid.dx;
  });
  this->step(this->grid.dx / this->u);
  EXPECT_NEAR(this->cells_at(7), 1, 1e-12);
  EXPECT_NEAR(this->cells_at(8), 1, 1e-12);
}

TYPED_TEST(LostFragments, OneBehindTheOtherKeepTheirDistance) {
  this->put(0, 6, 0.8, this->u);
  this->put(0, 7, 0.8, this->u);
  this->steps_to(this->time_of(6));
  EXPECT_NEAR(this->cells_at(12), 0.8, 1e-12);
  EXPECT_NEAR(this->cells_at(13), 0.8, 1e-12);
}

TYPED_TEST(LostFragments, WaitWhereAnotherBodyLeavesNoRoom) {
  this->put(0, 7, 0.8, this->u);
  this->put(1, 10, 0.5, 0);
  this->steps_to(this->time_of(6));
  EXPECT_NEAR(this->cells_at(9), 0.8, 1e-12);
}

TYPED_TEST(LostFragments, SpreadWhereACellHoldsMoreThanOne) {
  this->put(0, 8, 1.6, 0);
  this->step(this->dt);
  EXPECT_NEAR(this->cells_at(8), 1, 1e-12);
  EXPECT_NEAR(totals(this->state, 0)[0] / (1.6 * this->whole),
              per_volume<TestFixture::dim>(samples::copper(),
                                           some_primitives<TestFixture::dim>(samples::copper()))[0],
              1e-6);
}

}  // namespace
}  // namespace recoil::lost_fragments_test
