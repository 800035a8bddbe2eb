#include "cutcell/redistribution.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "../core/dimensions.hpp"
#include "bodies.hpp"

namespace recoil::redistribution_test {
namespace {

template <class D>
struct Redistributing : testing::Test {
  static constexpr int dim = D::value;
  using C = Components<dim>;
  Grid<dim> grid = make_test_grid<dim>(20, 10, Edge::outflow);
  Counters counters;

  /// A ball whose fragments hold random multiples of one state.
  State<dim> random_ball(const Grid<dim>& g, double scatter) const {
    Vec<dim> middle = middle_of(g);
    middle[0] += 0.07;
    auto state = make_test_state<dim>(g, {ball(middle, 6.4 * g.dx)});
    cut_all(state);
    const auto one =
        per_volume<dim>(state.bodies[0].material, some_primitives<dim>(state.bodies[0].material));
    for_each_piece(state, 0, [&](BodyBlock<dim>& b, const Index<dim>& i, std::size_t k) {
      Random random(static_cast<std::uint64_t>(g.domain().at(i)));
      auto q = one;
      for (double& c : q) c *= random(1 - scatter, 1 + scatter);
      set_piece(b, k, volume_by_phi(g, b, i, k), q);
    });
    return state;
  }
  void run(State<dim>& state) {
    update_all(state, 0,
               [&](int s, Scratch& scratch) { redistribute(state, state.bodies[0], s, counters, scratch); });
  }
};
TYPED_TEST_SUITE(Redistributing, Dimensions);

TYPED_TEST(Redistributing, ConservesContentsAndLeavesVolumes) {
  constexpr int dim = TestFixture::dim;
  auto state = this->random_ball(this->grid, 0.4);
  const auto before = totals(state, 0);
  std::vector<double> volumes, contents;
  for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
    volumes.push_back(b.volume[k]);
    contents.push_back(b.contents[k]);
  });
  this->run(state);
  const auto after = totals(state, 0);
  for (std::size_t c = 0; c < after.size(); ++c) EXPECT_NEAR(after[c] / before[c], 1, 1e-13) << c;
  std::size_t n = 0;
  int changed = 0;
  for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
    ASSERT_EQ(b.volume[k], volumes[n]);
    changed += b.contents[k] != contents[n++];
  });
  EXPECT_GT(changed, dim == 1 ? 1 : 20);
  EXPECT_EQ(this->counters.lone_fragments_moved, 0);
}

TYPED_TEST(Redistributing, AUniformStateStaysUniform) {
  constexpr int dim = TestFixture::dim;
  auto state = this->random_ball(this->grid, 0);
  const auto one = per_volume<dim>(state.bodies[0].material, some_primitives<dim>(state.bodies[0].material));
  this->run(state);
  for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
    for (std::size_t c = 0; c < one.size(); ++c) {
      const double exact = b.volume[k] * one[c];
      ASSERT_NEAR(b.contents[c * b.volume.size() + k], exact, 2e-14 * std::abs(exact));
    }
  });
}

TYPED_TEST(Redistributing, WholePiecesFarFromSmallOnesAreLeftAlone) {
  auto state = this->random_ball(this->grid, 0.4);
  Scratch scratch;
  for (int s = 0; s < state.mesh.local(); ++s) {
    redistribute(state, state.bodies[0], s, this->counters, scratch);
    const auto& b = state.bodies[0].at(s);
    for (const auto& u : b.updates) {
      const auto k = static_cast<std::size_t>(u.cell);
      EXPECT_LT(std::abs(b.phi[k]), 3.5 * this->grid.dx);
      EXPECT_GT(b.volume[k], 0);
    }
  }
}

/// The state of a tiny fragment must not survive: its step would be unstable.
TYPED_TEST(Redistributing, ATinyPieceTakesTheStateOfItsNeighbourhood) {
  constexpr int dim = TestFixture::dim;
  auto state = this->random_ball(this->grid, 0);
  const auto one = per_volume<dim>(state.bodies[0].material, some_primitives<dim>(state.bodies[0].material));
  auto wild = one;
  for (double& c : wild) c *= -50;
  const double dx = this->grid.dx;
  int tiny = 0;
  for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    if (b.end_geometry.kind[k] != CellKind::cut || b.volume[k] >= 0.5 * this->grid.full_volume(i)) return;
    ++tiny;
    set_piece(b, k, 1e-6 * this->grid.dx_power(dim) * (tiny % 3 == 0 ? -1 : 1), wild);
  });
  EXPECT_GT(tiny, 0);
  this->run(state);
  for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
    if (b.volume[k] == 0 || b.phi[k] < -3.5 * dx) return;
    EXPECT_NEAR(b.contents[k] / b.volume[k] / one[0], 1, 5e-3);
  });
}

