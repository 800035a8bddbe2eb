#include "cutcell/surface_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "cutcell/taken_volume.hpp"
#include "dynamics/primitives.hpp"
#include "moves_fixture.hpp"

namespace recoil::surface_exchange_test {
namespace {

template <class D>
struct SurfaceExchange : Moves<D> {};
TYPED_TEST_SUITE(SurfaceExchange, Dimensions);

TYPED_TEST(SurfaceExchange, Conserves) {
  auto state = this->ball_of(0.4);
  this->run(state,
            [&](int s, Scratch& scratch) { exchange_along_surface(state, state.bodies[0], s, scratch); });
  auto uniform = this->ball_of(0);
  Random random(2);
  for_each_piece(uniform, 0, [&](auto& b, const auto&, std::size_t k) {
    if (b.end_geometry.kind[k] != CellKind::cut) return;
    set_piece(b, k, b.volume[k] + 0.2 * random(0, 1) * this->whole(), this->one);
  });
  this->run(uniform,
            [&](int s, Scratch& scratch) { exchange_along_surface(uniform, uniform.bodies[0], s, scratch); });
  this->expect_uniform(uniform);
}

/// Volume may leave a cell in the state of the cell that takes it, but not more plastic strain than is there.
TYPED_TEST(SurfaceExchange, LeavesNoNegativeStrain) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  if (dim == 1) return;
  auto state = this->ball_of(0.1);
  Random random(8);
  for_each_piece(state, 0, [&](BodyBlock<dim>& b, const Index<dim>&, std::size_t k) {
    const std::size_t n = b.volume.size();
    if (b.volume[k] < 0) set_piece(b, k, 0.01 * this->whole(), this->one);
    for (const int c : {C::ep, C::temperature_rise})
      b.contents[static_cast<std::size_t>(c) * n + k] *= random(0, 1) < 0.5 ? 1e-9 : 1;
  });
  for (int sweep = 0; sweep < 20; ++sweep)
    this->run(state,
              [&](int s, Scratch& scratch) { exchange_along_surface(state, state.bodies[0], s, scratch); });
  for_each_piece(state, 0, [&](BodyBlock<dim>& b, const Index<dim>&, std::size_t k) {
    const std::size_t n = b.volume.size();
    for (const int c : {C::ep, C::temperature_rise})
      EXPECT_GE(b.contents[static_cast<std::size_t>(c) * n + k],
                -1e-14 * this->one[static_cast<std::size_t>(c)])
          << k;
  });
}

/// Vapour beside dense matter. In the state of the dense cell it would give more mass than it has, at another
/// velocity.
TYPED_TEST(SurfaceExchange, LeavesThinMatterItsMassAndHeat) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  if (dim == 1) return;
  auto state = this->ball_of(0);
  Random random(8);
  Contents<dim> thin = this->one;
  thin[C::energy] = thin[0] * internal_energy<dim>(thin);
  for (int d = 0; d < dim; ++d) thin[C::u + d] = 0;
  for (double& c : thin) c *= 0.01;
  for_each_piece(state, 0, [&](BodyBlock<dim>& b, const Index<dim>&, std::size_t k) {
    if (b.end_geometry.kind[k] != CellKind::cut || random(0, 1) < 0.7) return;
    set_piece(b, k, std::max(b.volume[k], 0.0) + 0.1 * this->whole(), thin);
  });
  const State<dim> before = state;
  this->run(state,
            [&](int s, Scratch& scratch) { exchange_along_surface(state, state.bodies[0], s, scratch); });
  const double c0 = bulk_sound_speed(state.bodies[0].material),
               least = internal_energy<dim>(thin) - 0.01 * c0 * c0;
  for (int s = 0; s < state.mesh.local(); ++s)
    for_each(state.mesh.block(s).cells, [&](const Index<dim>& i) {
      const auto k = static_cast<int>(this->grid.layout().at(i - state.mesh.block(s).cells.lo));
      const auto was = contents_of(before.bodies[0].at(s), k), is = contents_of(state.bodies[0].at(s), k);
      EXPECT_GE(is[0], 0.5 * was[0]);
      if (is[0] > 0) {
        EXPECT_GE(internal_energy<dim>(is), least);
      }
    });
}

/// It evens out h = (V - V_phi)/A: the sum of A h^2 falls, and nothing moves where h is the same everywhere.
TYPED_TEST(SurfaceExchange, EvensOutWhatPhiLagsBehind) {
  constexpr int dim = TestFixture::dim;
  const double least = 0.02 * this->grid.dx_power(dim - 1);
  const auto sum = [&](State<dim>& state) {
    double h2 = 0;
    for_each_piece(state, 0, [&](auto& b, const auto&, std::size_t k) {
      if (b.end_geometry.kind[k] != CellKind::cut) return;
      const auto& cut = b.end_geometry.cuts[b.end_geometry.index[k]];
      const double d = b.volume[k] - cut.volume;
      h2 += d * d / std::max(norm(cut.surface), least);
    });
    return h2;
  };
  auto state = this->ball_of(0.4);
  const double before = sum(state);
  const auto exchange = [&](State<dim>& s) {
    update_all(s, 0,
               [&](int slot, Scratch& scratch) { exchange_along_surface(s, s.bodies[0], slot, scratch); });
  };
  exchange(state);
  if (dim == 1) {
    EXPECT_EQ(sum(state), before);  // points have no tangent
  } else {
    EXPECT_LT(sum(state), 0.97 * before);
    EXPECT_GT(sum(state), 0.7 * before);
  }
  auto even = this->ball_of(0);
  for_each_piece(even, 0, [&](auto& b, const auto&, std::size_t k) {
    if (b.end_geometry.kind[k] != CellKind::cut) return;
    const auto& cut = b.end_geometry.cuts[b.end_geometry.index[k]];
    set_piece(b, k, cut.volume + 0.1 * this->grid.dx * std::max(norm(cut.surface), least), this->one);
  });
  std::vector<double> volumes;
  for_each_piece(even, 0, [&](auto& b, const auto&, std::size_t k) { volumes.push_back(b.volume[k]); });
  exchange(even);
  std::size_t n = 0;
  for_each_piece(even, 0, [&](auto& b, const auto&, std::size_t k) {
    ASSERT_NEAR(b.volume[k], volumes[n++], 1e-15 * this->whole());
  });
}

}  // namespace
}  // namespace recoil::surface_exchange_test
