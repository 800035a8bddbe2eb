#include "interface/fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "../core/dimensions.hpp"
#include "prepared.hpp"

namespace recoil::fit_test {
namespace {

template <class D>
struct Fits : testing::Test {
  static constexpr int dim = D::value;
  using C = Components<dim>;
  Grid<dim> grid = make_test_grid<dim>(20, 10, Edge::outflow);
  Material material = samples::copper();
  Primitives<dim> base = some_primitives<dim>(material);
  Vec<dim> middle = middle_of(grid);

  static Vec<dim> tilted() {
    Vec<dim> n;
    for (int d = 0; d < dim; ++d) n[d] = 1 - 0.45 * d;
    return unit(n);
  }
  Prepared<dim> half() { return {grid, {half_space(middle, tilted())}, {base}}; }

  /// Gives the averages of all donors the values of a field at their centroids.
  template <class F>
  static void set_averages(Prepared<dim>& p, F&& field) {
    for_each_piece(p.state, 0, [&](auto& b, const Index<dim>& i, std::size_t k) {
      auto x = p.state.grid().centre(i);
      if (b.geometry.index[k] >= 0) x += p.state.grid().dx * b.geometry.cuts[b.geometry.index[k]].centroid;
      const Primitives<dim> w = field(x);
      for (std::size_t c = 0; c < w.size(); ++c) b.average[c * b.volume.size() + k] = w[c];
    });
  }
  bool inside(const Index<dim>& i) const { return grid.domain().grown(-4).contains(i); }
};
TYPED_TEST_SUITE(Fits, Dimensions);

TYPED_TEST(Fits, AUniformStateIsFittedExactly) {
  constexpr int dim = TestFixture::dim;
  auto p = this->half();
  p.evaluate();
  int walls = 0;
  p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>&) {
    ++walls;
    ASSERT_GT(w.donors, 0);
    for (std::size_t c = 0; c < Components<dim>::contents; ++c) {
      ASSERT_NEAR(w.value[c], this->base[c], 1e-11 * std::abs(this->base[c])) << c;
      ASSERT_LT(norm(w.gradient[c]), 1e-11 * std::abs(this->base[c]));
    }
  });
  EXPECT_GT(walls, dim == 1 ? 0 : 8);
  EXPECT_EQ(p.counters.cuts_without_donor, 0);
}

TYPED_TEST(Fits, WeightsOfTheMeanSumToOneAndOfTheSlopeToNothing) {
  constexpr int dim = TestFixture::dim;
  auto p = this->half();
  for (const auto& b : p.state.bodies[0].blocks)
    for (const auto& w : b.walls) {
      double mean = 0;
      Vec<dim> slope;
      for (int k = 0; k < w.donors; ++k) {
        const auto& donor = b.donors.parts[w.first_donor + k];
        mean += donor.weight;
        slope += donor.slope_weight;
      }
      ASSERT_NEAR(mean, 1, 1e-13);
      ASSERT_LT(norm(slope), 1e-12);
    }
}

/// The ridge on the gradient's matrix costs some two hundredths of a slope.
TYPED_TEST(Fits, LinearFieldsAreContinuedToTheSurface) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  auto p = this->half();
  Vec<dim> slope;  // of velocity and stress, in units of their own per dx
  for (int d = 0; d < dim; ++d) slope[d] = 1 + 0.5 * d;
  const double unit_u = 3, unit_s = 4e7;
  const auto field = [&](const Vec<dim>& x) {
    auto w = this->base;
    const double s = dot(slope, x - this->middle) * (1 / this->grid.dx);
    for (std::size_t c = C::u; c < C::p; ++c) w[c] += unit_u * s;
    for (std::size_t c = C::p; c < C::ep; ++c) w[c] += unit_s * s;
    return w;
  };
  TestFixture::set_averages(p, field);
  p.evaluate();
  p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>& cut, const Index<dim>& i) {
    if (!this->inside(i)) return;
    const auto exact = field(cut.point);
    for (std::size_t c = C::u; c < C::ep; ++c) {
      const double one = c < C::p ? unit_u : unit_s;
      ASSERT_NEAR(w.value[c], exact[c], 0.05 * one * norm(slope)) << c;
      ASSERT_LT(norm(w.gradient[c] - one * slope), 0.06 * one * norm(slope)) << c;
    }
  });
}