/// The foot of a shock is convex: a slope drawn on outwards would leave less at the surface than there is
/// ahead of it.
TYPED_TEST(Redistributing, AStrongShockBehindTakesNothingOffTheSurface) {
  constexpr int dim = TestFixture::dim;
  auto state = this->random_ball(this->grid, 0);
  const auto one = per_volume<dim>(state.bodies[0].material, some_primitives<dim>(state.bodies[0].material));
  const double dx = this->grid.dx;
  for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
    const double depth = -b.phi[k] / dx;
    auto q = one;
    for (double& c : q) c *= depth < 1.5 ? 1 : depth < 2.5 ? 1.02 : depth < 3.5 ? 1.2 : 1.3;
    set_piece(b, k, b.volume[k], q);
  });
  this->run(state);
  for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
    if (b.volume[k] == 0) return;
    EXPECT_GE(b.contents[k] / b.volume[k] / one[0], 1 - 1e-12);
  });
}

/// A surface that crosses its cell within a step leaves a negative volume. With one whole neighbour, half of
/// which is its own, it would share next to nothing, and the mean would be off by a multiple of their
/// difference.
TYPED_TEST(Redistributing, ANegativePieceHasRoomInItsNeighbourhood) {
  constexpr int dim = TestFixture::dim;
  auto state = this->random_ball(this->grid, 0);
  const auto one = per_volume<dim>(state.bodies[0].material, some_primitives<dim>(state.bodies[0].material));
  auto thinner = one;
  for (double& c : thinner) c *= 0.9;
  int negative = 0;
  for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    if (negative > 0 || b.end_geometry.kind[k] != CellKind::cut) return;
    ++negative;
    set_piece(b, k, -0.47 * this->grid.full_volume(i), thinner);
  });
  EXPECT_EQ(negative, 1);
  this->run(state);
  double most = 0;
  for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
    if (b.volume[k] != 0) most = std::max(most, std::abs(b.contents[k] / b.volume[k] / one[0] - 1));
  });
  EXPECT_GT(most, 0.01);
  EXPECT_LT(most, 0.25);
}

/// Of matter that is partly void the fragment may be heavier than what is around: where its neighbours do not
/// make its mass up, more of them have to.
TYPED_TEST(Redistributing, ANegativePieceBesideVoidsLeavesNoNegativeMass) {
  constexpr int dim = TestFixture::dim;
  for (const double fill : {-0.1, -0.2, -0.3, -0.4}) {
    auto state = this->random_ball(this->grid, 0);
    state.bodies[0].material.damage = TensileDamage{};
    auto one = per_volume<dim>(state.bodies[0].material, some_primitives<dim>(state.bodies[0].material));
    one[Components<dim>::damage] = one[0];
    auto sparse = one;
    for (double& c : sparse) c *= 0.3;
    int negative = 0;
    for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
      const bool drained = negative == 0 && b.end_geometry.kind[k] == CellKind::cut;
      if (drained) ++negative;
      if (b.volume[k] > 0)
        set_piece(b, k, drained ? fill * this->grid.full_volume(i) : b.volume[k], drained ? one : sparse);
    });
    EXPECT_EQ(negative, 1);
    this->run(state);
    for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
      if (b.volume[k] > 0) {
        EXPECT_GT(b.contents[k], 0) << fill;
      }
    });
  }
}

