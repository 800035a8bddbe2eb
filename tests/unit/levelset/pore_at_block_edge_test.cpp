#include <gtest/gtest.h>

#include <cstddef>

#include "../core/dimensions.hpp"
#include "../timestep/run.hpp"

/// A cell that is filled in part, far from every surface, in the last cells of its block.
namespace recoil::pore_at_block_edge_test {
namespace {

constexpr double mm = 1e-3;

template <class D>
struct PoreAtBlockEdge : testing::Test {
  static constexpr int dim = D::value;
};
TYPED_TEST_SUITE(PoreAtBlockEdge, Dimensions);

/// The block beside it is far from every surface, and shares what is in such a cell all the same.
TYPED_TEST(PoreAtBlockEdge, SharesWithTheNextBlockAndLosesNothing) {
  constexpr int dim = TestFixture::dim, block = 16;
  const double dx = 0.1 * mm;
  config::Vector lo{}, hi{}, wide{};
  for (std::size_t d = 0; d < dim; ++d) hi[d] = d == 0 ? 3 * block * dx : block * dx, wide[d] = 1;
  const auto geometry = dim == 1   ? config::Geometry::line
                        : dim == 2 ? config::Geometry::planar
                                   : config::Geometry::space;
  auto c = case_of(domain_of(geometry, lo, hi, config::Boundary::symmetry), dx,
                   {body_of("matter", box_shape({-1, -1, -1}, wide))});
  c.mesh.block = block;
  TestRun<dim> run(c, {samples::copper()});

  Index<dim> pore;
  for (int d = 0; d < dim; ++d) pore[d] = d == 0 ? 2 * block - 1 : block / 2;
  for (int s = 0; s < run.state.mesh.local(); ++s) {
    const Box<dim> cells = run.state.mesh.block(s).cells;
    if (!cells.contains(pore)) continue;
    auto& b = run.state.bodies[0].at(s);
    const auto k = static_cast<std::size_t>(run.state.grid().layout().at(pore - cells.lo));
    b.volume[k] *= 0.3;
    for (std::size_t q = 0; q < Components<dim>::contents; ++q) b.contents[q * b.volume.size() + k] *= 0.2;
  }
  prepare_start(run.state, run.engine);
  const auto before = run.totals(0);
  run.steps(4);
  const auto after = run.totals(0);
  EXPECT_NEAR(after[0], before[0], 1e-13 * before[0]);
  EXPECT_NEAR(after[Components<dim>::energy], before[Components<dim>::energy], 1e-13 * before[0] * 1e6);
}

}  // namespace
}  // namespace recoil::pore_at_block_edge_test
