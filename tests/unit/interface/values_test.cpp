#include "interface/values.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "../core/dimensions.hpp"
#include "dynamics/block_update.hpp"
#include "interface/ghosts.hpp"
#include "interface/surface_state.hpp"
#include "interface/walls.hpp"
#include "prepared.hpp"

namespace recoil::values_test {
namespace {

/// @param look(block) at the ghosts that have been chosen.
template <int Dim, class Look>
void fill_values(Prepared<Dim>& p, Look&& look) {
  p.for_each_body([&](Body<Dim>& body, int s, Scratch& scratch) {
    choose_ghosts(p.state, body, s, Cells::cut, scratch);
    look(body.at(s));
  });
  p.evaluate();
  Scratch scratch;
  for (int s = 0; s < p.state.mesh.local(); ++s) {
    const Scratch::Frame frame(scratch);
    find_walls(p.state, s, 1e-5, 1, scratch);
  }
  p.for_each_body(
      [&](Body<Dim>& body, int s, Scratch&) { fill_stencil_values(p.state, body, s, p.counters); });
}

template <int Dim>
void fill_values(Prepared<Dim>& p) {
  fill_values(p, [](BodyBlock<Dim>&) {});
}

template <class D>
struct Values : testing::Test {
  static constexpr int dim = D::value;
  using C = Components<dim>;
  Grid<dim> grid = make_test_grid<dim>(20, 10, Edge::outflow);
  Material material = samples::copper();
  Vec<dim> normal = tilted(), middle = middle_of(grid) + 0.77 * grid.dx * normal;

  static Vec<dim> tilted() {
    Vec<dim> n;
    for (int d = 0; d < dim; ++d) n[d] = 1 - 0.45 * d;
    return unit(n);
  }
  static Vec<dim> axis_vector() {
    Vec<dim> n;
    n[0] = 1;
    return n;
  }
  bool inside(const Index<dim>& i) const { return grid.domain().grown(-4).contains(i); }
  static Primitives<dim> stencil_of(const BodyBlock<dim>& b, std::size_t k) {
    Primitives<dim> w{};
    for (std::size_t c = 0; c < w.size(); ++c) w[c] = b.stencil[c * b.volume.size() + k];
    return w;
  }
};
TYPED_TEST_SUITE(Values, Dimensions);

TYPED_TEST(Values, ABodyInFreeFlightLooksTheSameEverywhere) {
  constexpr int dim = TestFixture::dim;
  Vec<dim> u;
  for (int d = 0; d < dim; ++d) u[d] = 70 - 130 * d;
  const auto w0 = moving<dim>(this->material, u);
  Prepared<dim> p(this->grid, {ball(this->middle, 6.4 * this->grid.dx)}, {w0});
  fill_values(p);
  int ghosts = 0;
  for_each_piece(p.state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
    if ((b.role[k] & valued) == 0) return;
    ghosts += (b.role[k] & regular) == 0;
    const auto w = TestFixture::stencil_of(b, k);
    ASSERT_NEAR(w[0], w0[0], 1e-9);
    for (int d = 0; d < dim; ++d) ASSERT_NEAR(w[1 + d], u[d], 1e-9);
    for (std::size_t c = Components<dim>::p; c < Components<dim>::ep; ++c) ASSERT_NEAR(w[c], 0, 1e-2);
  });
  EXPECT_GT(ghosts, dim == 1 ? 4 : 50);
}

/// The surface nearest to a ghost may be that of a fragment thinner than a cell, which the geometry does not
/// show: then the wall of the matter that reads the ghost gives it its value.
TYPED_TEST(Values, GhostsBesideAFragmentThatIsTooThinTakeTheNearestWall) {
  constexpr int dim = TestFixture::dim;
  const double dx = this->grid.dx, surface = this->grid.centre({})[0] + 10.4 * dx,
               fragment = this->grid.centre({})[0] + 13 * dx;
  const Distance<dim> shape = [=](const Vec<dim>& x) {
    return std::min(x[0] - surface, std::abs(x[0] - fragment) - 0.4 * dx);
  };
  Prepared<dim> p(this->grid, {shape}, {some_primitives<dim>(this->material)});
  fill_values(p);
  EXPECT_EQ(p.counters.ghosts_without_wall, 0);
  int ghosts = 0;
  for_each_piece(p.state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    if (!this->inside(i) || i[0] != 12) return;
    ++ghosts;
    ASSERT_NE(b.role[k] & valued, 0);
    const auto s = resolve<dim>(TestFixture::stencil_of(b, k), TestFixture::axis_vector());
    ASSERT_NEAR(s.stress, 0, 1e3);
  });
  EXPECT_GT(ghosts, 0);
}