/// Density follows the pressure; plastic strain and heat are means, which never leave the donors' range.
TYPED_TEST(Fits, DensityIsIsentropicAndStrainIsAMean) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  auto p = this->half();
  const auto n = TestFixture::tilted();
  const auto& eos = std::get<MieGruneisen>(this->material.eos);
  const double c2 = eos.sound_speed_squared(this->base[0], this->base[C::p]);
  TestFixture::set_averages(p, [&](const Vec<dim>& x) {
    auto w = this->base;
    const double s = dot(n, x - this->middle) / this->grid.dx;
    w[C::p] += 1e8 * s;
    w[C::rho] += 1e8 * s / c2;
    w[C::ep] += 0.01 * s;
    return w;
  });
  p.evaluate();
  p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>& i) {
    if (!this->inside(i)) return;
    ASSERT_NEAR(w.value[C::rho], this->base[0], 0.1 * 1e8 / c2);
    ASSERT_LT(w.value[C::ep], this->base[C::ep] - 0.002);  // donors lie behind the surface
    ASSERT_GT(w.value[C::ep], this->base[C::ep] - 0.02);
  });
}

TYPED_TEST(Fits, ValuesAreLimitedByTheDonors) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  auto p = this->half();
  const auto n = TestFixture::tilted();
  TestFixture::set_averages(p, [&](const Vec<dim>& x) {  // much steeper at the surface than behind
    auto w = this->base;
    const double s = dot(n, x - this->middle) / this->grid.dx;
    w[C::p] = 1e9 * std::exp(6 * s);
    return w;
  });
  p.evaluate();
  p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>&) {
    ASSERT_GE(w.value[C::p], -0.5 * w.range[C::p] - 1);
    ASSERT_LE(w.value[C::p], 1.5e9 + 1);
  });
}

/// A pressure that curves across a surface at 10 degrees: the fit sees the same layers whatever part of its
/// cell the surface leaves, so that its error is nearly the same everywhere.
TEST(FitsOfASlantedSurface, HardlyDependOnTheCut) {
  using C = Components<2>;
  const Grid<2> grid = make_test_grid<2>(32, 16, Edge::outflow);
  const Material material = samples::copper();
  const Primitives<2> base = some_primitives<2>(material);
  const Vec<2> n{{std::cos(10 * M_PI / 180), std::sin(10 * M_PI / 180)}}, middle = middle_of(grid);
  Prepared<2> p{grid, {half_space(middle, n)}, {base}};
  Fits<std::integral_constant<int, 2>>::set_averages(p, [&](const Vec<2>& x) {
    auto w = base;
    const double s = dot(n, x - middle) / grid.dx;
    w[C::p] = 1e8 * s * s;
    return w;
  });
  p.evaluate();
  double low = 1e300, high = -1e300;
  p.for_each_wall(0, [&](const Wall<2>& w, const CutCell<2>& cut, const Index<2>& i) {
    if (!grid.domain().grown(-6).contains(i) || norm(cut.surface) < 0.5 * grid.dx) return;
    low = std::min(low, w.value[C::p]);
    high = std::max(high, w.value[C::p]);
  });
  EXPECT_LT(high, 0) << "a line through a curve that opens upwards undershoots at its end";
  EXPECT_LT(high - low, 1.2e7) << "a reach of 2.35 cells gives 2.5e7: " << low << ' ' << high;
}

/// A velocity that changes sign from one cut cell of a surface at 45 degrees to the next: a fit as wide as
/// some of its waves does not see it; beside contact the wall of matter that never yields does.
TEST(FitsOfASlantedSurface, AnswerToShortWavesBesideContact) {
  using C = Components<2>;
  const Grid<2> grid = make_test_grid<2>(32, 16, Edge::outflow);
  Material hard = samples::copper();
  hard.strength = Elastic{43e9};
  const auto rest = moving<2>(hard, {});
  const Vec<2> n{{1, 1}}, middle = middle_of(grid) + Vec<2>{{0.5 * grid.dx, 0}};
  const auto largest_with = [&](std::uint32_t touched) {
    Prepared<2> p{grid, {half_space(middle, n), half_space<2>({{0, -1}}, {{0, -1}})}, {rest, rest}, hard};
    p.for_each_body([&](Body<2>& body, int s, Scratch&) {
      for (const auto& cut : body.at(s).geometry.cuts) body.at(s).contact[cut.cell] = touched;
    });
    p.prepare();
    Fits<std::integral_constant<int, 2>>::set_averages(p, [&](const Vec<2>& x) {
      auto w = rest;
      w[C::u] = std::cos(0.5 * M_PI * (x[0] - middle[0] - x[1] + middle[1]) / grid.dx);
      return w;
    });
    p.evaluate();
    double largest = 0;
    p.for_each_wall(0, [&](const Wall<2>& w, const CutCell<2>& cut, const Index<2>& i) {
      if (grid.domain().grown(-6).contains(i) && norm(cut.surface) > 0.5 * grid.dx)
        largest = std::max(largest, std::abs(w.value[C::u]));
    });
    return largest;
  };
  const double wide = largest_with(0), nearest = largest_with(2);
  EXPECT_LT(wide, 0.25);
  EXPECT_GT(nearest, 0.5);
}

