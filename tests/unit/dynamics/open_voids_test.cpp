#include "dynamics/open_voids.hpp"

#include <algorithm>
#include <cstddef>

#include "../core/dimensions.hpp"
#include "../cutcell/bodies.hpp"

namespace recoil::open_voids_test {
namespace {

template <class D>
struct Voids : testing::Test {
  static constexpr int dim = D::value;
  using C = Components<dim>;
  Grid<dim> grid = make_test_grid<dim>(20, 10, Edge::outflow);

  double whole() const { return grid.dx_power(dim); }
  /// A body that fills the domain with matter of 0.8 of its density, cold, and a second one with `other`
  /// cells of matter in each cell.
  State<dim> filled(double damage, double other) const {
    Material breaks = samples::copper();
    breaks.damage = TensileDamage{};
    const auto inside = [](const Vec<dim>&) { return -100.0; };
    auto state = make_test_state<dim>(grid, {inside, inside}, breaks);
    cut_all(state);
    Primitives<dim> w{};
    w[0] = 0.8 * density(breaks);
    w[C::p] = pressure(breaks.eos, w[0], 0);
    w[C::damage] = damage;
    fill_body(state, 0, per_volume<dim>(breaks, w));
    const auto q = per_volume<dim>(breaks, some_primitives<dim>(breaks));
    for_each_piece(state, 1,
                   [&](auto& b, const Index<dim>&, std::size_t k) { set_piece(b, k, other * whole(), q); });
    return state;
  }
  void expect(State<dim>& state, double part) const {
    Scratch scratch;
    for (int s = 0; s < state.mesh.local(); ++s) {
      const Scratch::Frame frame(scratch);
      fit_voids(state, state.bodies[0], s, scratch);
    }
    for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
      ASSERT_NEAR(b.volume[k] / whole(), part, 1e-9) << k;
    });
  }
};
TYPED_TEST_SUITE(Voids, Dimensions);

/// As far as there is void, and only what has failed has any.
TYPED_TEST(Voids, GiveWayToOtherBodies) {
  auto alone = this->filled(1, 0), some = this->filled(1, 0.1), more = this->filled(1, 0.5),
       whole = this->filled(0.5, 0.1);
  this->expect(alone, 1);
  this->expect(some, 0.9);
  this->expect(more, 0.8);
  this->expect(whole, 1);
}

/// They fill up the room that other bodies leave.
TYPED_TEST(Voids, FillTheRoomThatOtherBodiesLeave) {
  auto state = this->filled(1, 0.1);
  for_each_piece(state, 0, [&](auto& b, const auto&, std::size_t k) { b.volume[k] *= 0.85; });
  this->expect(state, 0.9);
}

/// What void would make thinner than stencils can use is left to the moves of volume.
TYPED_TEST(Voids, DoNotFillCellsThatHoldNextToNothing) {
  auto state = this->filled(1, 0);
  for_each_piece(state, 0, [&](auto& b, const auto&, std::size_t k) {
    const std::size_t n = b.volume.size();
    b.volume[k] *= 1e-5, b.phi[k] = -5 * this->grid.dx;
    for (std::size_t c = 0; c < TestFixture::C::contents; ++c) b.contents[c * n + k] *= 1e-5;
  });
  this->expect(state, 1e-5);
}

/// Matter that has not failed is filled up only where the level set knows no way outwards, or where less than
/// half of a cell is left that the geometry shows full, as those around it.
TYPED_TEST(Voids, FillCellsThatNothingElseCanFill) {
  auto deep = this->filled(0.5, 0), near_surface = this->filled(0.5, 0), pores = this->filled(0.5, 0),
       beside_surface = this->filled(0.5, 0);
  const auto lack = [&](auto& state, double part, double cells) {
    for_each_piece(state, 0, [&](auto& b, const auto&, std::size_t k) {
      b.volume[k] *= part, b.phi[k] = -cells * this->grid.dx;
    });
  };
  lack(deep, 0.7, far_cells);
  lack(near_surface, 0.7, 5);
  lack(pores, 0.3, 5);
  lack(beside_surface, 0.3, 5);
  for_each_piece(beside_surface, 0, [](auto& b, const Index<TestFixture::dim>& i, std::size_t k) {
    if (i[0] % 2 == 0) b.end_geometry.kind[k] = CellKind::cut;
  });
  this->expect(deep, 1);
  this->expect(near_surface, 0.7);
  this->expect(pores, 1);
  this->expect(beside_surface, 0.3);
}

/// Gas gives way where a cell holds more than 1.1 cells of matter: to the room that is left, to half of its
/// volume at most, and only down to half of the largest density that it takes. Its contents stay.
TYPED_TEST(Voids, GasGivesWayToOtherBodies) {
  constexpr int dim = TestFixture::dim;
  Material air = samples::copper();
  air.eos = samples::of(IdealGas{}).front();
  for (const double other : {0.05, 0.3, 0.8, 1.2}) {
    auto state = this->filled(0, other);
    state.bodies[0].material = air;
    const double most = density_range(air.eos).most * density(air);
    for (const double rho : {density(air), 0.4 * most}) {
      for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
        b.volume[k] = this->whole();
        b.contents[k] = rho * this->whole();
      });
      for (int s = 0; s < state.mesh.local(); ++s) fit_gas(state, state.bodies[0], s);
      const double given = other < 0.1 ? 1 : std::max({0.5, 1 - other, rho / (0.5 * most)});
      for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
        ASSERT_NEAR(b.volume[k] / this->whole(), given, 1e-12) << other;
        ASSERT_EQ(b.contents[k], rho * this->whole());
      });
    }
  }
}

}  // namespace
}  // namespace recoil::open_voids_test
