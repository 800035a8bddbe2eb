#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "run.hpp"

/// Bodies that lie across or beside a periodic edge: nothing should happen there.
namespace recoil::periodic_edge_test {
namespace {

using config::Geometry;

constexpr double mm = 1e-3, us = 1e-6, dx = 0.25 * mm;
constexpr int period = 48;  // cells

/// A block that strikes a beam, which fills the period; the block begins `moved` cells from the low end.
config::Case striking(int moved) {
  config::Domain domain = domain_of(Geometry::planar, {-6 * mm, -5 * mm, 0}, {6 * mm, 5 * mm, 0});
  domain.boundary[0] = {config::Boundary::periodic, config::Boundary::periodic};
  const double low = -6 * mm + moved * dx;
  return case_of(domain, dx,
                 {body_of("block", box_shape({low, -4 * mm, 0}, {low + 2 * mm, -1.2 * mm, 0}), {0, 300, 0}),
                  body_of("beam", box_shape({-6 * mm, -1 * mm, 0}, {6 * mm, 0.5 * mm, 0}))});
}

/// Mass of a body in every cell of the domain.
std::vector<double> masses(const TestRun<2>& run, int m) {
  const Grid<2>& grid = run.state.grid();
  std::vector<double> all(static_cast<std::size_t>(grid.domain().size()));
  for (int s = 0; s < run.state.mesh.local(); ++s) {
    const BodyBlock<2>& b = run.state.bodies[m].at(s);
    const Box<2> cells = run.state.mesh.block(s).cells;
    for_each(cells, [&](const Index<2>& i) {
      all[static_cast<std::size_t>(grid.domain().at(i))] =
          b.present ? b.contents[static_cast<std::size_t>(grid.layout().at(i - cells.lo))] : 0;
    });
  }
  return all;
}

TEST(PeriodicEdges, ResultsDoNotDependOnWhereTheyAre) {
  constexpr int middle = 20;
  TestRun<2> far(striking(middle), {samples::copper(), samples::copper()});
  while (far.state.time < 1.5 * us) far.steps(1);
  for (const int moved : {-3, 0, 2}) {
    TestRun<2> near(striking(moved), {samples::copper(), samples::copper()});
    while (near.state.time < 1.5 * us) near.steps(1);
    EXPECT_EQ(near.counted().faces_without_value, 0) << moved;
    EXPECT_EQ(near.counted().cuts_without_donor, 0) << moved;
    const Box<2> domain = far.state.grid().domain();
    const double whole = 8960 * dx * dx;
    for (int m = 0; m < 2; ++m) {
      const std::vector<double> there = masses(far, m), here = masses(near, m);
      for_each(domain, [&](Index<2> i) {
        const double expected = there[static_cast<std::size_t>(domain.at(i))];
        i[0] = (i[0] + moved - middle + 2 * period) % period;
        ASSERT_NEAR(here[static_cast<std::size_t>(domain.at(i))], expected, 1e-5 * whole) << moved;
      });
    }
  }
}

}  // namespace
}  // namespace recoil::periodic_edge_test
