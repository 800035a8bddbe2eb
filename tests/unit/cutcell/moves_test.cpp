#include "cutcell/moves.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "moves_fixture.hpp"

namespace recoil::moves_test {
namespace {

TYPED_TEST_SUITE(Moves, Dimensions);

TYPED_TEST(Moves, TheMismatchIsAnExcessOverTheArea) {
  constexpr int dim = TestFixture::dim;
  auto state = this->slab(7.4);
  const auto at = TestFixture::cell(7, 9);
  this->volume(state, at) += 0.1 * this->whole();
  this->volume(state, TestFixture::cell(7, 8)) -= 0.05 * this->whole();
  for (int s = 0; s < state.mesh.local(); ++s) measure_mismatch(state, state.bodies[0], s);
  for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    if (b.end_geometry.kind[k] != CellKind::cut) return;
    const double h = b.end_geometry.cuts[b.end_geometry.index[k]].mismatch / this->grid.dx;
    const double expected = dim == 1 ? 0.05 : i == at ? 0.1 : i == TestFixture::cell(7, 8) ? -0.05 : 0;
    EXPECT_NEAR(h, expected, 1e-12);
  });
}

TYPED_TEST(Moves, WhatLiesOutsideGoesInwards) {
  auto state = this->slab(7.4);
  const auto outside = TestFixture::cell(8, 9), inwards = TestFixture::cell(7, 9);
  this->put(state, outside, 0.05 * this->whole(), this->one);
  this->run(state, [&](int s, Scratch& scratch) {
    empty_outside(state, state.bodies[0], s, 0, this->edges, scratch);
  });
  EXPECT_EQ(this->volume(state, outside), 0);
  EXPECT_NEAR(this->volume(state, inwards) / this->whole(), 0.45, 1e-12);
  EXPECT_EQ(this->edges.mass.value(), 0);
  this->expect_uniform(state);
}

TYPED_TEST(Moves, TheRestOfABodyBeyondAnOpenEdgeIsBookedAsOutflow) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  auto state = this->slab(-0.3);
  const auto last = TestFixture::cell(0, 9);
  const double volume = 0.05 * this->whole();
  this->put(state, last, volume, this->one);
  update_all(state, 0, [&](int s, Scratch& scratch) {
    empty_outside(state, state.bodies[0], s, 0, this->edges, scratch);
  });
  EXPECT_EQ(this->volume(state, last), 0);
  for (const double left : totals(state, 0)) EXPECT_EQ(left, 0);
  EXPECT_DOUBLE_EQ(this->edges.mass.value(), volume * this->one[C::rho]);
  EXPECT_DOUBLE_EQ(this->edges.energy.value(), volume * this->one[C::energy]);
  for (int d = 0; d < dim; ++d)
    EXPECT_DOUBLE_EQ(this->edges.momentum[d].value(), volume * this->one[C::u + static_cast<std::size_t>(d)]);
}

TYPED_TEST(Moves, FullCellsPassOnTheirExcess) {
  auto state = this->slab(7.4);
  const auto over = TestFixture::cell(6, 9), outwards = TestFixture::cell(7, 9);
  this->put(state, over, 1.02 * this->whole(), this->one);
  this->run(state,
            [&](int s, Scratch& scratch) { fill_inside(state, state.bodies[0], s, this->edges, scratch); });
  EXPECT_NEAR(this->volume(state, over) / this->whole(), 1, 1e-15);
  EXPECT_NEAR(this->volume(state, outwards) / this->whole(), 0.42, 1e-12);
  this->expect_uniform(state);
}

TYPED_TEST(Moves, FullCellsTakeWhatTheyLack) {
  constexpr int dim = TestFixture::dim;
  auto state = this->slab(7.4);
  const auto under = TestFixture::cell(6, 9), outwards = TestFixture::cell(7, 9);
  auto other = this->one;
  for (double& c : other) c *= 1.1;
  this->put(state, under, 0.95 * this->whole(), this->one);
  this->put(state, outwards, 0.4 * this->whole(), other);
  this->run(state,
            [&](int s, Scratch& scratch) { fill_inside(state, state.bodies[0], s, this->edges, scratch); });
  EXPECT_NEAR(this->volume(state, under) / this->whole(), 1, 1e-15);
  EXPECT_NEAR(this->volume(state, outwards) / this->whole(), 0.35, 1e-12);
  for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    // The volume comes with the state of the neighbour, which holds enough.
    if (i == under) {
      EXPECT_NEAR(b.contents[k] / (this->whole() * this->one[0]), 0.95 + 0.05 * 1.1, 1e-13);
    } else if (i == outwards) {
      EXPECT_NEAR(b.contents[k] / b.volume[k] / other[0], 1, 1e-13);
    }
  });
}

