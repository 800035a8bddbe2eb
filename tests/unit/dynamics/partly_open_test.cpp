#include "dynamics/partly_open.hpp"

#include <cstddef>
#include <vector>

#include "../core/dimensions.hpp"
#include "../cutcell/bodies.hpp"

namespace recoil::partly_open_test {
namespace {

/// A block of matter without surfaces with velocities from a field u(index).
template <int Dim, class F>
std::vector<double> primitives_of(const Window<Dim>& w, F&& u) {
  const auto n = static_cast<std::size_t>(w.size());
  std::vector<double> values(n * Components<Dim>::primitives, 0.0);
  for_each(w.box(), [&](const Index<Dim>& i) {
    const Vec<Dim> v = u(i);
    for (int d = 0; d < Dim; ++d)
      values[static_cast<std::size_t>(Components<Dim>::u + d) * n + static_cast<std::size_t>(w.at(i))] = v[d];
  });
  return values;
}

template <class D>
struct PartlyOpenFaces : testing::Test {
  static constexpr int dim = D::value;
  const Grid<dim> grid = make_test_grid<dim>(12, 12, Edge::outflow);
  State<dim> state = make_test_state<dim>(grid, {half_space(middle_of(grid), Vec<dim>{{1}})});
  const Window<dim> window{state.mesh, 0, detail::face_reach, state.bodies[0].at(0).matter};
  Index<dim> cell;
  Vec<dim> x;

  PartlyOpenFaces() {
    for (int d = 0; d < dim; ++d) cell[d] = 5;
    x[0] = 0.3;
    x[1] = -0.2;
  }
  /// turning_velocity() at x from the cell.
  template <class F>
  Vec<dim> turning_of(F&& u) {
    auto values = primitives_of<dim>(window, u);
    detail::Work<dim> w{grid, window, state.bodies[0].at(0).matter};
    w.wide = static_cast<std::size_t>(window.size());
    w.primitive = values.data();
    return detail::turning_velocity(w, window.at(cell), x);
  }
};
TYPED_TEST_SUITE(PartlyOpenFaces, PlaneAndSpace);

TYPED_TEST(PartlyOpenFaces, TurnLikeTheMatterButAreNotStrained) {
  constexpr int dim = TestFixture::dim;
  const auto v =
      this->turning_of([](const Index<dim>& i) {  // turns by 3, stretched by 7 and -2, sheared by 0.5
        Vec<dim> u;
        u[0] = 7.0 * i[0] + (0.5 - 3) * i[1];
        u[1] = (0.5 + 3) * i[0] - 2.0 * i[1];
        return u;
      });
  EXPECT_NEAR(v[0], -3 * this->x[1], 1e-12);
  EXPECT_NEAR(v[1], 3 * this->x[0], 1e-12);
}

/// Neighbours that have nothing to do with each other, as in a spray of fragments.
TYPED_TEST(PartlyOpenFaces, DoNotTurnWhereMatterIsTorn) {
  constexpr int dim = TestFixture::dim;
  const auto v = this->turning_of([this](const Index<dim>& i) {
    Vec<dim> u;
    if (i == this->cell) u[1] = 500;
    if (i[0] > this->cell[0]) u[1] = 300;
    return u;
  });
  EXPECT_EQ(norm(v), 0);
}

}  // namespace
}  // namespace recoil::partly_open_test
