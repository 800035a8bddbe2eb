#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "../core/dimensions.hpp"
#include "interface/walls.hpp"
#include "prepared.hpp"

namespace recoil {

/// One wall after another, found anew.
template <int Dim>
void find_all(Prepared<Dim>& p, double dt, double weight = 1) {
  p.evaluate();
  Scratch scratch;
  for (int s = 0; s < p.state.mesh.local(); ++s) {
    const Scratch::Frame frame(scratch);
    find_walls(p.state, s, dt, weight, scratch);
  }
}

template <class D>
struct Walls : testing::Test {
  static constexpr int dim = D::value;
  using C = Components<dim>;
  Grid<dim> grid = make_test_grid<dim>(20, 10, Edge::outflow);
  Material material = samples::copper();
  Vec<dim> middle = middle_of(grid), normal = tilted();
  const double z = density(material) * longitudinal_speed(material),
               zs = std::sqrt(density(material) * 43.33e9);
  const double dt = 1e-5;

  static Vec<dim> tilted() {
    Vec<dim> n;
    for (int d = 0; d < dim; ++d) n[d] = 1 - 0.45 * d;
    return unit(n);
  }
  bool inside(const Index<dim>& i) const { return grid.domain().grown(-4).contains(i); }
  Prepared<dim> free_half(const Primitives<dim>& w) { return {grid, {half_space(middle, normal)}, {w}}; }
  /// Two bodies that face each other across a plane, the first below it, with a gap [dx].
  Prepared<dim> facing(double gap, const Primitives<dim>& below, const Primitives<dim>& above) {
    return {grid,
            {half_space(middle - 0.5 * gap * grid.dx * normal, normal),
             half_space(middle + 0.5 * gap * grid.dx * normal, -normal)},
            {below, above}};
  }
  /// Sum of the forces on, and of the power given to, both bodies in every cell: zero to the last bit.
  void expect_balance(Prepared<dim>& p) {
    std::vector<Vec<dim>> force(static_cast<std::size_t>(grid.domain().size()));
    std::vector<double> power(force.size());
    for (int m = 0; m < 2; ++m)
      p.for_each_wall(m, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>& i) {
        force[grid.domain().at(i)] += w.force;
        power[grid.domain().at(i)] += w.power;
      });
    for (const auto& f : force) ASSERT_EQ(f, Vec<dim>{});
    for (const double e : power) ASSERT_EQ(e, 0);
  }
};

}  // namespace recoil