/// A cell inside by the level set with nothing in it has no state: it takes half of what its neighbour holds.
TYPED_TEST(Moves, FullCellsWithNothingInThemFillUp) {
  auto state = this->slab(7.4);
  const auto empty = TestFixture::cell(6, 9), outwards = TestFixture::cell(7, 9);
  this->put(state, empty, 0, this->one);
  this->run(state,
            [&](int s, Scratch& scratch) { fill_inside(state, state.bodies[0], s, this->edges, scratch); });
  EXPECT_NEAR(this->volume(state, empty) / this->whole(), 0.2, 1e-12);
  EXPECT_NEAR(this->volume(state, outwards) / this->whole(), 0.2, 1e-12);
  this->expect_uniform(state);
}

/// The body goes on beyond an open edge, in the state of the cell there.
TYPED_TEST(Moves, WhatAFullCellLacksComesThroughAnOpenEdge) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  auto state = this->slab(20.6);
  const auto under = TestFixture::cell(19, 9), over = TestFixture::cell(19, 8);
  this->put(state, under, 0.7 * this->whole(), this->one);
  if (dim > 1) this->put(state, over, 1.1 * this->whole(), this->one);
  const auto before = totals(state, 0);
  update_all(state, 0,
             [&](int s, Scratch& scratch) { fill_inside(state, state.bodies[0], s, this->edges, scratch); });
  EXPECT_NEAR(this->volume(state, under) / this->whole(), 1, 1e-15);
  this->expect_uniform(state);
  const double left = (dim > 1 ? 0.1 - 0.3 : -0.3) * this->whole();
  EXPECT_NEAR(this->edges.mass.value() / (left * this->one[C::rho]), 1, 1e-12);
  EXPECT_NEAR(this->edges.energy.value() / (left * this->one[C::energy]), 1, 1e-12);
  EXPECT_NEAR((totals(state, 0)[C::rho] + this->edges.mass.value()) / before[C::rho], 1, 1e-14);
}

/// Beyond the reach of the surface a block may not look at what others send it.
TYPED_TEST(Moves, DeepInsideNothingMoves) {
  auto state = this->slab(17.4);
  const auto deep = TestFixture::cell(10, 9);
  this->put(state, deep, 0.7 * this->whole(), this->one);
  this->run(state,
            [&](int s, Scratch& scratch) { fill_inside(state, state.bodies[0], s, this->edges, scratch); });
  EXPECT_EQ(this->volume(state, deep), 0.7 * this->whole());
}

TYPED_TEST(Moves, AThinBodyKeepsADeficitThatItsNeighbourCannotFill) {
  constexpr int dim = TestFixture::dim;
  Vec<dim> normal, point = this->grid.origin;
  normal[0] = 1;
  point[0] += 6.95 * this->grid.dx;
  Vec<dim> other = point;
  other[0] -= 1.3 * this->grid.dx;
  const auto right = half_space<dim>(point, normal), left = half_space<dim>(other, -normal);
  auto state = this->filled({[&](const Vec<dim>& x) { return std::max(left(x), right(x)); }}, 0);
  const auto at = TestFixture::cell(6, 9);  // the geometry shows more than V holds
  for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    if (i[0] == 5 || i[0] == 7) set_piece(b, k, 0.05 * this->whole(), this->one);
    if (i[0] != 6) return;
    b.end_geometry.kind[k] = CellKind::full;
    set_piece(b, k, 0.6 * this->whole(), this->one);
  });
  this->run(state,
            [&](int s, Scratch& scratch) { fill_inside(state, state.bodies[0], s, this->edges, scratch); });
  EXPECT_EQ(this->volume(state, at), 0.6 * this->whole());
}

