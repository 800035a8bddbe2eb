#include "levelset/distance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "../core/dimensions.hpp"
#include "../cutcell/bodies.hpp"

namespace recoil::distance_test {
namespace {

template <class D>
struct Distances : testing::Test {
  static constexpr int dim = D::value;
  Grid<dim> grid = make_test_grid<dim>(24, 12, Edge::outflow);
  double dx = grid.dx, radius = 7.3 * dx;
  Vec<dim> middle = middle_of(grid) + 0.13 * dx * ones();

  static Vec<dim> ones() {
    Vec<dim> x;
    for (int d = 0; d < dim; ++d) x[d] = 1 + 0.3 * d;
    return x;
  }
  /// A function with the zeros of the distance to a ball, but too steep here and too flat there.
  double distorted(const Vec<dim>& x) const {
    return (norm(x - middle) - radius) * (1 + 0.5 * std::sin(2 * (x[0] - middle[0])));
  }
  static void sweep(State<dim>& state, int sweeps, double frozen, double most_nearer = far_cells) {
    Scratch scratch;
    for (int s = 0; s < state.mesh.local(); ++s) {
      const Scratch::Frame frame(scratch);
      redistance(state, state.bodies[0], s, sweeps, frozen, most_nearer, scratch);
    }
    for (auto& b : state.bodies[0].blocks) std::swap(b.phi, b.phi_next);
  }
};
TYPED_TEST_SUITE(Distances, Dimensions);

TYPED_TEST(Distances, RedistancingMakesADistanceWithoutMovingTheSurface) {
  constexpr int dim = TestFixture::dim;
  const double dx = this->dx;
  auto state = make_test_state<dim>(this->grid, {[this](const Vec<dim>& x) { return this->distorted(x); }});
  for (int n = 0; n < 12; ++n) TestFixture::sweep(state, 4, -1);
  double near = 0, far = 0;
  for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    const Vec<dim> x = this->grid.centre(i);
    const double exact = norm(x - this->middle) - this->radius;
    if (norm(x - this->middle) < 2 * dx) return;  // the centre is a kink
    if (std::abs(exact) < 1.5 * dx) near = std::max(near, std::abs(b.phi[k] - exact));
    if (std::abs(exact) < 4 * dx) far = std::max(far, std::abs(b.phi[k] - exact));
  });
  EXPECT_LT(near, 0.04 * dx);
  EXPECT_LT(far, 0.12 * dx);
}

TYPED_TEST(Distances, ADistanceStaysAsItIs) {
  constexpr int dim = TestFixture::dim;
  auto state = make_test_state<dim>(this->grid, {ball(this->middle, this->radius)});
  TestFixture::sweep(state, 4, -1);
  for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    const double exact = norm(this->grid.centre(i) - this->middle) - this->radius;
    if (std::abs(exact) > 2 * this->dx) return;
    ASSERT_NEAR(b.phi[k], exact, 0.03 * this->dx);
  });
}

/// The level set of a fragment that is restored: what is farther than two cells comes nearer step by step.
TYPED_TEST(Distances, ASurfaceThatAppearsComesNearerStepByStep) {
  constexpr int dim = TestFixture::dim;
  const double dx = this->dx, far = far_cells * dx;
  const auto nowhere = [far](const Vec<dim>&) { return far; };
  auto state = make_test_state<dim>(this->grid, {nowhere});
  const Index<dim> at = this->grid.cell_of(this->middle);
  for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    if (i == at) b.phi[k] = -0.4 * dx;
  });
  for (const double least : {far - 0.4 * dx, far - 0.8 * dx, far - 1.2 * dx}) {
    TestFixture::sweep(state, 4, -1, 0.4);
    double nearest = far;
    for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
      if (!(i == at)) nearest = std::min(nearest, b.phi[k]);
    });
    EXPECT_NEAR(nearest, least, 1e-12);
  }
}

TYPED_TEST(Distances, FrozenCellsKeepTheirValueToTheLastBit) {
  constexpr int dim = TestFixture::dim;
  auto state = make_test_state<dim>(this->grid, {[this](const Vec<dim>& x) { return this->distorted(x); }});
  std::vector<double> before;
  for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) { before.push_back(b.phi[k]); });
  TestFixture::sweep(state, 2, 1.6);
  std::size_t n = 0;
  int changed = 0;
  for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
    const double old = before[n++];
    if (std::abs(old) < 1.6 * this->dx) {
      ASSERT_EQ(b.phi[k], old);
    }
    changed += b.phi[k] != old;
    ASSERT_GT(b.phi[k] * old, 0);  // no cell changes sides
  });
  EXPECT_GT(changed, 5);
}

TYPED_TEST(Distances, SweepsInOneGoAreTheSameAsOneByOne) {
  constexpr int dim = TestFixture::dim;
  std::vector<std::vector<double>> found;
  for (const int block : {12, 26}) {
    auto grid = this->grid;
    for (int d = 0; d < dim; ++d) grid.block[d] = block;
    auto state = make_test_state<dim>(grid, {[this](const Vec<dim>& x) { return this->distorted(x); }});
    TestFixture::sweep(state, 3, 1.6);
    std::vector<double> phi(static_cast<std::size_t>(grid.domain().size()));
    for_each_piece(state, 0,
                   [&](auto& b, const Index<dim>& i, std::size_t k) { phi[grid.domain().at(i)] = b.phi[k]; });
    found.push_back(phi);
  }
  EXPECT_EQ(found[0], found[1]);
}

TYPED_TEST(Distances, FootPointsLieOnTheSurface) {
  constexpr int dim = TestFixture::dim;
  const auto mesh = make_test_mesh(this->grid);
  for (int s = 0; s < mesh.local(); ++s) {
    const Window<dim> w(mesh, s, 6);
    std::vector<double> phi(static_cast<std::size_t>(w.size()));
    for_each(w.box(), [&](const Index<dim>& i) {
      phi[w.at(i)] = norm(this->grid.centre(i) - this->middle) - this->radius;
    });
    for_each(w.inner(), [&](const Index<dim>& i) {
      const Vec<dim> x = this->grid.centre(i) - this->middle;
      const double distance = norm(x) - this->radius;
      if (std::abs(distance) > 4.5 * this->dx) return;
      const auto foot = foot_point(this->grid, w.box(), phi.data(), i);
      ASSERT_NEAR(norm(foot.point - this->middle), this->radius, 0.05 * this->dx);
      ASSERT_GT(dot(foot.normal, unit(x)), 0.999);
      ASSERT_NEAR(foot.distance, distance, 0.05 * this->dx);
      ASSERT_LT(norm(this->grid.centre(i) - foot.distance * foot.normal - foot.point), 1e-12);
    });
  }
}

}  // namespace
}  // namespace recoil::distance_test
