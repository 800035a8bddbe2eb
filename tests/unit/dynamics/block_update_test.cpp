#include "dynamics/block_update.hpp"

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "../core/dimensions.hpp"
#include "../cutcell/bodies.hpp"
#include "dynamics/primitives.hpp"
#include "kernels/row_kernels.hpp"

namespace recoil::block_update_test {
namespace {

/// State of every cell of a body that fills the domain, from its place.
template <int Dim>
using Field = std::function<Primitives<Dim>(const Vec<Dim>&)>;

template <int Dim>
struct Bulk {
  State<Dim> state;
  Counters counters;
  std::vector<ExactEdgeAccount<Dim>> edges;

  Bulk(const Grid<Dim>& grid, const Material& material, const Field<Dim>& field)
      : state(make_test_state<Dim>(grid, {[](const Vec<Dim>&) { return -100.0; }}, material)),
        edges(static_cast<std::size_t>(state.mesh.local())) {
    cut_all(state);
    for (auto& b : state.bodies[0].blocks) b.near_surface = false;
    for_each_piece(state, 0, [&](auto& b, const Index<Dim>& i, std::size_t k) {
      set_piece(b, k, grid.full_volume(i), per_volume<Dim>(material, field(grid.centre(i))));
    });
    for (int s = 0; s < state.mesh.local(); ++s) choose_roles(state, state.bodies[0], s, counters);
  }
  /// One Euler substage of all blocks.
  void update(double dt, FaceTime faces = FaceTime::now) {
    Scratch scratch;
    for (int s = 0; s < state.mesh.local(); ++s) {
      average_primitives(state, state.bodies[0], s, counters);
      state.bodies[0].at(s).stencil.swap(state.bodies[0].at(s).average);  // no surface: they are the same
    }
    for (int s = 0; s < state.mesh.local(); ++s) {
      const Scratch::Frame frame(scratch);
      update_block(state, state.bodies[0], s, faces, dt, 1, edges[s], counters, scratch);
    }
  }
  /// Calls f(index, change of its contents per volume and time) for all cells at least `away` from the edges.
  template <class F>
  void rates(double dt, int away, F&& f) {
    std::vector<std::vector<double>> before;
    for (const auto& b : state.bodies[0].blocks) before.push_back(b.contents.raw());
    update(dt);
    const Box<Dim> inner = state.grid().domain().grown(-away);
    for (int s = 0; s < state.mesh.local(); ++s) {
      const auto& b = state.bodies[0].at(s);
      const Box<Dim> cells = state.mesh.block(s).cells;
      for_each(cells, [&](const Index<Dim>& i) {
        if (!inner.contains(i)) return;
        const auto k = static_cast<std::size_t>(state.grid().layout().at(i - cells.lo));
        Contents<Dim> rate{};
        for (std::size_t c = 0; c < rate.size(); ++c) {
          const std::size_t at = c * b.volume.size() + k;
          rate[c] = (b.contents[at] - before[s][at]) / (dt * state.grid().full_volume(i));
        }
        f(i, rate);
      });
    }
  }
};

template <class D>
struct BlockUpdate : testing::Test {
  static constexpr int dim = D::value;
  using C = Components<dim>;
  Material material = samples::copper();
  Primitives<dim> base = some_primitives<dim>(material);
};
TYPED_TEST_SUITE(BlockUpdate, Dimensions);

TYPED_TEST(BlockUpdate, AUniformBodyStaysAsItIsToTheLastBit) {
  constexpr int dim = TestFixture::dim;
  for (const Edge edge : {Edge::periodic, Edge::outflow}) {
    Bulk<dim> bulk(make_test_grid<dim>(20, 10, edge, true), this->material,
                   [this](const Vec<dim>&) { return this->base; });
    const auto before = bulk.state.bodies[0].at(0).contents;
    for (int n = 0; n < 10; ++n) bulk.update(1e-6);
    EXPECT_EQ(bulk.state.bodies[0].at(0).contents, before);
    EXPECT_EQ(bulk.counters.first_order_faces, 0);
  }
}

/// Noise of rounding, in a part of what AtRest calls so, moves nothing; beside matter that moves all is
/// conserved, and it goes no farther than stencils reach.
TYPED_TEST(BlockUpdate, MatterAtRestStaysAsItIsToTheLastBit) {
  constexpr int dim = TestFixture::dim;
  using C = typename TestFixture::C;
  const detail::AtRest rest(AnyEos{this->material.eos});
  Random random(3);
  for (const FaceTime faces : {FaceTime::now, FaceTime::midstep})
    for (const double moving : {0.0, 1.0}) {
      Bulk<dim> bulk(make_test_grid<dim>(20, 10, Edge::periodic, true), this->material,
                     [&](const Vec<dim>& x) {
                       Primitives<dim> w{};
                       w[C::rho] = density(this->material);
                       for (int d = 0; d < dim; ++d) w[C::u + d] = random(-0.05, 0.05) * rest.speed;
                       w[C::p] = random(-0.05, 0.05) * rest.stress;
                       for (int s = 0; s < C::stresses; ++s) w[C::s + s] = random(-0.05, 0.05) * rest.stress;
                       if (std::abs(x[0] - 2.25) < 0.25) w[C::u] += moving;  // cells 12 and 13 of 20
                       return w;
                     });
      std::vector<std::vector<double>> before;
      for (const auto& block : bulk.state.bodies[0].blocks) before.push_back(block.contents.raw());
      const auto sums = totals(bulk.state, 0);
      bulk.update(1e-6, faces);
      int changed = 0;
      for_each_piece(bulk.state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
        const auto slot = static_cast<std::size_t>(&b - bulk.state.bodies[0].blocks.data());
        bool same = true;
        for (std::size_t c = k; c < b.contents.size(); c += b.volume.size())
          same = same && b.contents[c] == before[slot][c];
        if (same) return;
        ++changed;
        EXPECT_TRUE(i[0] >= 12 - 3 && i[0] <= 13 + 3) << "no farther than stencils reach";
      });
      EXPECT_EQ(changed > 0, moving > 0);
      for (const std::size_t c : {std::size_t{C::rho}, std::size_t{C::energy}}) {
        const double scale = c == C::rho || moving > 0 ? std::abs(sums[c]) : 1;
        EXPECT_NEAR(totals(bulk.state, 0)[c], sums[c], 1e-13 * scale);
      }
    }
}

TYPED_TEST(BlockUpdate, PeriodicBodiesConserve) {
  constexpr int dim = TestFixture::dim;
  Bulk<dim> bulk(make_test_grid<dim>(20, 10, Edge::periodic, true), this->material,
                 [this](const Vec<dim>& x) {
                   auto w = this->base;
                   for (double& v : w) v *= 1 + 0.01 * std::sin(1.7 * x[0] + 0.3 * x[dim - 1]);
                   return w;
                 });
  const auto before = totals(bulk.state, 0);
  for (int n = 0; n < 3; ++n) bulk.update(1e-6);
  const auto after = totals(bulk.state, 0);
  for (const std::size_t c : {std::size_t{0}, std::size_t{1}, std::size_t{TestFixture::C::energy},
                              std::size_t{TestFixture::C::ep}, std::size_t{TestFixture::C::temperature_rise}})
    EXPECT_NEAR(after[c] / before[c], 1, 1e-13) << c;
}

/// Vapour may lack volume deep within a body. A block that no surface is near has to know of such cells in
/// the block beside it as that one does, or the two would find two fluxes through their common faces.
TYPED_TEST(BlockUpdate, BothSidesOfABorderKnowCellsThatAreNotRegular) {
  constexpr int dim = TestFixture::dim;
  Random random(12);
  const auto field = [&](const Vec<dim>&) {
    Primitives<dim> w = this->base;
    w[0] *= random(0.95, 1.05);
    w[1] = random(-300, 300);
    return w;
  };
  for (const FaceTime faces : {FaceTime::now, FaceTime::midstep}) {
    Bulk<dim> bulk(make_test_grid<dim>(20, 10, Edge::periodic, true), this->material, field);
    auto& beside = bulk.state.bodies[0].at(0);
    beside.near_surface = true;
    for (auto& role : beside.role)
      if (random(0, 1) < 0.5) role = donates | valued;
    const auto before = totals(bulk.state, 0);
    bulk.update(1e-8, faces);
    const auto after = totals(bulk.state, 0);
    EXPECT_NEAR(after[0] / before[0], 1, 1e-14);
    EXPECT_NEAR(after[TestFixture::C::energy] / before[TestFixture::C::energy], 1, 1e-14);
  }
}

/// What leaves a domain with open edges is booked.
TYPED_TEST(BlockUpdate, TheEdgesBookWhatPasses) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  Bulk<dim> bulk(make_test_grid<dim>(20, 10, Edge::outflow), this->material, [this](const Vec<dim>& x) {
    auto w = this->base;
    for (double& v : w) v *= 1 + 0.01 * std::sin(1.7 * x[0] + 0.3 * x[dim - 1]);
    return w;
  });
  const auto before = totals(bulk.state, 0);
  for (int n = 0; n < 3; ++n) bulk.update(1e-6);
  const auto after = totals(bulk.state, 0);
  ExactAccount<dim> sum;
  for (const auto& e : bulk.edges) sum += e;
  const Account<dim> left = sum.value();
  EXPECT_GT(std::abs(left.mass), 1e-6 * before[0]);
  EXPECT_NEAR(after[0] + left.mass, before[0], 1e-13 * before[0]);
  EXPECT_NEAR(after[C::energy] + left.energy, before[C::energy], 1e-12 * std::abs(before[C::energy]));
  for (int d = 0; d < dim; ++d) {
    const auto c = static_cast<std::size_t>(C::u + d);
    EXPECT_NEAR(after[c] + left.momentum[d], before[c], 1e-12 * std::abs(before[c]));
  }
}

