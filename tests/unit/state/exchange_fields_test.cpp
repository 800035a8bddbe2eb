#include "state/exchange_fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../core/dimensions.hpp"
#include "../mesh/grids.hpp"

namespace recoil {
namespace {

/// Run by mpirun with two and three processes.
template <class D>
struct MpiExchange : testing::Test {
  static constexpr int dim = D::value;
  void SetUp() override {
    if (!several_processes()) GTEST_SKIP() << "for mpirun";
    start_parallel();
  }

  /// A deformable and a rigid body in the even blocks, with numbers that tell the block.
  static State<dim> make() {
    const Grid<dim> grid = make_test_grid<dim>(40, 10, Edge::outflow, true);
    State<dim> state{make_test_mesh(grid), {}, {}, {}};
    for (const bool rigid : {false, true}) {
      Body<dim>& body = state.bodies.emplace_back();
      if (rigid) body.rigid.emplace();
      body.blocks.resize(static_cast<std::size_t>(state.mesh.slots()));
      for (int s = 0; s < state.mesh.local(); ++s) {
        const long order = state.mesh.block(s).order;
        if (order % 2 != 0) continue;
        enter_block(body, s, grid);
        fill(body.at(s), order, rigid);
      }
    }
    return state;
  }
  static void fill(BodyBlock<dim>& b, long order, bool rigid) {
    const auto number = static_cast<double>(order);
    std::fill(b.phi.begin(), b.phi.end(), 0.5 + number);
    std::fill(b.phi_midstep.begin(), b.phi_midstep.end(), 0.25 + number);
    b.geometry.cuts.resize(static_cast<std::size_t>(order % 5));  // blocks send different amounts
    for (CutCell<dim>& cut : b.geometry.cuts) cut.volume = 3 + number;
    b.near_surface = order % 4 == 0;
    if (rigid) return;
    b.walls.resize(b.geometry.cuts.size());
    for (Wall<dim>& w : b.walls) w.traction = -1 - number;
    std::fill(b.contents.begin(), b.contents.end(), 2 + number);
    std::fill(b.contact.begin(), b.contact.end(), static_cast<std::uint32_t>(order));
  }
};
TYPED_TEST_SUITE(MpiExchange, Dimensions);

TYPED_TEST(MpiExchange, CopiesHoldWhatTheirOwnersHave) {
  constexpr int dim = TestFixture::dim;
  State<dim> state = TestFixture::make();
  const parallel::World world;
  exchange_fields(state, world,
                  Field::phi | Field::phi_midstep | Field::contents | Field::volume | Field::geometry |
                      Field::walls | Field::contact);
  ASSERT_GT(state.mesh.slots(), state.mesh.local()) << "there are copies";
  int held = 0;
  for (int s = state.mesh.local(); s < state.mesh.slots(); ++s)
    for (const bool rigid : {false, true}) {
      const long order = state.mesh.block(s).order;
      const auto number = static_cast<double>(order);
      const BodyBlock<dim>& b = state.bodies[rigid ? 1 : 0].at(s);
      ASSERT_EQ(b.present, order % 2 == 0) << order;
      if (!b.present) continue;
      ++held;
      EXPECT_EQ(b.near_surface, order % 4 == 0);
      EXPECT_EQ(b.phi.raw(), std::vector<double>(b.phi.size(), 0.5 + number));
      EXPECT_EQ(b.phi_midstep.raw(), std::vector<double>(b.phi.size(), 0.25 + number));
      ASSERT_EQ(b.geometry.cuts.size(), static_cast<std::size_t>(order % 5));
      for (const CutCell<dim>& cut : b.geometry.cuts) EXPECT_EQ(cut.volume, 3 + number);
      if (rigid) {
        EXPECT_TRUE(b.contents.empty());
        continue;
      }
      ASSERT_EQ(b.walls.size(), b.geometry.cuts.size());
      for (const Wall<dim>& w : b.walls) EXPECT_EQ(w.traction, -1 - number);
      EXPECT_EQ(b.contents.raw(), std::vector<double>(b.contents.size(), 2 + number));
      for (const std::uint32_t bits : b.contact) EXPECT_EQ(bits, static_cast<std::uint32_t>(order));
    }
  std::vector<std::int64_t> all{held};
  world.sum(all);
  EXPECT_GT(all[0], 0);
}

/// Only what is asked for goes over; a body that has left its block leaves the copies as well.
TYPED_TEST(MpiExchange, FieldsAndPresence) {
  constexpr int dim = TestFixture::dim;
  State<dim> state = TestFixture::make();
  const parallel::World world;
  exchange_fields(state, world, Field::phi);
  for (int s = state.mesh.local(); s < state.mesh.slots(); ++s) {
    const BodyBlock<dim>& b = state.bodies[0].at(s);
    if (!b.present) continue;
    EXPECT_EQ(b.phi[0], 0.5 + static_cast<double>(state.mesh.block(s).order));
    EXPECT_EQ(b.contents.raw(), std::vector<double>(b.contents.size(), 0.0)) << "not asked for";
    EXPECT_TRUE(b.geometry.cuts.empty());
  }
  for (int s = 0; s < state.mesh.local(); ++s) leave_block(state.bodies[0], s);
  exchange_fields(state, world, Field::contents | Field::volume);
  for (int s = state.mesh.local(); s < state.mesh.slots(); ++s) {
    EXPECT_FALSE(state.bodies[0].present(s));
    EXPECT_EQ(state.bodies[1].present(s), state.mesh.block(s).order % 2 == 0);
  }
}

}  // namespace
}  // namespace recoil
