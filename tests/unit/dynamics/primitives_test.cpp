#include "dynamics/primitives.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "../core/dimensions.hpp"
#include "../cutcell/bodies.hpp"
#include "core/error.hpp"

namespace recoil::primitives_test {
namespace {

template <class D>
struct States : testing::Test {
  static constexpr int dim = D::value;
  using C = Components<dim>;
  Material material = samples::copper();
  Grid<dim> grid = make_test_grid<dim>(12, 6, Edge::outflow);
  Counters counters;

  /// A body that fills the domain, with one state in all cells, as far from its surface as told.
  State<dim> uniform(const Primitives<dim>& w, double cells_from_surface = 4) {
    const double phi = -cells_from_surface * grid.dx;
    auto state = make_test_state<dim>(grid, {[phi](const Vec<dim>&) { return phi; }}, material);
    cut_all(state);
    fill_body(state, 0, per_volume<dim>(material, w));
    return state;
  }
};
TYPED_TEST_SUITE(States, Dimensions);

TYPED_TEST(States, PrimitivesAndContentsAreInverse) {
  constexpr int dim = TestFixture::dim;
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    const auto w = some_primitives<dim>(this->material, seed);
    auto q = per_volume<dim>(this->material, w);
    for (double& c : q) c *= 1e-9;
    const auto back = to_primitives<dim>(std::get<MieGruneisen>(this->material.eos), q, 1e-9);
    for (std::size_t c = 0; c < w.size(); ++c) ASSERT_NEAR(back[c], w[c], 1e-11 * std::abs(w[c])) << c;
  }
}

TYPED_TEST(States, BarotropicBodiesKeepTheRestOfTheirEnergy) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  const LinearEos eos{8930, 130e9};
  Contents<dim> q{};
  q[0] = 9000;
  q[C::u] = 9000 * 50.0;
  q[C::energy] = 9000 * (eos.energy(9000, 0) + 777 + 0.5 * 50 * 50);
  const auto w = to_primitives<dim>(eos, q, 1);
  EXPECT_NEAR(w[C::p], 130e9 * (9000.0 / 8930 - 1), 1e-3);
  EXPECT_NEAR(w[C::extra], 777, 1e-8);
}

TYPED_TEST(States, AveragesOfAllBlocks) {
  constexpr int dim = TestFixture::dim;
  const auto w = some_primitives<dim>(this->material);
  auto state = this->uniform(w);
  for (const bool near_surface : {true, false}) {
    for (int s = 0; s < state.mesh.local(); ++s) {
      state.bodies[0].at(s).near_surface = near_surface;
      choose_roles(state, state.bodies[0], s, this->counters);
      average_primitives(state, state.bodies[0], s, this->counters);
    }
    for_each_piece(state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
      for (std::size_t c = 0; c < Components<dim>::contents; ++c)
        ASSERT_NEAR(b.average[c * b.volume.size() + k], w[c], 1e-11 * std::abs(w[c]));
    });
  }
}

TYPED_TEST(States, RolesFollowTheVolume) {
  constexpr int dim = TestFixture::dim;
  auto state = this->uniform(some_primitives<dim>(this->material));
  auto& b = state.bodies[0].at(0);
  const auto q = per_volume<dim>(this->material, some_primitives<dim>(this->material));
  const double full = this->grid.dx_power(dim);
  struct Row {
    double fill;
    int role;
  };
  for (const Row& r : {Row{1, donates | regular | valued}, Row{0.51, donates | regular | valued},
                       Row{0.49, donates}, Row{0.31, donates}, Row{0.29, 0}, Row{0, 0}, Row{-0.1, 0}}) {
    set_piece(b, 2, r.fill * full, q);
    choose_roles(state, state.bodies[0], 0, this->counters);
    EXPECT_EQ(b.role[2], r.role) << r.fill;
  }
  EXPECT_EQ(this->counters.fragments_too_thin, 0);
  auto thin = q;
  thin[0] *= 1e-4;  // nearly no mass in the volume
  set_piece(b, 2, full, thin);
  choose_roles(state, state.bodies[0], 0, this->counters);
  EXPECT_EQ(b.role[2], 0);
  EXPECT_EQ(this->counters.fragments_too_thin, 1);
}

/// Far from every surface thin matter keeps its value, as in blocks that no surface is near: a cell there
/// without a value would be unknown to the block beside.
TYPED_TEST(States, ThinMatterFarFromSurfacesHasAValue) {
  constexpr int dim = TestFixture::dim;
  const auto w = some_primitives<dim>(this->material);
  auto thin = w;
  thin[0] *= 1e-4;
  for (const double cells : {far_cells - 0.01, far_cells}) {
    auto state = this->uniform(w, cells);
    auto& b = state.bodies[0].at(0);
    b.near_surface = true;
    set_piece(b, 2, this->grid.dx_power(dim), per_volume<dim>(this->material, thin));
    choose_roles(state, state.bodies[0], 0, this->counters);
    average_primitives(state, state.bodies[0], 0, this->counters);
    const bool far = cells >= far_cells;
    EXPECT_EQ(b.role[2], far ? donates | regular | valued : 0);
    EXPECT_EQ(std::abs(b.average[2] / thin[0] - 1) < 1e-12, far);
  }
  EXPECT_EQ(this->counters.fragments_too_thin, 1);
}