/// Beside a plane of symmetry the mirrored donors count with turned velocities.
TEST(FitsAtMirrors, VelocitiesTurnRound) {
  auto grid = make_test_grid<2>(20, 10, Edge::reflect, true);
  const auto base = some_primitives<2>(samples::copper());
  const Vec<2> point{{0, grid.origin[1] + 9.4 * grid.dx}}, up{{0, 1}};
  Prepared<2> p(grid, {half_space(point, up)}, {base});
  using C = Components<2>;
  for_each_piece(p.state, 0, [&](auto& b, const Index<2>& i, std::size_t k) {
    const double x = grid.centre(i)[0] - grid.origin[0];  // odd about the mirror
    b.average[C::u * b.volume.size() + k] = 5 * x / grid.dx;
  });
  p.evaluate();
  int beside = 0;
  p.for_each_wall(0, [&](const Wall<2>& w, const CutCell<2>& cut, const Index<2>& i) {
    if (i[0] > 3) return;
    ++beside;
    ASSERT_NEAR(w.gradient[C::u][0], 5, 0.15);
    ASSERT_NEAR(w.value[C::u], 5 * (cut.point[0] - grid.origin[0]) / grid.dx, 0.15);
    ASSERT_NEAR(w.value[C::u + 1], base[C::u + 1], 1e-9);
  });
  EXPECT_EQ(beside, 4);
}

/// Density follows the pressure at the surface only so far; where it is cut, that is counted.
TYPED_TEST(Fits, WildPressureIsCountedWhereItCutsTheDensity) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  for (const double slope : {1e8, 1e12}) {  // Pa per dx
    auto p = this->half();
    this->set_averages(p, [&](const Vec<dim>& x) {
      auto w = this->base;
      w[C::p] = slope * dot(x - this->middle, this->tilted()) / this->grid.dx;
      return w;
    });
    p.evaluate();
    EXPECT_EQ(p.counters.clamped_fit_densities > 0, slope > 1e10);
    p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>&) {
      ASSERT_LE(w.value[C::rho], 1.6 * this->base[C::rho] * (1 + 1e-12));
      ASSERT_GE(w.value[C::rho], 0.6 * this->base[C::rho] * (1 - 1e-12));
    });
  }
}

/// A gas cannot pull: a pressure that falls to nothing over a few cells ends at a tenth of the lowest
/// donor's, with a density on the isentrope.
TYPED_TEST(Fits, OfAGasHavePressure) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  this->material.eos = samples::of(Jwl{}).front();
  this->material.strength = NoStrength{};
  this->base = {};
  this->base[C::rho] = 100;
  this->base[C::p] = 2e7;
  Prepared<dim> p(this->grid, {half_space(this->middle, this->tilted())}, {this->base}, this->material);
  double lowest = 1e9;
  this->set_averages(p, [&](const Vec<dim>& x) {
    auto w = this->base;
    const double depth = std::max(-dot(x - this->middle, this->tilted()) / this->grid.dx, 0.01);
    w[C::p] = 2e7 * depth * depth * depth;
    lowest = std::min(lowest, w[C::p]);
    return w;
  });
  p.evaluate();
  p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>& i) {
    if (!this->inside(i)) return;
    ASSERT_GE(w.value[C::p], 0.1 * lowest * (1 - 1e-12));
    ASSERT_LT(w.value[C::rho], 100);
    ASSERT_GT(w.value[C::rho], 100 * std::exp(-1.0) * (1 - 1e-12));
  });
  EXPECT_EQ(p.counters.floored_sound_speeds, 0);
}

/// A cut cell with no whole fragment around moves with what it holds. Failed matter with a void, which bears
/// nothing, is counted under a name of its own.
TYPED_TEST(Fits, LonePiecesMoveWithWhatTheyHold) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  for (const double damage : {0.5, 1.0}) {
    auto p = this->half();
    auto q = per_volume<dim>(this->material, this->base);
    for (double& c : q) c *= 0.9;  // expanded
    q[C::damage] = damage * q[C::rho];
    for_each_piece(p.state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
      set_piece(b, k, b.geometry.kind[k] == CellKind::cut ? 0.05 * this->grid.dx_power(dim) : 0, q);
    });
    p.prepare();
    p.evaluate();
    EXPECT_EQ(p.counters.cuts_without_donor > 0, damage < 1);
    EXPECT_EQ(p.counters.cuts_of_dust > 0, damage == 1);
    p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>&) {
      ASSERT_EQ(w.donors, 0);
      for (std::size_t d = 0; d < dim; ++d) ASSERT_NEAR(w.value[1 + d], this->base[1 + d], 1e-10);
      ASSERT_EQ(w.value[C::p], 0);
    });
  }
}

}  // namespace
}  // namespace recoil::fit_test
