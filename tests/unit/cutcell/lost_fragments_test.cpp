#include <cstddef>

#include "../core/dimensions.hpp"
#include "bodies.hpp"
#include "cutcell/moves.hpp"

namespace recoil {
namespace {

template <class D>
struct LostFragments : testing::Test {};
TYPED_TEST_SUITE(LostFragments, Dimensions);

/// Two cells of a failed fragment that the geometry has lost: the fuller one takes from the other what it has
/// room for, and keeps what it has. They do not change places.
TYPED_TEST(LostFragments, GatherInTheFullerCell) {
  constexpr int dim = TypeParam::value;
  const Grid<dim> grid = make_test_grid<dim>(20, 10, Edge::outflow);
  Vec<dim> normal, point = grid.origin;
  normal[0] = 1;
  point[0] += 2.2 * grid.dx;
  auto state = make_test_state<dim>(grid, {half_space(point, normal)});
  cut_all(state);
  state.bodies[0].material.damage = TensileDamage{1e9, 1, 1e-8};
  auto failed = per_volume<dim>(samples::copper(), some_primitives<dim>(samples::copper()));
  failed[Components<dim>::damage] = failed[0];
  const double whole = grid.dx_power(dim);
  const auto column = [](const Index<dim>& i, int first) {
    for (int d = 1; d < dim; ++d)
      if (i[d] != 9) return false;
    return i[0] == first;
  };
  for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    if (column(i, 7)) set_piece(b, k, 0.8 * whole, failed);
    if (column(i, 8)) set_piece(b, k, 0.5 * whole, failed);
  });
  ExactAccount<dim> edges;
  update_all(state, 0,
             [&](int s, Scratch& scratch) { empty_outside(state, state.bodies[0], s, 0, edges, scratch); });
  double fuller = 0, other = 0;
  for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    if (column(i, 7)) fuller = b.volume[k] / whole;
    if (column(i, 8)) other = b.volume[k] / whole;
  });
  EXPECT_GT(fuller, 0.8);
  EXPECT_LE(fuller, 1 + 1e-12);
  EXPECT_NEAR(other, 1.3 - fuller, 1e-12);
}

}  // namespace
}  // namespace recoil
