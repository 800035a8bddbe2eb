#include "levelset/band.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "../core/dimensions.hpp"
#include "../cutcell/bodies.hpp"

namespace recoil::band_test {
namespace {

template <class D>
struct Bands : testing::Test {
  static constexpr int dim = D::value;
  // A half space that ends 4 dx beyond the low edge of the third block of four.
  Grid<dim> grid = make_test_grid<dim>(40, 10, Edge::outflow, true);
  State<dim> state = make_test_state<dim>(grid, {surface()});
  Scratch scratch;

  Distance<dim> surface() const {
    Vec<dim> point = grid.origin, normal;
    point[0] += 24.3 * grid.dx;
    normal[0] = 1;
    return half_space(point, normal);
  }
  /// Settles all bands; returns the number of blocks that are there and near the surface, by their place
  /// along x.
  void settle() {
    std::vector<BandChoice<dim>> choice;
    for (int s = 0; s < state.mesh.local(); ++s)
      choice.push_back(choose_band(state, state.bodies[0], s, scratch));
    for (int s = 0; s < state.mesh.local(); ++s) apply_band(state, state.bodies[0], s, choice[s]);
  }
  template <class F>
  void for_each_block(F&& f) {
    for (int s = 0; s < state.mesh.local(); ++s) f(state.mesh.block(s).at[0], state.bodies[0].at(s));
  }
};
TYPED_TEST_SUITE(Bands, Dimensions);

TYPED_TEST(Bands, BlocksAreKeptWhereTheBodyOrItsSurfaceIs) {
  constexpr int dim = TestFixture::dim;
  cut_all(this->state);
  Contents<dim> q{};
  q[0] = 1000;
  fill_body(this->state, 0, q);
  this->settle();
  this->for_each_block([&](int column, const BodyBlock<dim>& b) {
    EXPECT_EQ(b.present, true) << column;
    EXPECT_EQ(b.near_surface, column == 1 || column == 2 || column == 3) << column;
  });
}

/// A block near the surface keeps what the surface carries along only where one without such cells would.
TYPED_TEST(Bands, CellsOutOfReachHaveNoVelocityOfSurfaces) {
  constexpr int dim = TestFixture::dim;
  this->settle();
  this->for_each_block([&](int, BodyBlock<dim>& b) {
    std::fill(b.extension_velocity.begin(), b.extension_velocity.end(), 3.0);
    for (double& phi : b.phi)
      if (phi > 0) phi += 2 * this->grid.dx;  // so that block 2 has cells out of reach
  });
  this->settle();
  int near = 0, out_of_reach = 0, deep = 0;
  this->for_each_block([&](int column, const BodyBlock<dim>& b) {
    for (std::size_t k = 0; (column == 1 || column == 2) && k < b.phi.size(); ++k) {
      const double phi = b.phi[k] / this->grid.dx;
      ++(phi >= reach_cells ? out_of_reach : phi <= -far_cells ? deep : near);
      EXPECT_EQ(b.extension_velocity[k], phi < reach_cells && phi > -far_cells ? 3 : 0) << column << " " << k;
    }
  });
  EXPECT_TRUE(near > 0 && out_of_reach > 0 && deep > 0);
}

TYPED_TEST(Bands, FarBlocksHoldNothing) {
  constexpr int dim = TestFixture::dim;
  this->state.bodies[0].rigid.emplace().distance = this->surface();
  this->settle();
  this->for_each_block([&](int column, const BodyBlock<dim>& b) {
    EXPECT_EQ(b.present, column > 0) << column;  // a rigid body needs only its surface
    EXPECT_EQ(b.phi.empty(), !b.present);
  });
}

TYPED_TEST(Bands, ABlockIsEnteredWhenTheSurfaceComesNear) {
  constexpr int dim = TestFixture::dim;
  auto& body = this->state.bodies[0];
  for (int s = 0; s < this->state.mesh.local(); ++s)
    if (this->state.mesh.block(s).at[0] == 3) leave_block(body, s);
  this->settle();
  this->for_each_block([&](int column, const BodyBlock<dim>& b) {
    if (column != 3) return;
    EXPECT_TRUE(b.present);
    EXPECT_TRUE(b.near_surface);
    for (const double phi : b.phi) EXPECT_EQ(phi, far_cells * this->grid.dx);
    for (const double v : b.volume) EXPECT_EQ(v, 0);
  });
}

/// A fragment that the level set has lost keeps its block, and its cells stay cut.
TYPED_TEST(Bands, LostPiecesStay) {
  constexpr int dim = TestFixture::dim;
  auto state =
      make_test_state<dim>(this->grid, {[this](const Vec<dim>&) { return far_cells * this->grid.dx; }});
  state.bodies[0].at(0).volume[0] = 0.1 * this->grid.dx_power(dim);
  const auto holds = choose_band(state, state.bodies[0], 0, this->scratch);
  EXPECT_TRUE(holds.present);
  EXPECT_TRUE(holds.near_surface);
  const auto empty = choose_band(state, state.bodies[0], 1, this->scratch);
  EXPECT_FALSE(empty.present);
}

TYPED_TEST(Bands, InsideBlocksAreWhole) {
  constexpr int dim = TestFixture::dim;
  cut_all(this->state);
  Contents<dim> q{};
  q[0] = 1000;
  fill_body(this->state, 0, q);
  this->settle();
  this->for_each_block([&](int column, const BodyBlock<dim>& b) {
    if (column != 0) return;
    EXPECT_TRUE(b.geometry.cuts.empty());
    for (const CellKind kind : b.geometry.kind) EXPECT_EQ(kind, CellKind::full);
    for (const auto role : b.role) EXPECT_EQ(role, donates | regular | valued);
  });
}

}  // namespace
}  // namespace recoil::band_test
