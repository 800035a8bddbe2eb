#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "../core/dimensions.hpp"
#include "cutcell/merged.hpp"
#include "cutcell/redistribution.hpp"
#include "dynamics/block_update.hpp"
#include "interface/ghosts.hpp"
#include "interface/values.hpp"
#include "interface/walls.hpp"
#include "prepared.hpp"

/// Bodies that turn without stress: whatever is computed at their surfaces must keep them so.
namespace recoil::turning_test {
namespace {

template <class D>
struct TurningBodies : testing::Test {
  static constexpr int dim = D::value;
  using C = Components<dim>;
  Grid<dim> grid = make_test_grid<dim>(20, 10, Edge::outflow);
  Material material = hard();
  Vec<dim> middle = off_centre(grid), drift = steady();
  static constexpr double spin = 3;  // [1/s], about the axis of x and y

  static Material hard() {
    Material m = samples::copper();
    m.strength = Elastic{43e9};
    return m;
  }
  static Vec<dim> off_centre(const Grid<dim>& grid) {
    Vec<dim> x = middle_of(grid);
    x[0] += 0.07;
    return x;
  }
  static Vec<dim> steady() {
    Vec<dim> u;
    u[0] = 20;
    return u;
  }
  Vec<dim> velocity(const Vec<dim>& x) const {
    Vec<dim> u = drift;
    u[0] -= spin * (x[1] - middle[1]);
    u[1] += spin * (x[0] - middle[0]);
    return u;
  }
  double per_cell() const { return spin * grid.dx; }

  /// Where the matter of a fragment is.
  Vec<dim> place(const BodyBlock<dim>& b, const Index<dim>& i, std::size_t k) const {
    Vec<dim> x = grid.centre(i);
    if (b.geometry.index[k] >= 0) x += grid.dx * b.geometry.cuts[b.geometry.index[k]].centroid;
    return x;
  }
  Prepared<dim> turn(const Distance<dim>& shape) const {
    Prepared<dim> p{grid, {shape}, {moving<dim>(material, {})}, material};
    for_each_piece(p.state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
      if (b.volume[k] == 0) return;
      const auto w = moving<dim>(material, velocity(place(b, i, k)));
      set_piece(b, k, b.volume[k], per_volume<dim>(material, w));
    });
    p.prepare();
    return p;
  }
  Prepared<dim> turning_ball() const { return turn(ball(middle, 6.4 * grid.dx)); }
  static void fill_values(Prepared<dim>& p) {
    p.for_each_body([&](Body<dim>& body, int s, Scratch& scratch) {
      choose_ghosts(p.state, body, s, Cells::cut, scratch);
    });
    p.evaluate();
    Scratch scratch;
    for (int s = 0; s < p.state.mesh.local(); ++s) {
      const Scratch::Frame frame(scratch);
      find_walls(p.state, s, 1e-5, 1, scratch);
    }
    p.for_each_body(
        [&](Body<dim>& body, int s, Scratch&) { fill_stencil_values(p.state, body, s, p.counters); });
  }
};
TYPED_TEST_SUITE(TurningBodies, PlaneAndSpace);

TYPED_TEST(TurningBodies, FitsKeepTheSpin) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  auto p = this->turning_ball();
  p.evaluate();
  p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>&) {
    EXPECT_NEAR(w.gradient[C::u + 1][0] / this->per_cell(), 1, 2e-3) << "(m + r)^-1 takes 1 to 3 %";
    EXPECT_NEAR(w.gradient[C::u][1] / this->per_cell(), -1, 2e-3);
  });
}

TYPED_TEST(TurningBodies, CutCellsShowTheVelocityOfTheirCentre) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  auto p = this->turning_ball();
  TestFixture::fill_values(p);
  double off = 0;
  for_each_piece(p.state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    if ((b.role[k] & regular) == 0 || b.geometry.index[k] < 0) return;
    const auto u = this->velocity(this->grid.centre(i));
    for (int d = 0; d < dim; ++d)
      off = std::max(off, std::abs(b.stencil[(C::u + d) * b.volume.size() + k] - u[d]) / this->per_cell());
  });
  EXPECT_LT(off, dim == 2 ? 2e-3 : 0.06) << "in 3-D walls are not in the middle of their surfaces";
}

/// Stress arises from strain alone. At faces that are open in part it is the velocity in the middle of the
/// open part that counts.
TYPED_TEST(TurningBodies, NothingIsStrained) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  auto p = this->turning_ball();
  TestFixture::fill_values(p);
  const double dt = 1e-9, per_strain = 2 * 43e9 * density(this->material) * dt;
  ExactEdgeAccount<dim> edges;
  Scratch scratch;
  for (int s = 0; s < p.state.mesh.local(); ++s) {
    const Scratch::Frame frame(scratch);
    update_block(p.state, p.state.bodies[0], s, FaceTime::now, dt, 1, edges, p.counters, scratch);
  }
  double strain = 0, moment = 0, matter = 0;
  for_each_piece(p.state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
    if (b.volume[k] <= 0) return;
    for (std::size_t c = C::s; c < C::ep; ++c) {
      const double rate = b.contents[c * b.volume.size() + k] / per_strain;
      strain = std::max(strain, std::abs(rate) / this->grid.dx_power(dim));
    }
    moment += b.contents[(C::s + C::stress(0, 1)) * b.volume.size() + k] / per_strain;
    matter += b.volume[k];
  });
  EXPECT_LT(strain / this->spin, dim == 2 ? 2e-3 : 0.1) << "of the cell's volume";
  EXPECT_LT(std::abs(moment) / (matter * this->spin), dim == 2 ? 1e-5 : 2e-4);
}

TYPED_TEST(TurningBodies, RedistributionKeepsTheSpin) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  auto p = this->turning_ball();
  p.evaluate();
  const auto before = totals(p.state, 0);
  update_all(p.state, 0, [&](int s, Scratch& scratch) {
    redistribute(p.state, p.state.bodies[0], s, p.counters, scratch);
  });
  const auto after = totals(p.state, 0);
  double off = 0;
  for (const int c : {0, C::u, C::u + 1, C::energy})
    EXPECT_NEAR(after[c], before[c], 1e-13 * std::abs(before[C::energy])) << c;
  for_each_piece(p.state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    if (b.volume[k] <= 0) return;
    const auto u = this->velocity(this->place(b, i, k));
    const std::size_t n = b.volume.size();
    for (int d = 0; d < dim; ++d)
      off = std::max(off, std::abs(b.contents[(C::u + d) * n + k] / b.contents[k] - u[d]) / this->per_cell());
  });
  EXPECT_LT(off, 2e-3);
}

/// Donors that lie close together have a gradient that means little.
TYPED_TEST(TurningBodies, ANeighbourhoodTurnsNoFasterThanItsDonorsDiffer) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  Wall<dim> wall;
  wall.gradient[C::u + 1][0] = 100;
  Contents<dim> mean{};
  mean[C::rho] = 2;
  mean[C::u + 1] = 10;
  Vec<dim> x;
  x[0] = 0.5;
  for (const double range : {20.0, 400.0}) {
    wall.range[C::u + 1] = range;
    const double velocity = 0.5 * std::min(range, 50.0);
    const auto q = Turning<dim>(wall, 1).change(mean, x);
    EXPECT_NEAR(q[C::u + 1], 2 * velocity, 1e-12);
    EXPECT_NEAR(q[C::energy], 10 * velocity, 1e-12);
  }
}

}  // namespace
}  // namespace recoil::turning_test