/// u = A x with uniform density and stress: d(rho S)/dt = 2 G rho dev D + rho (W S - S W) - rho S tr A. The
/// rigid rotation among them keeps the equivalent stress: the spin terms must be there, and with the right
/// sign.
TYPED_TEST(BlockUpdate, LinearMotionStretchesAndTurnsTheStress) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  Random random(12);
  for (const bool rotation : {false, true}) {
    double A[3][3] = {}, S[3][3] = {};
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) A[i][j] = rotation && i >= j ? (i == j ? 0 : -A[j][i]) : random(-2, 2);
    const auto& w = this->base;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        S[i][j] = C::stress(i, j) >= 0 ? w[C::s + C::stress(i, j)] : -w[C::s] - w[C::s + 1];
    double trace = 0;
    for (int i = 0; i < dim; ++i) trace += A[i][i];
    const auto grid = make_test_grid<dim>(14, 7, Edge::outflow, true);
    Bulk<dim> bulk(grid, this->material, [&](const Vec<dim>& x) {
      auto here = w;
      for (int i = 0; i < dim; ++i) {
        here[C::u + i] = 0;
        for (int j = 0; j < dim; ++j) here[C::u + i] += A[i][j] * x[j];
      }
      return here;
    });
    const double g = shear_modulus(this->material), rho = w[0];
    bulk.rates(1e-3, 4, [&](const Index<dim>&, const Contents<dim>& rate) {
      double power = 0;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j) {
          double exact = g * (A[i][j] + A[j][i]) - (i == j ? 2 * g * trace / 3 : 0) - S[i][j] * trace;
          for (int m = 0; m < dim; ++m)
            exact += 0.5 * (A[i][m] - A[m][i]) * S[m][j] - S[i][m] * 0.5 * (A[m][j] - A[j][m]);
          const int c = C::stress(i, j);
          const double found = c >= 0 ? rate[C::s + c] : -rate[C::s] - rate[C::s + 1];
          ASSERT_NEAR(found, rho * exact, 1e-6 * rho * (rotation ? 1e8 : g)) << i << j;
          power += found * S[i][j];
        }
      if (rotation) {
        ASSERT_NEAR(power, 0, 1e-6 * rho * 1e16);
      }
      ASSERT_NEAR(rate[C::rho], -rho * trace, 1e-7 * rho);
    });
  }
}

