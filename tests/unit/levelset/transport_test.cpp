#include "levelset/transport.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <vector>

#include "../core/dimensions.hpp"
#include "../cutcell/bodies.hpp"

namespace recoil::transport_test {
namespace {

constexpr double pi = 3.14159265358979323846;

template <class D>
struct Carrying : testing::Test {
  static constexpr int dim = D::value;
  static Vec<dim> velocity() {
    Vec<dim> u;
    for (int d = 0; d < dim; ++d) u[d] = 100 - 170 * d;
    return u;
  }
  static void set_extension_velocity(State<dim>& state, const Vec<dim>& u) {
    for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
      for (int d = 0; d < dim; ++d)
        b.extension_velocity[static_cast<std::size_t>(d) * b.phi.size() + k] = u[d];
    });
  }
  /// Heun's rule over dt.
  static void step(State<dim>& state, double dt) {
    Scratch scratch;
    for (int s = 0; s < state.mesh.local(); ++s) {
      const Scratch::Frame frame(scratch);
      advect_level_set(state, state.bodies[0], s, dt, &BodyBlock<dim>::phi_next, scratch);
    }
    for (int s = 0; s < state.mesh.local(); ++s) {
      const Scratch::Frame frame(scratch);
      advect_level_set_again(state, state.bodies[0], s, dt, scratch);
    }
  }
  static double length(const Grid<dim>& grid) {
    double sum = 0;
    for (int d = 0; d < dim; ++d) sum += std::abs(velocity()[d]);
    return grid.dx / sum;
  }
};
TYPED_TEST_SUITE(Carrying, Dimensions);

TYPED_TEST(Carrying, APlaneMovesExactly) {
  constexpr int dim = TestFixture::dim;
  const auto grid = make_test_grid<dim>(20, 10, Edge::outflow);
  Random random(3);
  const auto n = unit(random.vector<dim>(-1, 1));
  const auto u = TestFixture::velocity();
  auto state = make_test_state<dim>(grid, {half_space(middle_of(grid), n)});
  TestFixture::set_extension_velocity(state, u);
  const double dt = 0.7 * TestFixture::length(grid);
  TestFixture::step(state, dt);
  const Box<dim> inner = grid.domain().grown(-7);  // away from open edges, where phi is constant beyond
  for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    const double exact = dot(grid.centre(i) - middle_of(grid) - dt * u, n);
    if (!inner.contains(i) || std::abs(exact) > 4 * grid.dx) return;
    ASSERT_NEAR(b.phi[k], exact, 1e-9);
  });
}

TYPED_TEST(Carrying, ABallMovesAsAWhole) {
  constexpr int dim = TestFixture::dim;
  const auto grid = make_test_grid<dim>(26, 13, Edge::outflow);
  const double dx = grid.dx, radius = 7.3 * dx;
  const auto u = TestFixture::velocity();
  auto state = make_test_state<dim>(grid, {ball(middle_of(grid), radius)});
  TestFixture::set_extension_velocity(state, u);
  const double dt = 0.5 * TestFixture::length(grid);
  for (int n = 0; n < 3; ++n) TestFixture::step(state, dt);
  for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    const double exact = norm(grid.centre(i) - middle_of(grid) - 3 * dt * u) - radius;
    if (std::abs(exact) > 2 * dx) return;
    ASSERT_NEAR(b.phi[k], exact, 3e-3 * dx);
  });
}

