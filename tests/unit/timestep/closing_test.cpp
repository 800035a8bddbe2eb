#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

#include "run.hpp"

namespace recoil::closing_test {
namespace {

using config::Geometry;

constexpr double mm = 1e-3, speed = 600;

/// The most that all bodies together hold of a cell, in cells.
double fullest_cell(const State<2>& state) {
  double most = 0;
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    const Box<2> cells = state.mesh.block(slot).cells;
    for_each(cells, [&](const Index<2>& i) {
      const auto k = static_cast<std::size_t>(state.grid(slot).layout().at(i - cells.lo));
      double sum = 0;
      for (const auto& body : state.bodies)
        if (body.present(slot)) sum += body.at(slot).volume[k];
      most = std::max(most, sum / state.grid(slot).full_volume(i));
    });
  }
  return most;
}

/// A disc flattens on a block: the rim of their contact closes at an angle, and runs faster than the disc
/// falls. Level sets that come behind there let the bodies into cells that are full (decision 0062): 1.13
/// cells then.
TEST(Closing, MatterHasRoomWhereContactClosesAtAnAngle) {
  const auto domain = domain_of(Geometry::planar, {-5 * mm, -3 * mm}, {5 * mm, 5 * mm});
  TestRun<2> run(case_of(domain, 0.25 * mm,
                         {body_of("disc", ball_shape({0, 2.55 * mm}, 2.5 * mm), {0, -speed}),
                          body_of("block", box_shape({-4 * mm, -2.5 * mm}, {4 * mm, 0}))}),
                 {samples::copper(), samples::copper()});
  double most = 0;
  while (run.state.time < 2e-6) {
    advance(run.state, run.stepping, 2e-6, run.engine);
    most = std::max(most, fullest_cell(run.state));
  }
  EXPECT_LT(most, 1.1);
  for (const int body : {0, 1}) EXPECT_LT(run.imbalance(body, speed), 1e-11);
}

}  // namespace
}  // namespace recoil::closing_test