/// A donor of which next to nothing is left in its cell keeps its average: so does the rear of a fast body in
/// every step, and that replaces nothing. What has become too dense keeps it as well, and counts.
TYPED_TEST(States, AveragesThatAreKeptAreCounted) {
  constexpr int dim = TestFixture::dim;
  const auto w = some_primitives<dim>(this->material);
  auto state = this->uniform(w);
  auto& b = state.bodies[0].at(0);
  b.near_surface = true;
  choose_roles(state, state.bodies[0], 0, this->counters);
  average_primitives(state, state.bodies[0], 0, this->counters);
  EXPECT_EQ(this->counters.averages_kept, 0);
  const double before = b.average[2];
  auto denser = w;
  denser[0] *= 1.1;
  set_piece(b, 2, 0.05 * this->grid.dx_power(dim), per_volume<dim>(this->material, denser));
  average_primitives(state, state.bodies[0], 0, this->counters);
  EXPECT_EQ(this->counters.averages_kept, 0);
  EXPECT_EQ(b.average[2], before);
  denser[0] *= 10;
  set_piece(b, 2, 0.5 * this->grid.dx_power(dim), per_volume<dim>(this->material, denser));
  average_primitives(state, state.bodies[0], 0, this->counters);
  EXPECT_EQ(this->counters.averages_kept, 1);
  EXPECT_EQ(this->counters.fragments_too_thin, 0);
  EXPECT_EQ(b.average[2], before);
}

/// Within a step a fragment whose contents have no average has that of the start: what `average` holds by
/// then are values of stencils. So has one whose volume was below zero before it was mixed with that of the
/// start.
TYPED_TEST(States, WithinAStepTheAverageOfTheStartStands) {
  constexpr int dim = TestFixture::dim;
  const auto w = some_primitives<dim>(this->material);
  auto denser = w;
  denser[0] *= 1.1;
  const double full = this->grid.dx_power(dim);
  struct Row {
    AveragesOf what;
    double fill;
    bool old;
  };
  for (const Row& r : {Row{AveragesOf::stage, 0.05, true}, Row{AveragesOf::stage, -0.3, true},
                       Row{AveragesOf::stage, 0.5, false}, Row{AveragesOf::mean, 0.74, true},
                       Row{AveragesOf::mean, 0.76, false}}) {
    auto state = this->uniform(w);
    auto& b = state.bodies[0].at(0);
    b.near_surface = true;
    choose_roles(state, state.bodies[0], 0, this->counters);
    average_primitives(state, state.bodies[0], 0, this->counters);
    b.contents_old = b.contents;
    b.volume_old = b.volume;
    std::fill(b.average.begin(), b.average.end(), 7.0);  // stencil values
    set_piece(b, 2, r.fill * full, per_volume<dim>(this->material, denser));
    average_primitives(state, state.bodies[0], 0, this->counters, r.what);
    const double rho = r.old ? w[0] : denser[0];
    EXPECT_NEAR(b.average[2] / rho, 1, 1e-12) << r.fill;
  }
  EXPECT_EQ(this->counters.averages_kept, 0);
}

TYPED_TEST(States, TheFastestSignalIsTheSumOverAxes) {
  constexpr int dim = TestFixture::dim;
  Primitives<dim> w{};
  w[0] = density(this->material);
  constexpr double sound = 1.5;
  double speeds = sound * longitudinal_speed(this->material);
  for (int d = 0; d < dim; ++d) {
    w[1 + d] = 100 - 250 * d;
    speeds += std::abs(100 - 250 * d);
  }
  auto state = this->uniform(w);
  choose_roles(state, state.bodies[0], 0, this->counters);
  average_primitives(state, state.bodies[0], 0, this->counters);
  EXPECT_NEAR(fastest_signal(state, state.bodies[0], 0, sound, this->counters) * this->grid.dx / speeds, 1,
              1e-12);
}

/// Averages over such cells would grow until no sum over the body is exact: the run stops.
TYPED_TEST(States, ADensityFarBelowZeroOrBeyondTheEquationOfStateIsAnError) {
  constexpr int dim = TestFixture::dim;
  const double rho0 = density(this->material);
  for (const double rho : {-1.01 * rho0, 100 * rho0}) {
    auto state = this->uniform(some_primitives<dim>(this->material));
    auto& b = state.bodies[0].at(0);
    b.contents[3] = rho * b.volume[3];
    try {
      choose_roles(state, state.bodies[0], 0, this->counters);
      FAIL() << rho;
    } catch (const PhysicsError& e) {
      EXPECT_NE(std::string(e.what()).find("density beyond its equation of state"), std::string::npos)
          << e.what();
    }
  }
  auto state = this->uniform(some_primitives<dim>(this->material));
  auto& b = state.bodies[0].at(0);
  b.contents[3] = -0.99 * rho0 * b.volume[3];  // averaged with its neighbours, not refused
  EXPECT_NO_THROW(choose_roles(state, state.bodies[0], 0, this->counters));
}

TYPED_TEST(States, AStateThatIsNotANumberIsAnErrorWithItsPlace) {
  constexpr int dim = TestFixture::dim;
  auto state = this->uniform(some_primitives<dim>(this->material));
  auto& b = state.bodies[0].at(0);
  b.contents[3] = std::numeric_limits<double>::quiet_NaN();
  for (auto& role : b.role) role = donates | regular;
  try {
    average_primitives(state, state.bodies[0], 0, this->counters);
    FAIL();
  } catch (const PhysicsError& e) {
    EXPECT_NE(std::string(e.what()).find("body0 is not a number at ("), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace recoil::primitives_test