/// A fragment that was small at the start of the step is redistributed to the end of it, even if it has
/// become large: fluxes do not see its own state before the next step.
TYPED_TEST(Redistributing, APieceThatHasGrownIsStillRedistributed) {
  constexpr int dim = TestFixture::dim;
  for (const bool grown : {false, true}) {
    auto state = this->random_ball(this->grid, 0);
    const auto one =
        per_volume<dim>(state.bodies[0].material, some_primitives<dim>(state.bodies[0].material));
    auto dense = one;
    for (double& c : dense) c *= 2;
    const auto is_cut = [](const auto& b, std::size_t k) { return b.geometry.index[k] >= 0; };
    for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
      if (!is_cut(b, k)) return;
      set_piece(b, k, 0.6 * this->grid.full_volume(i), dense);
      b.role[k] = static_cast<std::uint8_t>(grown ? donates : donates | regular);
    });
    this->run(state);
    int pieces = 0, mixed = 0;  // some share with cells as dense as they are
    for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
      if (!is_cut(b, k)) return;
      ++pieces;
      if (b.contents[k] / b.volume[k] / one[0] < 1.99) ++mixed;
    });
    EXPECT_GT(pieces, 0);
    EXPECT_EQ(mixed > pieces / 3, grown);
    EXPECT_TRUE(grown || mixed == 0);
  }
}

TYPED_TEST(Redistributing, ALonePieceGoesToTheNearestWhole) {
  constexpr int dim = TestFixture::dim;
  Vec<dim> normal, point = this->grid.origin;
  normal[0] = 1;
  point[0] += 7 * this->grid.dx;
  auto state = make_test_state<dim>(this->grid, {half_space(point, normal)});
  cut_all(state);
  const auto one = per_volume<dim>(state.bodies[0].material, some_primitives<dim>(state.bodies[0].material));
  fill_body(state, 0, one);
  Index<dim> lost;
  for (int d = 0; d < dim; ++d) lost[d] = 9;  // two empty cells between, and the border of a block
  for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    if (i == lost) set_piece(b, k, 0.01 * this->grid.dx_power(dim), one);
  });
  cut_all(state);  // finds where the matter is
  const auto before = totals(state, 0);
  this->run(state);
  EXPECT_EQ(this->counters.lone_fragments_moved, 1);
  EXPECT_EQ(this->counters.unmerged_fragments, 1);
  const auto after = totals(state, 0);
  for (std::size_t c = 0; c < after.size(); ++c) EXPECT_NEAR(after[c] / before[c], 1, 1e-14);
  Index<dim> home = lost;
  home[0] = 6;
  for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    if (i == lost) {
      EXPECT_EQ(b.volume[k], 0);
      EXPECT_EQ(b.contents[k], 0);
    } else if (i == home) {
      EXPECT_NEAR(b.volume[k] / this->grid.dx_power(dim), 1.01, 1e-5);
    }
  });
}

/// Dust: a cell without volume into which matter has flowed, beside fragments too small to share.
TYPED_TEST(Redistributing, ACellWithoutVolumeKeepsWhatHasFlowedIn) {
  constexpr int dim = TestFixture::dim;
  const Vec<dim> middle = middle_of(this->grid);
  auto state = make_test_state<dim>(this->grid, {ball(middle, 1.1 * this->grid.dx)});
  cut_all(state);
  const auto one = per_volume<dim>(state.bodies[0].material, some_primitives<dim>(state.bodies[0].material));
  int pieces = 0;
  for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
    set_piece(b, k, 0, one);
    if (b.geometry.index[k] < 0) return;
    set_piece(b, k, 0.002 * this->grid.dx_power(dim), one);
    if (pieces++ == 0) b.volume[k] = 0;
  });
  ASSERT_GT(pieces, 1);
  const auto before = totals(state, 0);
  this->run(state);
  const auto after = totals(state, 0);
  for (std::size_t c = 0; c < after.size(); ++c) EXPECT_NEAR(after[c] / before[c], 1, 1e-14) << c;
}

TYPED_TEST(Redistributing, BlocksDoNotMatter) {
  constexpr int dim = TestFixture::dim;
  std::vector<std::map<int, std::vector<double>>> found(2);
  for (const int block : {10, 22}) {
    const auto grid = make_test_grid<dim>(20, block, Edge::outflow);
    auto state = this->random_ball(grid, 0.4);
    this->run(state);
    for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
      auto& values = found[block == 10 ? 0 : 1][grid.domain().at(i)];
      for (std::size_t c = 0; c < Components<dim>::contents; ++c)
        values.push_back(b.contents[c * b.volume.size() + k]);
    });
  }
  EXPECT_EQ(found[0], found[1]);
}

}  // namespace
}  // namespace recoil::redistribution_test
