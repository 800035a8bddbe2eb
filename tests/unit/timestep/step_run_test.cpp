#include "timestep/step_run.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <type_traits>
#include <vector>

#include "../core/dimensions.hpp"
#include "../cutcell/bodies.hpp"
#include "../parallel/session.hpp"
#include "core/error.hpp"

namespace recoil::step_run_test {
namespace {

template <class D>
struct StepRuns : testing::Test {
  static constexpr int dim = D::value;
  Grid<dim> grid = make_test_grid<dim>(16, 8, Edge::outflow);
  State<dim> state = make_test_state<dim>(grid, {ball<dim>(middle_of(grid), 4 * grid.dx)});
  parallel::World world;
  parallel::Team team{1};
  Engine engine{world, team, {}};
};
TYPED_TEST_SUITE(StepRuns, Dimensions);

TYPED_TEST(StepRuns, WhatAPhaseWritesIsStaleUntilAPhaseReadsItAround) {
  constexpr int dim = TestFixture::dim;
  StepRun<dim> step(this->state, this->engine);
  constexpr FieldAccess writes{"writes", {}, {}, Field::phi | Field::volume},
      reads{"reads", Field::phi, {}, {}};
  step.for_each_body(StepPhase::moves, writes, [](Body<dim>&, int, Scratch&) {});
  EXPECT_EQ(this->state.stale, Field::phi | Field::volume);
  step.for_each_body(StepPhase::moves, reads, [](Body<dim>&, int, Scratch&) {});
  EXPECT_EQ(this->state.stale, FieldSet(Field::volume));
}

/// Two phases that each read around their block what the one before wrote, put off: with threads they run
/// when asked for, without at once, and give the same.
TYPED_TEST(StepRuns, PhasesThatAreQueuedGiveWhatPhasesAtOnceGive) {
  constexpr int dim = TestFixture::dim;
  const Grid<dim> grid = make_test_grid<dim>(dim == 3 ? 24 : 64, 8, Edge::outflow);
  const auto found = [&](int threads, std::size_t least_work) {
    State<dim> state =
        make_test_state<dim>(grid, {ball<dim>(middle_of(grid), 0.45 * grid.cells[0] * grid.dx)});
    parallel::Team team(threads);
    Engine engine{this->world, team, {}};
    engine.least_work = least_work;
    StepRun<dim> step(state, engine);
    // Takes the first value of all blocks around.
    const auto take = [&step](FieldArray<double> BodyBlock<dim>::*from,
                              FieldArray<double> BodyBlock<dim>::*to) {
      return [&step, from, to](Body<TestFixture::dim>& body, int slot, Scratch&) {
        double sum = slot;
        for (const int s : step.state().mesh.block(slot).neighbour)
          if (s >= 0 && body.present(s)) sum = 0.5 * sum + (body.at(s).*from)[0];
        (body.at(slot).*to)[0] = sum;
      };
    };
    static constexpr FieldAccess there{"there", Field::volume, {}, Field::phi},
        back{"back", Field::phi, {}, Field::volume};
    for (int k = 0; k < 5; ++k) {
      step.queue_each_body(StepPhase::moves, there, take(&BodyBlock<dim>::volume, &BodyBlock<dim>::phi));
      step.queue_each_body(StepPhase::moves, back, take(&BodyBlock<dim>::phi, &BodyBlock<dim>::volume));
    }
    step.run_queued();
    std::vector<double> values;
    for (const int slot : step.blocks())
      if (state.bodies[0].present(slot)) values.push_back(state.bodies[0].at(slot).volume[0]);
    return values;
  };
  const std::vector<double> one = found(1, 0);
  EXPECT_EQ(found(3, 0), one);
  EXPECT_EQ(found(3, 1000000), one) << "too little work to share";
}

TYPED_TEST(StepRuns, DebugBuildsStopAPhaseThatTouchesWhatItHasNotDeclared) {
#ifdef NDEBUG
  GTEST_SKIP() << "not a debug build";
#else
  constexpr int dim = TestFixture::dim;
  StepRun<dim> step(this->state, this->engine);
  constexpr FieldAccess access{"a phase", {}, Field::volume, Field::role};
  const auto touch = [&](auto&& f) {
    step.for_each_body(StepPhase::moves, access,
                       [&](Body<dim>& body, int slot, Scratch&) { f(body.at(slot)); });
  };
  EXPECT_NO_THROW(touch([](BodyBlock<dim>& b) { b.role[0] = b.volume[0] > 0 ? 1 : 0; }));
  EXPECT_THROW(touch([](BodyBlock<dim>& b) { b.role[0] = b.phi[0] > 0 ? 1 : 0; }), InternalError);
  EXPECT_DEATH(touch([](BodyBlock<dim>& b) { b.volume[0] += 1; }), "changed the field 'volume'");
#endif
}

/// Run by mpirun with several processes.
template <class D>
struct MpiStepRuns : StepRuns<D> {
  static constexpr int dim = D::value;
  using Values = FieldArray<double> BodyBlock<dim>::*;
  void SetUp() override {
    if (!several_processes()) GTEST_SKIP() << "for mpirun";
  }
  static State<dim> make() {
    const Grid<dim> grid = make_test_grid<dim>(dim == 3 ? 24 : 64, 8, Edge::outflow);
    return make_test_state<dim>(grid, {ball<dim>(middle_of(grid), 0.45 * grid.cells[0] * grid.dx)});
  }
  /// Takes the first value of all blocks around.
  static void take(const State<dim>& state, Body<dim>& body, int slot, Values from, Values to) {
    double sum = static_cast<double>(state.mesh.block(slot).order);
    for (const int s : state.mesh.block(slot).neighbour)
      if (s >= 0 && body.present(s)) sum = 0.5 * sum + (body.at(s).*from).raw()[0];
    (body.at(slot).*to).raw()[0] = sum;
  }
  static std::vector<double> first_values(const State<dim>& state) {
    std::vector<double> values;
    for (int slot = 0; slot < state.mesh.local(); ++slot)
      if (state.bodies[0].present(slot)) values.push_back(state.bodies[0].at(slot).volume.raw()[0]);
    return values;
  }
};
TYPED_TEST_SUITE(MpiStepRuns, Dimensions);

/// Phases and exchanges in one chain, in which blocks go on while messages travel, give what all blocks give
/// that wait for all messages.
TYPED_TEST(MpiStepRuns, ExchangesInAChainBringWhatExchangesAtOnceBring) {
  using This = TestFixture;
  constexpr int dim = This::dim;
  using Block = BodyBlock<dim>;
  State<dim> at_once = This::make();
  for (int k = 0; k < 5; ++k)
    for (const bool there : {true, false}) {
      exchange_fields(at_once, this->world, there ? Field::volume : Field::phi);
      for (int slot = 0; slot < at_once.mesh.local(); ++slot)
        if (Body<dim>& body = at_once.bodies[0]; body.present(slot))
          This::take(at_once, body, slot, there ? &Block::volume : &Block::phi,
                     there ? &Block::phi : &Block::volume);
    }
  for (const int threads : {1, 3}) {
    State<dim> state = This::make();
    state.stale = FieldSet::all();
    parallel::Team team(threads);
    Engine engine{this->world, team, {}};
    engine.least_work = 0;
    StepRun<dim> step(state, engine);
    static constexpr FieldAccess there{"there", Field::volume, {}, Field::phi},
        back{"back", Field::phi, {}, Field::volume};
    for (int k = 0; k < 5; ++k) {
      step.queue_each_body(StepPhase::moves, there, [&](Body<dim>& body, int slot, Scratch&) {
        This::take(state, body, slot, &Block::volume, &Block::phi);
      });
      step.queue_each_body(StepPhase::moves, back, [&](Body<dim>& body, int slot, Scratch&) {
        This::take(state, body, slot, &Block::phi, &Block::volume);
      });
    }
    step.run_queued();
    EXPECT_EQ(This::first_values(state), This::first_values(at_once)) << threads;
  }
}

/// The declarations are complete: every field once, with a name of its own, and a memory.
TEST(Fields, AreDeclaredOnce) {
  FieldSet seen;
  int count = 0;
  for_each_field<2>([&](const auto& d) {
    EXPECT_FALSE(seen.has(d.id)) << d.name;
    seen = seen | d.id;
    ++count;
    if (d.lifetime == Lifetime::run) {
      EXPECT_NE(d.coarser, Restriction::finest_only) << d.name;
      EXPECT_NE(d.finer, Prolongation::finest_only) << d.name;
    }
  });
  EXPECT_EQ(count, static_cast<int>(Field::count));
  EXPECT_EQ(seen, FieldSet::all());
  EXPECT_EQ(run_fields<3>(), Field::contents | Field::volume | Field::phi | Field::extension_velocity |
                                 Field::lag | Field::contact);
}

/// What is allocated is what the estimate counts.
TEST(Fields, TakeTheMemoryThatIsEstimated) {
  const Grid<2> grid = make_test_grid<2>(16, 8, Edge::outflow);
  const State<2> state = make_test_state<2>(grid, {half_space<2>(middle_of(grid), Vec<2>{{1, 0}})});
  const BodyBlock<2>& b = state.bodies[0].at(0);
  double bytes = 0;
  for_each_field<2>([&](const auto& d) {
    for_each_array(b.*d.member, [&](const auto& array) {
      using T = typename std::remove_cvref_t<decltype(array)>::value_type;
      if (d.allocated()) bytes += static_cast<double>(array.size() * sizeof(T));
    });
  });
  EXPECT_EQ(bytes, bytes_per_cell<2>({}) * grid.layout().size());
}

}  // namespace
}  // namespace recoil::step_run_test