/// Ghosts beyond failed matter with voids are of its density, and have the energy that belongs to it.
TYPED_TEST(Values, GhostsOfFailedMatterHaveTheEnergyOfItsVoids) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  Material breaks = this->material;
  breaks.damage = TensileDamage{};
  Primitives<dim> torn = moving<dim>(breaks, 50 * this->normal);
  torn[0] *= 0.97;
  torn[C::p] = pressure(breaks.eos, torn[0], 0);
  torn[C::damage] = 1;
  Prepared<dim> p(this->grid, {ball(this->middle, 6.4 * this->grid.dx)}, {torn}, breaks);
  fill_values(p);
  const double own = energy(breaks.eos, torn[0], 0);
  int ghosts = 0;
  for_each_piece(p.state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
    if ((b.role[k] & valued) == 0) return;
    ghosts += (b.role[k] & regular) == 0;
    const auto w = TestFixture::stencil_of(b, k);
    ASSERT_NEAR(w[0] / torn[0], 1, 1e-9);
    ASSERT_NEAR(w[C::extra] / own, -1, 1e-6);
  });
  EXPECT_GT(ghosts, dim == 1 ? 4 : 50);
}

/// No reconstruction at an open face lacks a value, on any block.
TYPED_TEST(Values, EveryFaceFindsItsValues) {
  constexpr int dim = TestFixture::dim;
  Prepared<dim> p(this->grid, {ball(this->middle, 6.4 * this->grid.dx)},
                  {some_primitives<dim>(this->material)});
  fill_values(p);
  Scratch scratch;
  ExactEdgeAccount<dim> edges;
  for (int s = 0; s < p.state.mesh.local(); ++s) {
    const Scratch::Frame frame(scratch);
    update_block(p.state, p.state.bodies[0], s, FaceTime::now, 1e-9, 1, edges, p.counters, scratch);
  }
  EXPECT_EQ(p.counters.faces_without_value, 0);
  EXPECT_EQ(p.counters.first_order_faces, 0);
  EXPECT_EQ(p.counters.cuts_without_donor, 0);
  EXPECT_EQ(p.counters.ghosts_without_wall, 0);
  EXPECT_EQ(p.counters.clamped_fit_densities, 0);
  EXPECT_EQ(p.counters.clamped_ghost_densities, 0);
}

/// Beyond a free surface of a stressed body: no traction, and the recoil u - sigma/Z n - tau/Z_s.
TYPED_TEST(Values, GhostsBeyondAFreeSurfaceCarryNoTraction) {
  constexpr int dim = TestFixture::dim;
  const auto w0 = some_primitives<dim>(this->material);
  Prepared<dim> p(this->grid, {half_space(this->middle, this->normal)}, {w0});
  fill_values(p);
  const auto own = surface_state<dim>(this->material, w0, this->normal);
  int ghosts = 0;
  for_each_piece(p.state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    if (!this->inside(i) || (b.role[k] & valued) == 0) return;
    const auto w = TestFixture::stencil_of(b, k);
    if ((b.role[k] & regular) != 0) {
      if (b.geometry.kind[k] != CellKind::full) return;
      for (std::size_t c = 0; c < w.size(); ++c) ASSERT_NEAR(w[c], w0[c], 1e-9 * std::abs(w0[c]));
      return;
    }
    ++ghosts;
    const auto s = resolve<dim>(w, this->normal);
    ASSERT_NEAR(s.stress, 0, 1e-6 * std::abs(own.stress));
    ASSERT_LT(norm(s.shear), 1e-6 * std::abs(own.stress));
    ASSERT_NEAR(s.velocity, own.velocity - own.stress / own.impedance, 1e-6);
    ASSERT_LT(norm(s.sliding - own.sliding + shear_recoil(own)), 1e-6);
    ASSERT_NEAR(s.deviator, own.deviator, 1e-6 * std::abs(own.stress));
    ASSERT_LT(w[0], w0[0]);  // released from compression
  });
  EXPECT_GT(ghosts, dim == 1 ? 1 : 20);
}

/// Beyond a contact the ghosts carry its traction.
TYPED_TEST(Values, GhostsBeyondAContactCarryItsTraction) {
  constexpr int dim = TestFixture::dim;
  const double speed = 60, z = density(this->material) * longitudinal_speed(this->material);
  Prepared<dim> p(this->grid,
                  {half_space(this->middle, this->normal), half_space(this->middle, -this->normal)},
                  {moving<dim>(this->material, speed * this->normal), moving<dim>(this->material, {})});
  fill_values(p);
  int ghosts = 0;
  for (int m = 0; m < 2; ++m)
    for_each_piece(p.state, m, [&](auto& b, const Index<dim>& i, std::size_t k) {
      if (!this->inside(i) || (b.role[k] & valued) == 0 || (b.role[k] & regular) != 0) return;
      ++ghosts;
      const auto s = resolve<dim>(TestFixture::stencil_of(b, k), this->normal);
      ASSERT_NEAR(s.stress / (-0.5 * speed * z), 1, 1e-6);
      ASSERT_NEAR(s.velocity, 0.5 * speed, 1e-6);
    });
  EXPECT_GT(ghosts, dim == 1 ? 2 : 40);
}

