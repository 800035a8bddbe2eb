#include "cutcell/whole_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "bodies.hpp"

namespace recoil::whole_cells_test {
namespace {

/// A half space of copper in one state, cut askew, in fragments as the level set has them.
template <int Dim>
struct Askew {
  Primitives<Dim> primitives = some_primitives<Dim>(samples::copper());
  Contents<Dim> contents = per_volume<Dim>(samples::copper(), primitives);
  State<Dim> state = make();
  Counters counters;

  State<Dim> make() {
    const Grid<Dim> grid = make_test_grid<Dim>(12, 6, Edge::outflow);
    Vec<Dim> normal, point = middle_of(grid);
    for (int d = 0; d < Dim; ++d) normal[d] = 1 - 0.35 * d;
    point[0] += 0.2 * grid.dx;  // beyond a node, before the next centre
    State<Dim> s = make_test_state<Dim>(grid, {half_space<Dim>(point, normal)});
    cut_all(s);
    fill_body(s, 0, contents);
    return s;
  }
  template <class F>
  void for_each_block(F&& f) {
    for (int s = 0; s < state.mesh.local(); ++s) f(s, state.bodies[0].at(s));
  }
};

template <class D>
struct WholeCells : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(WholeCells, Dimensions);

TYPED_TEST(WholeCells, CellsWithTheirCentreInsideAreRealAndKeepTheirState) {
  constexpr int Dim = TypeParam::value;
  Askew<Dim> a;
  a.for_each_block([&](int s, auto&) { to_whole_cells(a.state, a.state.bodies[0], s, a.counters); });
  for_each_piece(a.state, 0, [&](BodyBlock<Dim>& b, const Index<Dim>& i, std::size_t k) {
    const double full = b.phi[k] < 0 ? a.state.grid().full_volume(i) : 0;
    EXPECT_EQ(b.volume[k], full);
    for (std::size_t c = 0; c < a.contents.size(); ++c)
      EXPECT_NEAR(b.contents[c * b.volume.size() + k], a.contents[c] * full,
                  1e-12 * std::abs(a.contents[c] * full));
  });
  EXPECT_EQ(a.counters.real_cells_without_contents, 0);
}

TYPED_TEST(WholeCells, AnEmptyCellInsideIsCounted) {
  constexpr int Dim = TypeParam::value;
  Askew<Dim> a;
  bool done = false;
  for_each_piece(a.state, 0, [&](BodyBlock<Dim>& b, const Index<Dim>&, std::size_t k) {
    if (done || !(b.phi[k] < 0)) return;
    b.volume[k] = 0;
    done = true;
  });
  a.for_each_block([&](int s, auto&) { to_whole_cells(a.state, a.state.bodies[0], s, a.counters); });
  EXPECT_EQ(a.counters.real_cells_without_contents, 1);
}

TYPED_TEST(WholeCells, PiecesComeBackWithGhostsInWhatWasNotReal) {
  constexpr int Dim = TypeParam::value;
  Askew<Dim> a, before;
  a.for_each_block([&](int s, BodyBlock<Dim>& b) {
    to_whole_cells(a.state, a.state.bodies[0], s, a.counters);
    const std::size_t n = b.volume.size();
    b.stencil.swap(b.average);
    for (std::size_t k = 0; k < n; ++k) {
      b.role[k] = valued;
      for (std::size_t c = 0; c < a.primitives.size(); ++c) b.stencil[c * n + k] = a.primitives[c];
    }
    to_cut_cells(a.state, a.state.bodies[0], s, a.counters);
    const BodyBlock<Dim>& was = before.state.bodies[0].at(s);
    const double cell = a.state.grid().dx_power(Dim);
    for (std::size_t k = 0; k < n; ++k) {
      if (b.phi[k] < 0 && was.volume[k] < 0.05 * cell) continue;  // shows more than it has
      EXPECT_NEAR(b.volume[k], was.volume[k], 1e-12 * cell);
      for (std::size_t c = 0; c < a.contents.size(); ++c)
        EXPECT_NEAR(b.contents[c * n + k], was.contents[c * n + k], 1e-9 * std::abs(a.contents[c]) * cell)
            << c;
    }
  });
  EXPECT_EQ(a.counters.uncovered_cells_without_value, 0);
}

TYPED_TEST(WholeCells, AGhostWithoutAValueIsCounted) {
  constexpr int Dim = TypeParam::value;
  Askew<Dim> a;
  a.for_each_block([&](int s, BodyBlock<Dim>& b) {
    to_whole_cells(a.state, a.state.bodies[0], s, a.counters);
    std::fill(b.role.begin(), b.role.end(), std::uint8_t{0});
    to_cut_cells(a.state, a.state.bodies[0], s, a.counters);
  });
  EXPECT_GT(a.counters.uncovered_cells_without_value, 0);
}

}  // namespace
}  // namespace recoil::whole_cells_test