/// The mean error of u . grad phi for a smooth phi falls with the fifth power of dx.
TYPED_TEST(Carrying, DerivativesAreOfFifthOrder) {
  constexpr int dim = TestFixture::dim;
  const auto u = TestFixture::velocity();
  std::vector<double> error;
  for (const int cells : {16, 32}) {
    auto grid = make_test_grid<dim>(cells, 16, Edge::periodic, true);
    grid.dx = 4.0 / cells;
    const double wave = 2 * pi / 4;
    const auto smooth = [&](const Vec<dim>& x) {
      double sum = 0;
      for (int d = 0; d < dim; ++d) sum += 0.1 * std::sin(wave * x[d] + 0.4 * d);
      return sum;
    };
    auto state = make_test_state<dim>(grid, {smooth});
    TestFixture::set_extension_velocity(state, u);
    Scratch scratch;
    for (int s = 0; s < state.mesh.local(); ++s)
      advect_level_set(state, state.bodies[0], s, 1e-3, &BodyBlock<dim>::phi_next, scratch);
    double sum = 0;
    for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
      double exact = 0;
      for (int d = 0; d < dim; ++d) exact += u[d] * 0.1 * wave * std::cos(wave * grid.centre(i)[d] + 0.4 * d);
      sum += std::abs((b.phi[k] - b.phi_next[k]) / 1e-3 - exact);
    });
    error.push_back(sum / grid.domain().size());
  }
  EXPECT_GT(error[0] / error[1], 22);
}

TYPED_TEST(Carrying, NothingMovesAtRest) {
  constexpr int dim = TestFixture::dim;
  const auto grid = make_test_grid<dim>(20, 10, Edge::outflow);
  auto state = make_test_state<dim>(grid, {ball(middle_of(grid), 5.1 * grid.dx)});
  const auto before = state.bodies[0].blocks[0].phi;
  TestFixture::step(state, 1);
  EXPECT_EQ(state.bodies[0].blocks[0].phi, before);
}

template <class D>
struct FollowingVolume : testing::Test {
  static constexpr int dim = D::value;
  Grid<dim> grid = make_test_grid<dim>(24, 12, Edge::outflow);
  State<dim> state = make_test_state<dim>(grid, {ball(middle_of(grid), 6.3 * grid.dx)});
  Counters counters;

  void SetUp() override { cut_all(state); }
  double phi_by_exact(const Index<dim>& i) const {
    return norm(grid.centre(i) - middle_of(grid)) - 6.3 * grid.dx;
  }
};
TYPED_TEST_SUITE(FollowingVolume, Dimensions);

/// More volume than phi shows: the surface moves outwards, phi falls; only in the band.
TYPED_TEST(FollowingVolume, PhiFollowsTheVolume) {
  constexpr int dim = TestFixture::dim;
  auto& state = this->state;
  const double h = 0.2 * this->grid.dx;
  for (auto& b : state.bodies[0].blocks)
    for (auto& cut : b.end_geometry.cuts) cut.mismatch = h;
  Scratch scratch;
  for (int s = 0; s < state.mesh.local(); ++s) {
    const Scratch::Frame frame(scratch);
    follow_volume(state, state.bodies[0], s, {.rate = 0.1}, scratch);
  }
  for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
    const bool inside = std::abs(b.phi[k]) < 2 * this->grid.dx;  // each step redistances what is farther
    ASSERT_NEAR(b.phi_next[k], b.phi[k] - (inside ? 0.1 * h : 0), 1e-14);
  });
}

/// Debris has no corners to keep: its level sets follow faster.
TYPED_TEST(FollowingVolume, PhiFollowsFailedMatterFaster) {
  constexpr int dim = TestFixture::dim;
  auto& state = this->state;
  const double h = 0.2 * this->grid.dx;
  for (const bool all : {false, true}) {
    for (auto& b : state.bodies[0].blocks)
      for (auto& cut : b.end_geometry.cuts)
        cut.mismatch = h, cut.failed = all || cut.point[0] > middle_of(this->grid)[0];
    Scratch scratch;
    for (int s = 0; s < state.mesh.local(); ++s) {
      const Scratch::Frame frame(scratch);
      follow_volume(state, state.bodies[0], s, {.rate = 0.02, .rate_failed = 0.3}, scratch);
    }
    for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
      if (std::abs(b.phi[k]) >= 2 * this->grid.dx) return;
      const double step = (b.phi[k] - b.phi_next[k]) / h,
                   x = this->grid.centre(i)[0] - middle_of(this->grid)[0];
      if (all || x > 5 * this->grid.dx) {
        ASSERT_NEAR(step, 0.3, 1e-12);
      } else if (x < -5 * this->grid.dx) {
        ASSERT_NEAR(step, 0.02, 1e-12);
      } else {
        ASSERT_GE(step, 0.02 - 1e-12);
        ASSERT_LE(step, 0.3 + 1e-12);
      }
    });
  }
}