/// Beyond the surface of a turning body the tangential velocity goes on as within it: nothing brakes the
/// spin.
TYPED_TEST(Values, GhostsOfATurningBodyTurnWithIt) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  if constexpr (dim > 1) {
    Prepared<dim> p(this->grid, {half_space(this->middle, this->normal)}, {moving<dim>(this->material, {})});
    const double spin = 40 / this->grid.dx;  // 40 m/s per cell
    const auto turning = [&](const Vec<dim>& x) {
      Vec<dim> u;
      u[0] = -spin * (x[1] - this->middle[1]), u[1] = spin * (x[0] - this->middle[0]);
      return u;
    };
    for_each_piece(p.state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
      auto x = this->grid.centre(i);
      if (b.geometry.index[k] >= 0) x += this->grid.dx * b.geometry.cuts[b.geometry.index[k]].centroid;
      for (int d = 0; d < dim; ++d)
        b.average[static_cast<std::size_t>(C::u + d) * b.volume.size() + k] = turning(x)[d];
    });
    fill_values(p);
    int ghosts = 0;
    for_each_piece(p.state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
      if (!this->inside(i) || (b.role[k] & valued) == 0 || (b.role[k] & regular) != 0) return;
      ++ghosts;
      const auto s = resolve<dim>(TestFixture::stencil_of(b, k), this->normal);
      const Vec<dim> u = turning(this->grid.centre(i));
      ASSERT_LT(norm(s.sliding - (u - dot(u, this->normal) * this->normal)), 0.1 * 40) << "a tenth of a cell";
    });
    EXPECT_GT(ghosts, 20);
  }
}

/// The density beyond a wall follows the stress along the isentrope by a factor of e at most; where it is
/// cut, that is counted. So is a ghost without a wall.
TYPED_TEST(Values, WhatIsCutOrMissingIsCounted) {
  constexpr int dim = TestFixture::dim;
  for (const double speed : {50.0, 20000.0, 1e7}) {
    Prepared<dim> p(this->grid,
                    {half_space(this->middle, this->normal), half_space(this->middle, -this->normal)},
                    {moving<dim>(this->material, speed * this->normal), moving<dim>(this->material, {})});
    fill_values(p);
    EXPECT_EQ(p.counters.clamped_ghost_densities > 0, speed > 1e6) << speed;
    EXPECT_EQ(p.counters.ghosts_without_wall, 0);
    ASSERT_FALSE(p.state.bodies[0].at(0).ghosts.empty() && p.state.bodies[0].at(1).ghosts.empty());
    for (auto& b : p.state.bodies[0].blocks) {
      b.average.swap(b.stencil);
      for (GhostCell<dim>& ghost : b.ghosts) ghost.slot = -1;
    }
    Counters lone;
    for (int s = 0; s < p.state.mesh.local(); ++s) fill_stencil_values(p.state, p.state.bodies[0], s, lone);
    EXPECT_GT(lone.ghosts_without_wall, 0);
    EXPECT_EQ(lone.cuts_without_donor, 0);
  }
}

/// A fragment that donates and has no wall near, in a crack that the geometry does not show, keeps its own
/// average.
TYPED_TEST(Values, AFragmentInACrackThatIsNotShownHasItsOwnValue) {
  constexpr int dim = TestFixture::dim;
  const auto w0 = some_primitives<dim>(this->material);
  const auto q = per_volume<dim>(this->material, w0);
  Prepared<dim> p(this->grid, {half_space(this->middle, this->normal)}, {w0});
  for_each_piece(p.state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
    if (b.geometry.kind[k] == CellKind::cut) set_piece(b, k, 0.4 * this->grid.dx_power(dim), q);
  });
  p.prepare();
  int cracks = 0;
  fill_values(p, [&](BodyBlock<dim>& b) {
    for (GhostCell<dim>& ghost : b.ghosts) {
      if ((b.role[ghost.cell] & donates) == 0) continue;
      ghost.slot = -1;
      ++cracks;
    }
  });
  EXPECT_GT(cracks, 0);
  EXPECT_EQ(p.counters.ghosts_without_wall, 0);
  for (auto& b : p.state.bodies[0].blocks)
    for (const GhostCell<dim>& ghost : b.ghosts) {
      if (ghost.slot >= 0) continue;
      EXPECT_NE(b.role[ghost.cell] & valued, 0);
      EXPECT_NEAR(TestFixture::stencil_of(b, ghost.cell)[0], w0[0], 1e-6);
    }
}

