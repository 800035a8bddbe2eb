#include <gtest/gtest.h>

#include <cstddef>

#include "../cutcell/bodies.hpp"
#include "../parallel/session.hpp"
#include "dynamics/inadmissible.hpp"
#include "timestep/conservative_phases.hpp"

namespace recoil::averages_test {
namespace {

/// In a thread that tears many neighbours may be beyond the equation of state at once: those in their middle
/// have no good one within three cells.
TEST(Averages, SevenInadmissibleStatesSideBySide) {
  Material copper = samples::copper();
  copper.eos = LinearEos{8930, 130e9};  // admissible from half of the density at rest on
  const Grid<1> grid = make_test_grid<1>(20, 10, Edge::outflow);
  auto state = make_test_state<1>(grid, {[](const Vec<1>&) { return -100.0; }}, copper);
  cut_all(state);
  const Contents<1> one = per_volume<1>(copper, some_primitives<1>(copper));
  fill_body(state, 0, one);
  for_each_piece(state, 0, [&](BodyBlock<1>& b, const Index<1>& i, std::size_t k) {
    if (i[0] < 7 || i[0] > 13) return;
    Contents<1> thin = one;
    for (double& c : thin) c *= 0.1;
    set_piece(b, k, volume_by_phi(grid, b, i, k), thin);
  });
  const auto before = totals(state, 0);
  start_parallel();
  parallel::World world;
  parallel::Team team{1};
  Engine engine{world, team, {}};
  StepRun<1> step(state, engine);
  step.has_changed(FieldSet::all());
  average_inadmissible_states(step);
  const auto after = totals(state, 0);
  for (std::size_t c = 0; c < after.size(); ++c) EXPECT_NEAR(after[c] / before[c], 1, 1e-13) << c;
  for (int s = 0; s < state.mesh.local(); ++s) {
    Counters counters;
    EXPECT_EQ(mark_inadmissible(state, state.bodies[0], s, counters), 0);
  }
}

}  // namespace
}  // namespace recoil::averages_test