TYPED_TEST(BlockUpdate, PressureGradientsAccelerate) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  Vec<dim> slope;
  for (int d = 0; d < dim; ++d) slope[d] = 1e8 * (1 - 0.6 * d);
  Bulk<dim> bulk(make_test_grid<dim>(14, 7, Edge::outflow, true), samples::hydro(this->material),
                 [&](const Vec<dim>& x) {
                   Primitives<dim> w{};
                   w[0] = density(this->material);
                   w[C::p] = 1e9 + dot(slope, x);
                   return w;
                 });
  bulk.rates(1e-6, 4, [&](const Index<dim>&, const Contents<dim>& rate) {
    for (int d = 0; d < dim; ++d) ASSERT_NEAR(rate[C::u + d], -slope[d], 2e-3 * norm(slope));
  });
}

struct AxisymmetricUpdate : testing::Test {
  using C = Components<2>;
  Material material = samples::copper();
  Grid<2> grid = make_axisymmetric_grid(20, 20, 10);
  Primitives<2> at_rest() const {
    auto w = some_primitives<2>(material);
    w[C::u] = w[C::u + 1] = 0;
    w[C::s] = w[C::s + 1] = w[C::s + 2] = 0;
    return w;
  }
};

/// S_rr = S_tt = -S_zz/2 and any pressure: no force, up to the axis.
TEST_F(AxisymmetricUpdate, EqualRadialAndHoopStressesAreInEquilibrium) {
  auto w = at_rest();
  w[C::s] = 3e7;
  w[C::s + 1] = -6e7;
  Bulk<2> bulk(grid, material, [&](const Vec<2>&) { return w; });
  bulk.rates(1e-6, 0, [&](const Index<2>&, const Contents<2>& rate) {
    ASSERT_NEAR(rate[C::u] * grid.dx, 0, 1e-10 * w[C::p]);
    ASSERT_NEAR(rate[C::u + 1], 0, 1e-10 * w[C::p]);
    ASSERT_NEAR(rate[C::energy], 0, 1e-6 * w[C::p]);
  });
}

