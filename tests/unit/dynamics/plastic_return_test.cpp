#include "dynamics/plastic_return.hpp"

#include <cmath>
#include <cstddef>
#include <variant>

#include "../core/dimensions.hpp"
#include "../cutcell/bodies.hpp"

namespace recoil::plastic_return_test {
namespace {

template <class D>
struct PlasticReturn : testing::Test {
  static constexpr int dim = D::value;
  using C = Components<dim>;
  static constexpr double yield = 0.3e9, shear = 27.6e9;
  Grid<dim> grid = make_test_grid<dim>(4, 4, Edge::outflow, true);

  State<dim> state_with(const Strength& strength, const Primitives<dim>& w) {
    Material m = samples::copper();
    m.strength = strength;
    auto state = make_test_state<dim>(grid, {[](const Vec<dim>&) { return -100.0; }}, m);
    cut_all(state);
    fill_body(state, 0, per_volume<dim>(m, w));
    return state;
  }
  static double equivalent(const BodyBlock<dim>& b) {
    return std::sqrt(
               equivalent_stress_squared<dim>(b.contents.data() + C::s * b.volume.size(), b.volume.size())) /
           b.contents[0];
  }
  Primitives<dim> stressed(double factor) {
    auto w = some_primitives<dim>(samples::copper());
    w[C::s] = 5e7;
    for (int c = 0; c < C::stresses; ++c) w[C::s + c] *= factor;
    return w;
  }
};
TYPED_TEST_SUITE(PlasticReturn, Dimensions);

/// 3/2 S:S from the full tensor.
TYPED_TEST(PlasticReturn, TheEquivalentStressIsThatOfTheTensor) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  const auto w = some_primitives<dim>(samples::copper());
  double tensor[3][3] = {};
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      if (C::stress(i, j) >= 0) tensor[i][j] = w[C::s + C::stress(i, j)];
  if (dim == 1)
    tensor[1][1] = tensor[2][2] = -0.5 * tensor[0][0];
  else
    tensor[2][2] = -tensor[0][0] - tensor[1][1];
  double sum = 0;
  for (const auto& row : tensor)
    for (const double s : row) sum += 1.5 * s * s;
  EXPECT_NEAR(equivalent_stress_squared<dim>(w.data() + C::s, 1) / sum, 1, 1e-14);
}

TYPED_TEST(PlasticReturn, ElasticStatesAreLeftAlone) {
  auto state = this->state_with(PerfectlyPlastic{this->shear, 1e12}, this->stressed(1));
  const auto before = state.bodies[0].at(0).contents;
  return_to_yield(state, state.bodies[0], 0, 1e-9, state.ledger[0]);
  EXPECT_EQ(state.bodies[0].at(0).contents, before);
}

/// Back on the surface along the deviator: S scales by Y/q, ep rises by (q - Y)/(3 G), heat by Y dep/(rho c).
TYPED_TEST(PlasticReturn, TrialStressesReturnToTheSurface) {
  using C = typename TestFixture::C;
  const auto w = this->stressed(20);
  auto state = this->state_with(PerfectlyPlastic{this->shear, this->yield}, w);
  auto& b = state.bodies[0].at(0);
  const std::size_t n = b.volume.size();
  const double trial = TestFixture::equivalent(b);
  ASSERT_GT(trial, this->yield);
  const auto before = b.contents;
  return_to_yield(state, state.bodies[0], 0, 1e-9, state.ledger[0]);
  EXPECT_NEAR(TestFixture::equivalent(b) / this->yield, 1, 1e-12);
  for (std::size_t c = 0; c < C::s; ++c) EXPECT_EQ(b.contents[c * n], before[c * n]);  // no budget changes
  for (std::size_t c = C::s; c < C::ep; ++c)
    EXPECT_NEAR(b.contents[c * n] / before[c * n], this->yield / trial, 1e-12);
  const double increment = (trial - this->yield) / (3 * this->shear), mass = b.contents[0];
  EXPECT_NEAR((b.contents[C::ep * n] - before[C::ep * n]) / mass, increment, 1e-12);
  const double rho = w[0], heat = this->yield * increment / (rho * samples::copper().thermal.specific_heat);
  EXPECT_NEAR((b.contents[C::temperature_rise * n] - before[C::temperature_rise * n]) / mass / heat, 1, 1e-9);
}

/// Damaged matter returns to (1 - weakening D) Y, whatever the form of its yield stress; with all of it taken
/// away it bears nothing.
TYPED_TEST(PlasticReturn, DamageWeakens) {
  using C = typename TestFixture::C;
  for (const Strength& strength :
       {Strength{LinearHardening{this->shear, this->yield, 1e9}}, samples::copper().strength})
    for (const double weakening : {0.4, 1.0}) {
      auto state = this->state_with(strength, this->stressed(20));
      Body<TestFixture::dim>& body = state.bodies[0];
      body.material.damage = CockcroftLatham{1e12, weakening};
      auto& b = body.at(0);
      const double damage = weakening < 1 ? 0.5 : 0.99;
      Contents<TestFixture::dim> q;
      for (std::size_t c = 0; c < q.size(); ++c) q[c] = b.contents[c * b.volume.size()];
      q[C::damage] = damage * q[C::rho];
      const double before = q[C::ep] / q[C::rho],
                   trial2 = equivalent_stress_squared<TestFixture::dim>(q.data() + C::s, 1);
      const double rho = q[C::rho] / b.volume[0], dt = 1e-9;
      double kinetic = 0;
      for (int d = 0; d < TestFixture::dim; ++d) kinetic += q[C::u + d] * q[C::u + d];
      const double e = (q[C::energy] - 0.5 * kinetic / q[C::rho]) / q[C::rho] -
                       distortion_energy(trial2 / (q[C::rho] * q[C::rho]), shear_modulus(body.material), rho);
      const double temperature = body.temperature(rho, e, q[C::temperature_rise] / q[C::rho]);
      return_fragment<TestFixture::dim>(body, q, b.volume[0], dt);
      const double ep = q[C::ep] / q[C::rho];
      const double left =
          std::sqrt(equivalent_stress_squared<TestFixture::dim>(q.data() + C::s, 1)) / q[C::rho];
      const double full = yield(strength, {.ep = ep, .rate = (ep - before) / dt, .temperature = temperature});
      EXPECT_GT(ep, before);
      EXPECT_NEAR(left / (full * (1 - weakening * damage)), 1, 1e-9);
    }
}

TYPED_TEST(PlasticReturn, MeltedMatterLosesItsDeviator) {
  using C = typename TestFixture::C;
  auto w = this->stressed(5);
  w[C::temperature_rise] = 2000;  // beyond melting
  auto state = this->state_with(samples::copper().strength, w);
  return_to_yield(state, state.bodies[0], 0, 1e-9, state.ledger[0]);
  EXPECT_NEAR(TestFixture::equivalent(state.bodies[0].at(0)), 0, 1);
}

/// Half of the latent heat taken up: half of the strength; all of it: none, of a model without a limit as
/// well.
TYPED_TEST(PlasticReturn, MeltingMatterLosesStrengthWithItsSolidPart) {
  constexpr int dim = TestFixture::dim;
  using C = typename TestFixture::C;
  for (const Strength& strength :
       {Strength{PerfectlyPlastic{this->shear, this->yield}}, Strength{Elastic{this->shear}}})
    for (const double molten : {0.25, 0.5, 1.0}) {
      const auto w = this->stressed(10);
      auto state = this->state_with(strength, w);
      Body<dim>& body = state.bodies[0];
      Material& m = body.material;
      m.thermal.rule = Thermal::Rule::energy;
      m.melting = {.temperature = 1358, .heat = 208.7e3};
      body.temperature = temperature_law(m);
      auto& b = body.at(0);
      const std::size_t n = b.volume.size();
      const double trial = TestFixture::equivalent(b), rho = w[0], c = m.thermal.specific_heat;
      const TemperatureLaw& law = body.temperature;
      const double e = law.isentrope(rho) + c * (law.melting_at(rho) - law.on_isentrope(rho)) +
                       molten * m.melting.heat + distortion_energy(trial * trial, this->shear, rho);
      double kinetic = 0;
      for (std::size_t d = 0; d < dim; ++d) kinetic += 0.5 * w[C::u + d] * w[C::u + d];
      for (std::size_t k = 0; k < n; ++k) b.contents[C::energy * n + k] = b.contents[k] * (e + kinetic);
      return_to_yield(state, body, 0, 1e-9, state.ledger[0]);
      const bool limited = std::holds_alternative<PerfectlyPlastic>(strength);
      const double left = limited ? (1 - molten) * this->yield : molten < 1 ? trial : 0.0;
      EXPECT_NEAR(TestFixture::equivalent(b), left, 1e-8 * trial) << molten;
    }
}

TYPED_TEST(PlasticReturn, WhatIsLeftBelowZeroIsClearedAndCounted) {
  using C = typename TestFixture::C;
  auto state = this->state_with(PerfectlyPlastic{this->shear, this->yield}, this->stressed(1));
  auto& b = state.bodies[0].at(0);
  const std::size_t n = b.volume.size(), strain = C::ep * n, heat = C::temperature_rise * n;
  const auto before = b.contents;
  b.contents[strain + 1] = -0.01 * b.contents[1];
  b.contents[heat + 1] = -3 * b.contents[1];
  b.contents[heat + 2] = -3 * b.contents[2];
  b.contents[strain + 3] = -9e-5 * b.contents[3];  // no more than the foot of a plastic wave undershoots by
  EXPECT_EQ(clear_negative_strain(state, state.bodies[0], 0), 2);
  for (std::size_t k = 0; k < b.contents.size(); ++k) {
    const bool cleared = k == strain + 1 || k == heat + 1 || k == heat + 2 || k == strain + 3;
    ASSERT_EQ(b.contents[k], cleared ? 0 : before[k]) << k;
  }
}

/// Of a row of cells those that surely do not yield are left out: all come out as each does by itself.
TYPED_TEST(PlasticReturn, ARowIsWhatItsCellsAre) {
  constexpr int dim = TestFixture::dim;
  using C = typename TestFixture::C;
  for (const Strength& strength : {Strength{PerfectlyPlastic{this->shear, this->yield}},
                                   Strength{LinearHardening{this->shear, this->yield, 1e9}},
                                   Strength{Elastic{this->shear}}, samples::copper().strength})
    for (const bool melts : {false, true}) {
      auto state = this->state_with(strength, this->stressed(1));
      Body<dim>& body = state.bodies[0];
      if (melts) {
        body.material.melting.temperature = 800;
        body.temperature = temperature_law(body.material);
      }
      auto& b = body.at(0);
      const std::size_t n = b.volume.size();
      Random random(7);
      for (std::size_t k = 0; k < n; ++k) {
        const double factor = k % 2 == 0 ? random(0, 0.1) : random(12, 16);
        for (std::size_t c = C::s; c < C::ep; ++c) b.contents[c * n + k] *= factor;
        b.contents[C::ep * n + k] = b.contents[k] * random(-0.01, 0.3);
        b.contents[C::temperature_rise * n + k] = b.contents[k] * random(0, 900);
      }
      auto alone = b.contents;
      int yielding = 0;
      for (std::size_t k = 0; k < n; ++k) {
        Contents<dim> q;
        for (std::size_t c = 0; c < q.size(); ++c) q[c] = alone[c * n + k];
        return_fragment<dim>(body, q, b.volume[k], 1e-9);
        yielding += q[C::ep] != alone[C::ep * n + k] ? 1 : 0;
        for (std::size_t c = 0; c < q.size(); ++c) alone[c * n + k] = q[c];
      }
      return_to_yield(state, body, 0, 1e-9, state.ledger[0]);
      EXPECT_EQ(b.contents, alone);
      if (melts || !std::holds_alternative<Elastic>(strength)) {
        EXPECT_GT(yielding, 0);
        EXPECT_LT(yielding, static_cast<int>(n));
      }
    }
}

/// Johnson-Cook: faster flow is stronger, and the rate is that of this substage.
TYPED_TEST(PlasticReturn, ShorterStepsMeanHigherRates) {
  double last = 0;
  for (const double dt : {1e-3, 1e-6, 1e-9}) {
    auto state = this->state_with(samples::copper().strength, this->stressed(20));
    return_to_yield(state, state.bodies[0], 0, dt, state.ledger[0]);
    const double y = TestFixture::equivalent(state.bodies[0].at(0));
    EXPECT_GT(y, last * 1.02);
    last = y;
  }
}

TYPED_TEST(PlasticReturn, TheRungeKuttaMean) {
  auto state = this->state_with(PerfectlyPlastic{this->shear, this->yield}, this->stressed(1));
  auto& b = state.bodies[0].at(0);
  b.contents_old = b.contents;
  b.volume_old = b.volume;
  combine_with_old(state, state.bodies[0], 0, 1.0 / 3);
  EXPECT_EQ(b.contents, b.contents_old);  // exact where nothing changed
  for (double& v : b.contents) v *= 4;
  b.volume[1] = 5;
  combine_with_old(state, state.bodies[0], 0, 0.25);
  EXPECT_NEAR(b.contents[0] / b.contents_old[0], 0.25 + 0.75 * 4, 1e-14);
  EXPECT_NEAR(b.volume[1], 0.25 * b.volume_old[1] + 0.75 * 5, 1e-14);
}

}  // namespace
}  // namespace recoil::plastic_return_test