/// Else a volume of nearly -1 cell comes about, and fluxes and redistribution become unstable beside it.
TYPED_TEST(Moves, AThickBodyKeepsADeficitThatWouldTakeItsNeighbourFarBelowZero) {
  for (const bool too_much : {false, true}) {
    auto state = this->slab(7.05);
    const double there = 0.05 * this->whole(), lacks = (too_much ? 0.16 : 0.14) * this->whole();
    const auto under = TestFixture::cell(6, 9), outwards = TestFixture::cell(7, 9);
    this->put(state, under, this->whole() - lacks, this->one);
    this->put(state, outwards, there, this->one);
    this->run(state,
              [&](int s, Scratch& scratch) { fill_inside(state, state.bodies[0], s, this->edges, scratch); });
    EXPECT_NEAR(this->volume(state, under) / this->whole(), too_much ? 0.84 : 1, 1e-12);
    EXPECT_NEAR(this->volume(state, outwards) / this->whole(), too_much ? 0.05 : -0.09, 1e-12);
  }
}

/// Most of a cell of failed matter may be void. A whole cell takes volume from it in its own state as long as
/// half of the density is left; beyond that one that has failed takes half of what is there, void and all.
TYPED_TEST(Moves, AFullCellLeavesFailedMatterHalfOfItsDensity) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  const auto under = TestFixture::cell(6, 9), outwards = TestFixture::cell(7, 9);
  const auto expect = [&](double density, bool fails, double here, double there, double left) {
    auto state = this->slab(7.4);
    state.bodies[0].material.damage = TensileDamage{};
    auto whole = this->one, sparse = this->one;
    for (double& c : sparse) c *= density;
    if (fails) whole[C::damage] = whole[C::rho];
    sparse[C::damage] = sparse[C::rho];
    this->put(state, under, 0.5 * this->whole(), whole);
    this->put(state, outwards, 0.9 * this->whole(), sparse);
    this->run(state,
              [&](int s, Scratch& scratch) { fill_inside(state, state.bodies[0], s, this->edges, scratch); });
    EXPECT_NEAR(this->volume(state, under) / this->whole(), here, 1e-12);
    EXPECT_NEAR(this->volume(state, outwards) / this->whole(), there, 1e-12);
    for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
      if (i == outwards) {
        EXPECT_NEAR(b.contents[k] / b.volume[k] / this->one[C::rho], left, 1e-12);
      }
    });
  };
  expect(0.9, false, 1, 0.4, (0.81 - 0.5) / 0.4);
  expect(0.4, false, 0.5 + 0.225, 0.9 - 0.225, 0.2);  // 0.36 - 0.225 of mass
  expect(0.4, true, 0.5 + 0.45, 0.45, 0.4);
}

/// Before voids are fitted: a cell beside one that void has filled up would take void in its place.
TYPED_TEST(Moves, NegativeVolumesInFullCellsAreTakenInByMatterThatCanFail) {
  for (const bool can_fail : {false, true}) {
    auto state = this->slab(7.4);
    if (can_fail) state.bodies[0].material.damage = TensileDamage{};
    const auto under = TestFixture::cell(6, 9);
    this->put(state, under, -0.3 * this->whole(), this->one);
    this->run(state, [&](int s, Scratch& scratch) {
      empty_outside(state, state.bodies[0], s, 0, this->edges, scratch);
    });
    EXPECT_NEAR(this->volume(state, under) / this->whole(), can_fail ? 0 : -0.3, 1e-12);
    this->expect_uniform(state);
  }
}

TYPED_TEST(Moves, VolumesBeyondTheirBoundsMove) {
  auto state = this->slab(7.4);
  const auto drained = TestFixture::cell(7, 9), inwards = TestFixture::cell(6, 9);
  this->put(state, drained, -0.2 * this->whole(), this->one);
  this->run(state, [&](int s, Scratch& scratch) {
    bound_volumes(state, state.bodies[0], s, this->counters, scratch);
  });
  EXPECT_EQ(this->counters.volume_bounds, 1);
  EXPECT_EQ(this->volume(state, drained), 0);
  EXPECT_NEAR(this->volume(state, inwards) / this->whole(), 0.8, 1e-12);
  this->expect_uniform(state);
}