/// So do those of a thin piece of matter that can fail, not those of a thick one or of other matter.
TYPED_TEST(FollowingVolume, PhiFollowsFragmentsFaster) {
  const double h = 0.2 * this->grid.dx;
  for (const auto& [radius, may_fail, rate] :
       {std::tuple{1.2, true, 0.3}, {1.2, false, 0.02}, {6.3, true, 0.02}}) {
    auto state =
        make_test_state<TestFixture::dim>(this->grid, {ball(middle_of(this->grid), radius * this->grid.dx)});
    cut_all(state);
    if (may_fail) state.bodies[0].material.damage = TensileDamage{};
    for (auto& b : state.bodies[0].blocks)
      for (auto& cut : b.end_geometry.cuts) cut.mismatch = h;
    Scratch scratch;
    int followed = 0;
    for (int s = 0; s < state.mesh.local(); ++s) {
      const Scratch::Frame frame(scratch);
      follow_volume(state, state.bodies[0], s, {.rate = 0.02, .rate_failed = 0.3}, scratch);
    }
    for_each_piece(state, 0, [&, rate = rate](auto& b, const auto&, std::size_t k) {
      if (b.phi[k] == b.phi_next[k]) return;
      ASSERT_NEAR((b.phi[k] - b.phi_next[k]) / h, rate, 1e-12);
      ++followed;
    });
    EXPECT_GT(followed, 0);
  }
}

/// Where another body is within 1.5 dx, phi takes up at once what the mismatch has grown by beyond 0.005 dx.
TYPED_TEST(FollowingVolume, GrowthIsTakenUpWhereContactMayClose) {
  constexpr int dim = TestFixture::dim;
  const double dx = this->grid.dx, h = 0.03 * dx, rate = 0.02;
  Vec<dim> gap, inwards;
  gap[0] = 7.3 * dx, inwards[0] = -1;  // the other body lies beyond a gap of one cell
  State<dim> state = make_test_state<dim>(
      this->grid, {ball(middle_of(this->grid), 6.3 * dx), half_space(middle_of(this->grid) + gap, inwards)});
  cut_all(state);
  const auto largest_step = [&](double lag, bool beside_bodies) {
    Scratch scratch;
    double largest = 0;
    for (auto& b : state.bodies[0].blocks) {
      for (auto& cut : b.end_geometry.cuts) cut.mismatch = h;
      std::fill(b.lag.begin(), b.lag.end(), lag);
    }
    for (int s = 0; s < state.mesh.local(); ++s) {
      const Scratch::Frame frame(scratch);
      follow_volume(state, state.bodies[0], s, {.rate = rate, .growth_beside_bodies = beside_bodies},
                    scratch);
    }
    for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
      const double step = b.phi[k] - b.phi_next[k];
      largest = std::max(largest, step);
      const bool followed = std::abs(b.phi[k]) < 2 * dx;
      const double to_other = middle_of(this->grid)[0] + gap[0] - this->grid.centre(i)[0];
      if (to_other > 1.5 * dx) {
        ASSERT_NEAR(step, followed ? rate * h : 0, 1e-14);
      }
      ASSERT_NEAR(b.lag[k], followed ? h - step : far_cells * dx, 1e-14);
    });
    return largest;
  };
  EXPECT_NEAR(largest_step(0.01 * dx, true), rate * h + 0.015 * dx, 1e-14);   // 0.02 - 0.005
  EXPECT_NEAR(largest_step(-0.02 * dx, true), rate * h + 0.025 * dx, 1e-14);  // not beyond V: 0.03 - 0.005
  EXPECT_NEAR(largest_step(0.026 * dx, true), rate * h, 1e-14);               // as corners do
  EXPECT_NEAR(largest_step(far_cells * dx, true), rate * h, 1e-14);           // not known before
  EXPECT_NEAR(largest_step(0.01 * dx, false), rate * h, 1e-14);
  for (auto& body : state.bodies) body.material.eos = IdealGas{.rho0 = 1.2, .gamma = 1.4, .p0 = 1e5};
  EXPECT_NEAR(largest_step(0.01 * dx, true), rate * h, 1e-14);
}

