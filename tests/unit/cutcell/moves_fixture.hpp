#pragma once

#include <cstddef>
#include <vector>

#include "../core/dimensions.hpp"
#include "bodies.hpp"
#include "cutcell/moves.hpp"
#include "cutcell/surface_exchange.hpp"

namespace recoil {

/// Bodies that have been filled by their level sets, and then changed.
template <class D>
struct Moves : testing::Test {
  static constexpr int dim = D::value;
  Grid<dim> grid = make_test_grid<dim>(20, 10, Edge::outflow);
  const Contents<dim> one = per_volume<dim>(samples::copper(), some_primitives<dim>(samples::copper()));
  Counters counters;
  ExactEdgeAccount<dim> edges;

  double whole() const { return grid.dx_power(dim); }
  State<dim> ball_of(double scatter) const {
    Vec<dim> middle = middle_of(grid);
    middle[0] += 0.07;
    return filled({ball(middle, 6.4 * grid.dx)}, scatter);
  }
  /// Matter below the plane x_0 = `cells` dx, within the domain's edges along the other axes.
  State<dim> slab(double cells) const {
    Vec<dim> normal, point = grid.origin;
    normal[0] = 1;
    point[0] += cells * grid.dx;
    return filled({half_space(point, normal)}, 0);
  }
  State<dim> filled(const std::vector<Distance<dim>>& shapes, double scatter) const {
    auto state = make_test_state<dim>(grid, shapes);
    cut_all(state);
    Random random(4);
    for_each_piece(state, 0, [&](BodyBlock<dim>& b, const Index<dim>& i, std::size_t k) {
      auto q = one;
      for (double& c : q) c *= random(1 - scatter, 1 + scatter);
      double v = volume_by_phi(grid, b, i, k);
      if (b.end_geometry.kind[k] == CellKind::cut) v += 0.3 * scatter * random(-1, 1) * whole();
      set_piece(b, k, v, q);
    });
    return state;
  }

  template <class F>
  void run(State<dim>& state, F&& f) {
    const auto before = totals(state, 0);
    update_all(state, 0, f);
    const auto after = totals(state, 0);
    for (std::size_t c = 0; c < after.size(); ++c) ASSERT_NEAR(after[c] / before[c], 1, 1e-13) << c;
  }
  /// Every fragment is still in the one state that all started from.
  void expect_uniform(State<dim>& state) const {
    for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
      for (std::size_t c = 0; c < one.size(); ++c)
        ASSERT_NEAR(b.contents[c * b.volume.size() + k], b.volume[k] * one[c],
                    1e-14 * whole() * std::abs(one[c]));
    });
  }
  static Index<dim> cell(int first, int others) {
    Index<dim> i;
    for (int d = 0; d < dim; ++d) i[d] = others;
    i[0] = first;
    return i;
  }
  double& volume(State<dim>& state, const Index<dim>& at) const {
    double* found = nullptr;
    for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
      if (i == at) found = &b.volume[k];
    });
    return *found;
  }
  /// A state with a second body far away, of which some cells are given a volume.
  State<dim> beside_another(double cells) const {
    Vec<dim> normal, point = grid.origin, far = grid.origin;
    normal[0] = 1;
    point[0] += cells * grid.dx;
    far[0] += 30 * grid.dx;
    return filled({half_space(point, normal), half_space(far, -normal)}, 0);
  }
  void put(State<dim>& state, const Index<dim>& at, double v, const Contents<dim>& q, int body = 0) const {
    for_each_piece(state, body, [&](auto& b, const Index<dim>& i, std::size_t k) {
      if (i == at) set_piece(b, k, v, q);
    });
  }
};

}  // namespace recoil
