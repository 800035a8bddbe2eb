#include "moves_fixture.hpp"

/// Moves of volume where another body has a part of the cells.
namespace recoil::moves_room_test {
namespace {

template <class D>
struct MovesBesideAnother : Moves<D> {};
TYPED_TEST_SUITE(MovesBesideAnother, Dimensions);

/// A cell that another body has the rest of takes no more; other cells do.
TYPED_TEST(MovesBesideAnother, TheExchangeAlongASurfaceFillsNoCellBeyondItsRoom) {
  constexpr int dim = TestFixture::dim;
  if (dim == 1) return;
  for (const double room : {0.0, 1e-4}) {
    auto state = this->beside_another(7.4);
    const auto swollen = TestFixture::cell(7, 9);
    auto shared = swollen, open = swollen;
    --shared[dim - 1];
    ++open[dim - 1];
    this->put(state, swollen, 0.8 * this->whole(), this->one);
    this->put(state, shared, (0.6 - room) * this->whole(), this->one, 1);
    this->run(state,
              [&](int s, Scratch& scratch) { exchange_along_surface(state, state.bodies[0], s, scratch); });
    EXPECT_NEAR(this->volume(state, shared) / this->whole(), 0.4 + room, 1e-12);
    EXPECT_GT(this->volume(state, open) / this->whole(), 0.405);
  }
}

/// Also where the other body is present on one side of a block's border alone; run() finds what gets lost.
TYPED_TEST(MovesBesideAnother, BothSidesOfABorderFindTheSameRoom) {
  constexpr int dim = TestFixture::dim;
  if (dim == 1) return;
  auto state = this->beside_another(7.4);
  const auto swollen = TestFixture::cell(7, 10);
  auto shared = swollen;
  --shared[dim - 1];
  this->put(state, swollen, 0.8 * this->whole(), this->one);
  this->put(state, shared, 0.6 * this->whole(), this->one, 1);
  for (int s = 0; s < state.mesh.local(); ++s)
    if (state.mesh.block(s).cells.contains(swollen)) leave_block(state.bodies[1], s);
  this->run(state,
            [&](int s, Scratch& scratch) { exchange_along_surface(state, state.bodies[0], s, scratch); });
  EXPECT_NEAR(this->volume(state, shared) / this->whole(), 0.4, 1e-12);
}

/// The emptiest one that other bodies leave.
TYPED_TEST(MovesBesideAnother, ExcessGoesWhereOtherBodiesLeaveRoom) {
  constexpr int dim = TestFixture::dim;
  if (dim == 1) return;
  auto state = this->beside_another(7.4);
  const auto swollen = TestFixture::cell(7, 9);
  auto emptiest = swollen, roomiest = swollen;
  --emptiest[dim - 1];
  ++roomiest[dim - 1];
  this->put(state, swollen, 1.2 * this->whole(), this->one);
  this->put(state, emptiest, 0.2 * this->whole(), this->one);
  this->put(state, emptiest, 0.7 * this->whole(), this->one, 1);
  this->put(state, roomiest, 0.3 * this->whole(), this->one);
  this->run(state, [&](int s, Scratch& scratch) {
    bound_volumes(state, state.bodies[0], s, this->counters, scratch);
  });
  EXPECT_NEAR(this->volume(state, emptiest) / this->whole(), 0.2, 1e-12);
  EXPECT_NEAR(this->volume(state, roomiest) / this->whole(), 0.5, 1e-12);
}

/// Inward, but where another body has the room there beside it.
TYPED_TEST(MovesBesideAnother, WhatLiesOutsideGoesWhereOtherBodiesLeaveRoom) {
  constexpr int dim = TestFixture::dim;
  if (dim == 1) return;
  auto state = this->beside_another(7.4);
  const auto outside = TestFixture::cell(8, 9), inward = TestFixture::cell(7, 9);
  auto beside = inward;
  ++beside[dim - 1];
  this->put(state, outside, 0.1 * this->whole(), this->one);
  this->put(state, inward, 0.6 * this->whole(), this->one, 1);
  this->put(state, beside, 0.3 * this->whole(), this->one);
  this->run(state, [&](int s, Scratch& scratch) {
    empty_outside(state, state.bodies[0], s, 0, this->edges, scratch);
  });
  EXPECT_EQ(this->volume(state, outside), 0);
  EXPECT_NEAR(this->volume(state, inward) / this->whole(), 0.4, 1e-12);
  EXPECT_NEAR(this->volume(state, beside) / this->whole(), 0.4, 1e-12);
  this->expect_uniform(state);
}

}  // namespace
}  // namespace recoil::moves_room_test