/// In front of a strong shock the stress of a ghost goes no further than matter bears, so that its density
/// agrees with it and is not cut.
TYPED_TEST(Values, GhostsInFrontOfAStrongShockBearALimitedTension) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  Prepared<dim> p(this->grid, {half_space(this->middle, this->normal)}, {moving<dim>(this->material, {})});
  const double modulus = density(this->material) * std::pow(bulk_sound_speed(this->material), 2);
  for_each_piece(p.state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    const double depth = dot(this->middle - this->grid.centre(i), this->normal) / this->grid.dx;
    const std::size_t n = b.volume.size();
    if (depth < 1) return;
    b.average[C::p * n + k] = 0.4 * modulus;
    b.average[k] = 1.2 * density(this->material);
  });
  fill_values(p);
  double lowest = 0;
  for_each_piece(p.state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    if (!this->inside(i) || (b.role[k] & valued) == 0 || (b.role[k] & regular) != 0) return;
    const auto w = TestFixture::stencil_of(b, k);
    lowest = std::min(lowest, w[C::p]);
    EXPECT_GE(w[C::p], -0.5 * modulus);
    EXPECT_LT(w[C::p], 0.1 * modulus);
  });
  EXPECT_LT(lowest, 0);
  EXPECT_EQ(p.counters.clamped_ghost_densities, 0);
}

/// The average of a cut cell belongs to its centroid; where a stress falls off towards a free surface, the
/// value at the cell's centre lies between the average and the wall's.
TYPED_TEST(Values, AveragesOfCutCellsMoveToTheirCentres) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  Prepared<dim> p(this->grid, {half_space(this->middle, this->normal)}, {moving<dim>(this->material, {})});
  const double slope = 1e8;  // Pa per dx
  const auto pressure = [&](const Vec<dim>& x) {
    return -slope * dot(x - this->middle, this->normal) / this->grid.dx;
  };
  for_each_piece(p.state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    auto x = this->grid.centre(i);
    if (b.geometry.index[k] >= 0) x += this->grid.dx * b.geometry.cuts[b.geometry.index[k]].centroid;
    b.average[C::p * b.volume.size() + k] = pressure(x);
  });
  fill_values(p);
  int moved = 0;
  for_each_piece(p.state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    if (!this->inside(i) || b.geometry.index[k] < 0 || (b.role[k] & regular) == 0) return;
    const auto& cut = b.geometry.cuts[b.geometry.index[k]];
    const double average = pressure(this->grid.centre(i) + this->grid.dx * cut.centroid),
                 value = b.stencil[C::p * b.volume.size() + k];
    moved += std::abs(value - average) > 0.01 * slope;
    ASSERT_NEAR(value, pressure(this->grid.centre(i)), 0.12 * slope);
  });
  EXPECT_GT(moved, dim == 1 ? 0 : 5);
}

/// But for thin vapour whose level set lags behind its volume: beyond the wall the line through average and
/// wall has a tension, at which the density by linear response is below zero.
TYPED_TEST(Values, AveragesStayWhereMatterCouldNotFollow) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  Material vapour = this->material;
  vapour.eos = MieGruneisenCubic{8930, 3940, 1.489, 0, 0, 2.02, .47, 5.31e6, .25};
  Primitives<dim> w0 = moving<dim>(vapour, {});
  w0[0] = 20;
  w0[C::p] = 1.2e8;
  const double surface = this->grid.centre({})[0] + 9.55 * this->grid.dx;
  Prepared<dim> p(this->grid, {[=](const Vec<dim>& x) { return x[0] - surface; }}, {w0}, vapour);
  for_each_piece(p.state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
    if (b.geometry.kind[k] == CellKind::cut)
      set_piece(b, k, this->grid.dx_power(dim), per_volume<dim>(vapour, w0));
  });
  p.prepare();
  for_each_piece(p.state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    const double depth = (surface - this->grid.centre(i)[0]) / this->grid.dx;
    b.average[C::p * b.volume.size() + k] = w0[C::p] + 2e8 * std::max(depth, 0.0);
  });
  fill_values(p);
  int cut = 0;
  for_each_piece(p.state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    if (!this->inside(i) || b.geometry.kind[k] != CellKind::cut) return;
    ++cut;
    const auto w = TestFixture::stencil_of(b, k);
    ASSERT_NEAR(w[0], w0[0], 1e-9 * w0[0]);
    ASSERT_NEAR(w[C::p], w0[C::p], 1e-9 * w0[C::p]);
  });
  EXPECT_GT(cut, 0);
  EXPECT_GE(p.counters.clamped_ghost_densities, cut);
}

}  // namespace
}  // namespace recoil::values_test