TYPED_TEST(FollowingVolume, TheWallsVelocityIsSpreadOverTheBand) {
  constexpr int dim = TestFixture::dim;
  auto& state = this->state;
  Vec<dim> u;
  for (int d = 0; d < dim; ++d) u[d] = 30 - 70 * d;
  for (auto& b : state.bodies[0].blocks) {
    b.walls.assign(b.geometry.cuts.size(), {});
    for (auto& w : b.walls) w.mean_velocity = u;
  }
  const double dt = 0.9 * this->grid.dx / norm(u);
  Scratch scratch;
  for (const double length : {dt, 2 * dt}) {
    for (int s = 0; s < state.mesh.local(); ++s) {
      const Scratch::Frame frame(scratch);
      spread_wall_velocity(state, state.bodies[0], s, length, this->counters, scratch);
    }
    const double capped = length > dt ? this->grid.dx / (length * norm(u)) : 1;
    for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
      const bool inside = std::abs(b.phi[k]) < carried_cells * this->grid.dx;
      for (int d = 0; d < dim; ++d)
        ASSERT_NEAR(b.extension_velocity[static_cast<std::size_t>(d) * b.phi.size() + k],
                    inside ? capped * u[d] : 0, 1e-11);
    });
    EXPECT_EQ(this->counters.capped_speeds > 0, length > dt);
  }
}

/// A level set that has swallowed a rigid ball gives it back, but for a tenth of a cell.
TYPED_TEST(FollowingVolume, RigidBodiesAreCutOut) {
  constexpr int dim = TestFixture::dim;
  const auto middle = middle_of(this->grid);
  const double dx = this->grid.dx;
  const auto inner = ball(middle, 3.3 * dx), outer = ball(middle, 7.1 * dx);
  auto state = make_test_state<dim>(this->grid, {outer, inner});
  state.bodies[1].rigid.emplace().distance = inner;
  for (int s = 0; s < state.mesh.local(); ++s) {
    state.bodies[0].at(s).near_surface = true;
    cut_out_rigid(state, state.bodies[0], s);
  }
  for_each_piece(state, 0, [&](BodyBlock<dim>& b, const Index<dim>& i, std::size_t k) {
    const auto x = this->grid.centre(i);
    const double far = far_cells * dx;
    ASSERT_NEAR(b.phi[k], std::clamp(std::max(outer(x), -inner(x) - 0.1 * dx), -far, far), 1e-12);
  });
}

TYPED_TEST(FollowingVolume, RigidBodiesAreWhereTheirMotionPutsThem) {
  constexpr int dim = TestFixture::dim;
  auto& state = this->state;
  Vec<dim> u;
  u[0] = 20;
  state.bodies[0].rigid.emplace().distance = ball(middle_of(this->grid), 6.3 * this->grid.dx);
  set_moving(*state.bodies[0].rigid, u, {});
  const double time = 2.6 * this->grid.dx / u[0];
  for (int s = 0; s < state.mesh.local(); ++s) place_rigid(state, state.bodies[0], s, time, PhiAt::midstep);
  for_each_piece(state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
    const double exact = norm(this->grid.centre(i) - middle_of(this->grid) - time * u) - 6.3 * this->grid.dx;
    ASSERT_NEAR(b.phi_midstep[k], std::min(exact, far_cells * this->grid.dx), 1e-13);
    ASSERT_NEAR(b.phi[k], std::min(this->phi_by_exact(i), far_cells * this->grid.dx), 1e-13);
  });
}

}  // namespace
}  // namespace recoil::transport_test