TEST_F(AxisymmetricUpdate, HoopStressPullsInwards) {
  auto w = at_rest();
  w[C::s] = 3e7;
  w[C::s + 1] = -5e7;  // S_tt = 2e7
  Bulk<2> bulk(grid, material, [&](const Vec<2>&) { return w; });
  bulk.rates(1e-6, 1, [&](const Index<2>& i, const Contents<2>& rate) {
    ASSERT_NEAR(rate[C::u] * grid.centre(i)[0] / 1e7, 1, 1e-6);  // (sigma_rr - sigma_tt)/r
  });
}

/// u_r = a r, u_z = b z: D_rr = D_tt = a, D_zz = b, no spin.
TEST_F(AxisymmetricUpdate, ExpansionStretchesAlongTheHoopAsAlongTheRadius) {
  const double a = 3, b = -5, trace = 2 * a + b, g = shear_modulus(material);
  Bulk<2> bulk(grid, material, [&](const Vec<2>& x) {
    auto w = at_rest();
    w[C::u] = a * x[0];
    w[C::u + 1] = b * x[1];
    return w;
  });
  const double rho = at_rest()[0];
  bulk.rates(1e-3, 4, [&](const Index<2>&, const Contents<2>& rate) {
    ASSERT_NEAR(rate[C::s] / (2 * g * rho), a - trace / 3, 1e-6);
    ASSERT_NEAR(rate[C::s + 1] / (2 * g * rho), b - trace / 3, 1e-6);
    ASSERT_NEAR(rate[C::s + 2] / (2 * g * rho), 0, 1e-6);
    ASSERT_NEAR(rate[C::rho] / rho, -trace, 1e-6);
  });
}

/// u_z = c r^2 has D_rz = c r only if the r-column of the gradient is corrected for the widening of the cell.
TEST_F(AxisymmetricUpdate, ShearAlongTheAxis) {
  const double c = 2, g = shear_modulus(material);
  Bulk<2> bulk(grid, material, [&](const Vec<2>& x) {
    auto w = at_rest();
    w[C::u + 1] = c * x[0] * x[0];
    return w;
  });
  bulk.rates(1e-3, 0, [&](const Index<2>& i, const Contents<2>& rate) {
    if (i[0] > 15 || i[1] < 4 || i[1] > 15) return;
    const double r = grid.centre(i)[0], mean = r + grid.dx * grid.dx / (12 * r);  // weighted with r
    ASSERT_NEAR(rate[C::s + 2] / (g * at_rest()[0]) / (2 * c * mean), 1, 0.04) << i[0];
  });
}

}  // namespace
}  // namespace recoil::block_update_test
