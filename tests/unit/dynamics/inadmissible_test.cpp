#include "dynamics/inadmissible.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../core/dimensions.hpp"
#include "../cutcell/bodies.hpp"

namespace recoil::inadmissible_test {
namespace {

template <class D>
struct Inadmissible : testing::Test {
  static constexpr int dim = D::value;
  Material material = samples::copper();
  Grid<dim> grid = make_test_grid<dim>(20, 10, Edge::outflow);
  const Contents<dim> one = per_volume<dim>(material, some_primitives<dim>(material));

  double whole() const { return grid.dx_power(dim); }
  /// A body that fills the domain, with one state in all cells.
  State<dim> uniform() const {
    auto state = make_test_state<dim>(grid, {[](const Vec<dim>&) { return -100.0; }}, material);
    cut_all(state);
    fill_body(state, 0, one);
    return state;
  }
  /// A ball whose cells hold contents that differ by up to the part `scatter`.
  State<dim> ball_of(double scatter) const {
    Vec<dim> middle = middle_of(grid);
    middle[0] += 0.07;
    auto state = make_test_state<dim>(grid, {ball(middle, 6.4 * grid.dx)}, material);
    cut_all(state);
    Random random(4);
    for_each_piece(state, 0, [&](BodyBlock<dim>& b, const Index<dim>& i, std::size_t k) {
      auto q = one;
      for (double& c : q) c *= random(1 - scatter, 1 + scatter);
      set_piece(b, k, volume_by_phi(grid, b, i, k), q);
    });
    return state;
  }
  static Index<dim> cell(int first, int others) {
    Index<dim> i;
    for (int d = 0; d < dim; ++d) i[d] = others;
    i[0] = first;
    return i;
  }
  /// Averages and puts the new contents in place; nothing may be gained or lost.
  void average(State<dim>& state, int width) const {
    const auto before = totals(state, 0);
    update_all(state, 0, [&](int s, Scratch& scratch) {
      average_inadmissible(state, state.bodies[0], s, width, scratch);
    });
    const auto after = totals(state, 0);
    for (std::size_t c = 0; c < after.size(); ++c) ASSERT_NEAR(after[c] / before[c], 1, 1e-13) << c;
  }
};
TYPED_TEST_SUITE(Inadmissible, Dimensions);

/// Gas that converges to a point becomes 64 times as dense as at rest (Noh, gamma 5/3).
TYPED_TEST(Inadmissible, ConvergingGasIsAdmissible) {
  constexpr int dim = TestFixture::dim;
  Material gas = samples::copper();
  gas.eos = IdealGas{.rho0 = 100, .gamma = 5.0 / 3, .p0 = 94};
  Primitives<dim> w{};
  w[Components<dim>::p] = 64.0 / 3 * 1e8;
  for (const double times : {64.0, 200.0}) {
    w[0] = times * 100;
    EXPECT_FALSE(inadmissible<dim>(gas, per_volume<dim>(gas, w), 1)) << times;
  }
}

TYPED_TEST(Inadmissible, StatesBeyondTheEquations) {
  constexpr int dim = TestFixture::dim;
  const double rho0 = density(this->material);
  const auto at = [&](double rho, double p) {
    Primitives<dim> w{};
    w[0] = rho;
    w[Components<dim>::p] = p;
    w[1] = 400;
    return inadmissible<dim>(this->material, per_volume<dim>(this->material, w), 1);
  };
  EXPECT_FALSE(at(rho0, 0));
  EXPECT_FALSE(at(1.3 * rho0, 50e9));
  EXPECT_TRUE(at(5e-4 * rho0, 0));
  EXPECT_FALSE(at(0.45 * rho0, 0));  // hot: a vapour
  EXPECT_TRUE(at(2.6 * rho0, 0));
  EXPECT_TRUE(at(0.9 * rho0, -70e9));  // no sound speed
  EXPECT_FALSE(at(0.9 * rho0, -10e9));
  std::get<MieGruneisen>(this->material.eos).s = 1.82;  // the Hugoniot ends at 1.98 rho0
  EXPECT_TRUE(at(2.0 * rho0, 100e9));
}

/// Expanded beyond the equation of state, cold or hot: what can fail has failed, what cannot is inadmissible.
TYPED_TEST(Inadmissible, MatterThatCanFailHasFailedWhereItsEquationsEndInExpansion) {
  constexpr int dim = TestFixture::dim;
  const double rho0 = density(this->material), full = this->whole();
  const auto at = [&](double rho, double p) {
    Primitives<dim> w{};
    w[0] = rho;
    w[Components<dim>::p] = p;
    return per_volume<dim>(this->material, w);
  };
  for (const bool fails : {true, false}) {
    auto state = this->uniform();
    auto& body = state.bodies[0];
    if (fails) body.material.damage = TensileDamage{};
    auto& b = body.at(0);
    set_piece(b, 1, full, at(0.45 * rho0, -100e9));
    set_piece(b, 3, full, at(5e-4 * rho0, 1e6));
    set_piece(b, 5, full, at(2.6 * rho0, 300e9));  // compressed: no failure
    auto broken = at(0.45 * rho0, 2e9);
    broken[Components<dim>::energy] = NAN;
    set_piece(b, 7, full, broken);
    Counters counters;
    EXPECT_EQ(mark_inadmissible(state, body, 0, counters), fails ? 2 : 4);
    EXPECT_EQ(counters.torn_states, fails ? 2 : 0);
    const double* damage = b.contents.data() + Components<dim>::damage * b.volume.size();
    for (const std::size_t k : {1U, 3U}) EXPECT_EQ(damage[k], fails ? b.contents[k] : 0) << k;
    EXPECT_EQ(damage[5], 0);
  }
}

TYPED_TEST(Inadmissible, StatesAreMarkedAndCleared) {
  auto state = this->uniform();
  auto& b = state.bodies[0].at(0);
  Counters counters;
  auto dense = this->one;
  dense[0] *= 3;
  const double full = this->whole();
  const auto has_inadmissible = [](const auto& block) {
    return std::any_of(block.role.begin(), block.role.end(),
                       [](std::uint8_t r) { return (r & has_bad_contents) != 0; });
  };
  EXPECT_EQ(mark_inadmissible(state, state.bodies[0], 0, counters), 0);
  EXPECT_FALSE(has_inadmissible(b));
  set_piece(b, 1, full, dense);
  set_piece(b, 4, 0.03 * full, dense);
  set_piece(b, 5, 0.01 * full, dense);  // too small to be judged
  EXPECT_EQ(mark_inadmissible(state, state.bodies[0], 0, counters), 2);
  EXPECT_TRUE(has_inadmissible(b));
  EXPECT_TRUE((b.role[4] & has_bad_contents) != 0 && (b.role[5] & has_bad_contents) == 0);
  clear_inadmissible(b);
  EXPECT_FALSE(has_inadmissible(b));
}

TYPED_TEST(Inadmissible, StatesAreAveragedWithTheirSurroundings) {
  constexpr int dim = TestFixture::dim;
  for (const int width : {1, 2, 3}) {
    auto state = this->ball_of(0.4);
    const auto a = TestFixture::cell(9, 9), b = TestFixture::cell(9 + width, 9);  // on both sides of a border
    for_each_piece(state, 0, [&](auto& block, const Index<dim>& i, std::size_t k) {
      if (i == a || i == b) block.role[k] |= has_bad_contents;
    });
    std::vector<double> before;
    for_each_piece(state, 0, [&](auto& block, const Index<dim>&, std::size_t k) {
      before.push_back(block.contents[k]);
    });
    this->average(state, width);
    double lowest = 1e300, highest = -1e300;
    std::size_t n = 0;
    for_each_piece(state, 0, [&](auto& block, const Index<dim>& i, std::size_t k) {
      const double old = before[n++];
      bool near_a = true, near_b = true;
      for (int d = 0; d < dim; ++d) {
        near_a = near_a && std::abs(i[d] - a[d]) <= width;
        near_b = near_b && std::abs(i[d] - b[d]) <= width;
      }
      if (!near_a && !near_b) {
        ASSERT_EQ(block.contents[k], old);
      }
      if (!near_a || near_b || block.volume[k] == 0) return;
      lowest = std::min(lowest, block.contents[k] / block.volume[k]);
      highest = std::max(highest, block.contents[k] / block.volume[k]);
    });
    EXPECT_NEAR(lowest / highest, 1, 1e-13);  // one state for all that only one window holds
  }
}

/// Nothing is averaged where no state is bad, and nothing is read in a block that has no cells to look at.
TYPED_TEST(Inadmissible, GoodStatesAndEmptyBlocksAreLeftAlone) {
  constexpr int dim = TestFixture::dim;
  auto state = this->ball_of(0);
  auto& body = state.bodies[0];
  Scratch scratch;
  for (int s = 0; s < state.mesh.local(); ++s) {
    average_inadmissible(state, body, s, 1, scratch);
    EXPECT_TRUE(body.at(s).updates.empty());
  }
  for_each_piece(state, 0,
                 [&](auto& block, const Index<dim>&, std::size_t k) { block.role[k] |= has_bad_contents; });
  for (int s = 0; s < state.mesh.local(); ++s) {
    body.at(s).reach = {};
    for (int width = 1; width <= 3; ++width) average_inadmissible(state, body, s, width, scratch);
    EXPECT_TRUE(body.at(s).updates.empty());
  }
}

}  // namespace
}  // namespace recoil::inadmissible_test