/// A cell that is mostly void has volume enough to take a negative one in, but not the mass.
TYPED_TEST(Moves, NegativeVolumesAreNotTakenInByVoids) {
  auto state = this->slab(7.4);
  const auto drained = TestFixture::cell(7, 9), inwards = TestFixture::cell(6, 9);
  auto sparse = this->one;
  for (double& c : sparse) c *= 0.1;
  this->put(state, drained, -0.2 * this->whole(), this->one);
  this->put(state, inwards, this->whole(), sparse);
  this->run(state, [&](int s, Scratch& scratch) {
    bound_volumes(state, state.bodies[0], s, this->counters, scratch);
  });
  EXPECT_EQ(this->volume(state, inwards), this->whole());
}

/// Sharp corners that are turned against the mesh are emptied in every step.
TYPED_TEST(Moves, VolumesJustBeyondTheirBoundsMoveButAreNotCounted) {
  auto state = this->slab(7.4);
  const auto drained = TestFixture::cell(7, 9);
  for (const int x : {5, 6})
    this->put(state, TestFixture::cell(x, 9), 0.5 * this->whole(), this->one);  // thin
  this->put(state, drained, -0.09 * this->whole(), this->one);
  this->run(state, [&](int s, Scratch& scratch) {
    bound_volumes(state, state.bodies[0], s, this->counters, scratch);
  });
  EXPECT_EQ(this->volume(state, drained), 0);
  EXPECT_EQ(this->counters.volume_bounds + this->counters.volume_bounds_left, 0);
}

TYPED_TEST(Moves, ThickBodiesMayOvershootALittle) {
  auto state = this->slab(7.9);
  const auto drained = TestFixture::cell(7, 9);
  this->put(state, drained, -0.05 * this->whole(), this->one);
  this->run(state, [&](int s, Scratch& scratch) {
    bound_volumes(state, state.bodies[0], s, this->counters, scratch);
  });
  EXPECT_EQ(this->counters.volume_bounds + this->counters.volume_bounds_left, 0);
  EXPECT_EQ(this->volume(state, drained), -0.05 * this->whole());
}

TYPED_TEST(Moves, ExcessGoesToTheEmptiestCutNeighbour) {
  constexpr int dim = TestFixture::dim;
  auto state = this->slab(7.4);
  const auto swollen = TestFixture::cell(7, 9);
  this->put(state, swollen, 1.2 * this->whole(), this->one);
  auto emptiest = swollen;
  --emptiest[dim - 1];
  if (dim > 1) this->put(state, emptiest, 0.3 * this->whole(), this->one);
  this->run(state, [&](int s, Scratch& scratch) {
    bound_volumes(state, state.bodies[0], s, this->counters, scratch);
  });
  if (dim == 1) {
    EXPECT_EQ(this->counters.volume_bounds_left, 1);  // no other cut cell
    return;
  }
  EXPECT_NEAR(this->volume(state, swollen) / this->whole(), 1, 1e-12);
  EXPECT_NEAR(this->volume(state, emptiest) / this->whole(), 0.5, 1e-12);
  this->expect_uniform(state);
}

TYPED_TEST(Moves, NothingMovesInASettledBody) {
  auto state = this->ball_of(0);
  std::vector<double> before = totals(state, 0);
  update_all(state, 0, [&](int s, Scratch& scratch) {
    auto& body = state.bodies[0];
    empty_outside(state, body, s, 0, this->edges, scratch);
    EXPECT_TRUE(body.at(s).updates.empty());
    fill_inside(state, body, s, this->edges, scratch);
    EXPECT_TRUE(body.at(s).updates.empty());
    bound_volumes(state, body, s, this->counters, scratch);
    EXPECT_TRUE(body.at(s).updates.empty());
  });
  EXPECT_EQ(totals(state, 0), before);
}

/// A block that the surface only comes near to, with nothing in it: it has no cells to look at.
TYPED_TEST(Moves, BlocksWithoutReachAreLeftAlone) {
  auto state = this->ball_of(0);
  this->run(state, [&](int s, Scratch& scratch) {
    auto& body = state.bodies[0];
    body.at(s).reach = {};
    empty_outside(state, body, s, 0, this->edges, scratch);
    fill_inside(state, body, s, this->edges, scratch);
    bound_volumes(state, body, s, this->counters, scratch);
    EXPECT_TRUE(body.at(s).updates.empty());
  });
}

}  // namespace
}  // namespace recoil::moves_test
