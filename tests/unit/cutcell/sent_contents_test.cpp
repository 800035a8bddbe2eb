#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "../core/dimensions.hpp"
#include "bodies.hpp"
#include "cutcell/around_small.hpp"
#include "cutcell/moves.hpp"
#include "cutcell/redistribution.hpp"
#include "cutcell/surface_exchange.hpp"
#include "state/sent_cells.hpp"

/// What processes do not send each other of contents, the phases that it is sent for do not read.
namespace recoil::sent_contents_test {
namespace {

template <class D>
struct SentContents : testing::Test {
  static constexpr int dim = D::value;
  using Work = std::function<void(State<dim>& state, int slot, Scratch& scratch)>;
  Grid<dim> grid = make_test_grid<dim>(20, 10, Edge::outflow);
  ExactEdgeAccount<dim> edges;
  Counters counters;

  /// A ball whose fragments hold more and less than the geometry gives them, and a little where it gives
  /// none.
  State<dim> torn_ball(std::uint64_t seed) const {
    Vec<dim> middle = middle_of(grid);
    middle[0] += 0.07;
    auto state = make_test_state<dim>(grid, {ball(middle, 6.4 * grid.dx)});
    cut_all(state);
    const auto one =
        per_volume<dim>(state.bodies[0].material, some_primitives<dim>(state.bodies[0].material));
    for_each_piece(state, 0, [&](BodyBlock<dim>& b, const Index<dim>& i, std::size_t k) {
      Random random(seed * 100000 + static_cast<std::uint64_t>(grid.domain().at(i)));
      auto q = one;
      for (double& c : q) c *= random(0.8, 1.2);
      double volume = volume_by_phi(grid, b, i, k);
      const bool near = std::abs(b.phi[k]) < 2.5 * grid.dx;
      if (near && (b.end_geometry.kind[k] == CellKind::cut || random(0, 1) < 0.1))
        volume += random(-0.15, 0.15) * grid.full_volume(i);
      set_piece(b, k, volume, q);
    });
    return state;
  }

  /// What a block finds from a state in which all that is not sent to it is no number.
  std::vector<Update<dim>> find(const State<dim>& whole, int slot, ContentsSent which, int reach,
                                const MarkedCells& marked, const Work& work) const {
    State<dim> state = whole;
    const Box<dim> near = state.mesh.block(slot).cells.grown(std::min(reach, reach_of(which)));
    const ReadAround read{.cells = reach, .contents = which, .around_small = &marked};
    for (int s = 0; s < state.mesh.local(); ++s) {
      if (s == slot) continue;
      const auto sent = cells_with_sent_contents(state, state.bodies[0], s, read);
      auto& b = state.bodies[0].at(s);
      const std::size_t n = b.volume.size();
      for_each(state.mesh.block(s).cells, [&](const Index<dim>& i) {
        const auto k = static_cast<std::size_t>(grid.layout().at(i - state.mesh.block(s).cells.lo));
        for (std::size_t c = 0; c < Components<dim>::contents; ++c)
          if (sent[k] == 0 || !near.contains(i))
            b.contents[c * n + k] = std::numeric_limits<double>::quiet_NaN();
      });
    }
    Scratch scratch;
    work(state, slot, scratch);
    const auto& updates = state.bodies[0].at(slot).updates;
    return {updates.begin(), updates.end()};
  }

  void check(ContentsSent which, int reach, const Work& work, std::size_t& found) const {
    for (std::uint64_t seed = 1; seed <= (dim == 3 ? 3 : 20); ++seed) {
      const State<dim> state = torn_ball(seed);
      MarkedCells marked{std::vector<std::vector<std::uint8_t>>(static_cast<std::size_t>(state.mesh.local())),
                         1};
      Scratch scratch;
      for (int s = 0; s < state.mesh.local(); ++s)
        marked.of(s, 0) = mark_around_small(state, state.bodies[0], s, scratch);
      for (int s = 0; s < state.mesh.local(); ++s) {
        const auto sent = find(state, s, which, reach, marked, work);
        State<dim> all = state;
        work(all, s, scratch);
        const auto& updates = all.bodies[0].at(s).updates;
        ASSERT_EQ(sent.size(), updates.size());
        for (std::size_t k = 0; k < sent.size(); ++k) {
          ASSERT_EQ(sent[k].volume, updates[k].volume);
          ASSERT_EQ(sent[k].contents, updates[k].contents) << seed << ' ' << sent[k].cell;
        }
        found += sent.size();
      }
    }
  }
};
TYPED_TEST_SUITE(SentContents, Dimensions);

TYPED_TEST(SentContents, AreAllThatRedistributionReads) {
  constexpr int dim = TestFixture::dim;
  std::size_t found = 0;
  this->check(
      ContentsSent::around_small_fragments, 8,
      [this](State<dim>& state, int s, Scratch& scratch) {
        redistribute(state, state.bodies[0], s, this->counters, scratch);
      },
      found);
  EXPECT_GT(found, 0);
}

TYPED_TEST(SentContents, AreAllThatTheExchangeAlongSurfacesReads) {
  constexpr int dim = TestFixture::dim;
  if (dim == 1) return;  // a point has no tangent
  std::size_t found = 0;
  this->check(
      ContentsSent::of_cut_cells, 1,
      [](State<dim>& state, int s, Scratch& scratch) {
        exchange_along_surface(state, state.bodies[0], s, scratch);
      },
      found);
  EXPECT_GT(found, 0);
}

TYPED_TEST(SentContents, AreAllThatMovesRead) {
  constexpr int dim = TestFixture::dim;
  std::size_t found = 0;
  this->check(
      ContentsSent::around_moves, 3,
      [this](State<dim>& state, int s, Scratch& scratch) {
        empty_outside(state, state.bodies[0], s, 0, this->edges, scratch);
      },
      found);
  this->check(
      ContentsSent::around_moves, 3,
      [this](State<dim>& state, int s, Scratch& scratch) {
        fill_inside(state, state.bodies[0], s, this->edges, scratch);
      },
      found);
  this->check(
      ContentsSent::around_moves, 3,
      [this](State<dim>& state, int s, Scratch& scratch) {
        bound_volumes(state, state.bodies[0], s, this->counters, scratch);
      },
      found);
  EXPECT_GT(found, 0);
}

}  // namespace
}  // namespace recoil::sent_contents_test
