#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "prepared.hpp"

namespace recoil::corners_test {
namespace {

/// A square body of 12 cells or a disc as wide, whose cells at the high side of axis 0 have touched another
/// body where `pressed` says so.
template <class Pressed>
Prepared<2> touching(bool square, Pressed&& pressed) {
  const Grid<2> grid = make_test_grid<2>(20, 10, Edge::outflow);
  const Vec<2> middle = middle_of(grid);
  const double half = 6.2 * grid.dx;
  const Distance<2> box = [=](const Vec<2>& x) {
    const double a = std::abs(x[0] - middle[0]) - half, b = std::abs(x[1] - middle[1]) - half;
    return a > 0 && b > 0 ? std::hypot(a, b) : std::max(a, b);
  };
  const Material material = samples::copper();
  Prepared<2> p(grid, {square ? box : ball<2>(middle, half)}, {moving<2>(material, {})}, material);
  p.for_each_wall(0, [&](const Wall<2>&, const CutCell<2>& cut, const Index<2>& i) {
    if (!pressed(grid.centre(i) - middle, half)) return;
    for (int s = 0; s < p.state.mesh.local(); ++s)
      if (p.state.mesh.block(s).cells.contains(i)) p.state.bodies[0].at(s).contact[cut.cell] = 2;
  });
  p.prepare();
  return p;
}

bool on_high_side(const Vec<2>& x, double half) { return x[0] > 0.9 * half; }

TEST(Corners, LieWhereASharpEdgeTouches) {
  auto p = touching(true, on_high_side);
  const Grid<2>& grid = p.state.grid();
  const Vec<2> middle = middle_of(grid);
  int corners = 0;
  p.for_each_wall(0, [&](const Wall<2>& w, const CutCell<2>&, const Index<2>& i) {
    const Vec<2> x = (grid.centre(i) - middle) * (1 / grid.dx);
    const bool beside = x[0] > 5 && std::abs(x[1]) > 5, away = x[0] < 4 || std::abs(x[1]) < 4;
    if (beside) {
      EXPECT_GT(w.corner, 0.9) << x[0] << ' ' << x[1];
    }
    if (away) {
      EXPECT_EQ(w.corner, 0) << x[0] << ' ' << x[1];
    }
    corners += beside ? 1 : 0;
  });
  EXPECT_GE(corners, 2);
}

TEST(Corners, AreNoneWhereNothingTouches) {
  auto p = touching(true, [](const Vec<2>&, double) { return false; });
  p.for_each_wall(0, [](const Wall<2>& w, const CutCell<2>&, const Index<2>&) { EXPECT_EQ(w.corner, 0); });
}

TEST(Corners, AreLittleOnADisc) {
  auto p = touching(false, on_high_side);
  p.for_each_wall(0, [](const Wall<2>& w, const CutCell<2>&, const Index<2>&) { EXPECT_LT(w.corner, 0.3); });
}

}  // namespace
}  // namespace recoil::corners_test
