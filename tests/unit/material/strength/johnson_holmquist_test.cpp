#include "material/strength/johnson_holmquist.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "../../cutcell/bodies.hpp"
#include "../alumina.hpp"
#include "dynamics/plastic_return.hpp"
#include "material/hugoniot.hpp"
#include "material/library.hpp"

namespace recoil::johnson_holmquist_test {
namespace {

using samples::alumina;

/// By hand: s_HEL = 1.5 (2.79 - 1.46) = 1.995 GPa; at 3 GPa p* = 2.0548, T* = 0.13699,
///   intact .93 (2.19178)^.6 = 1.48915, fractured .31 (2.0548)^.6 = 0.47764 times that.
TEST(JohnsonHolmquist, StrengthsByHand) {
  const JohnsonHolmquist s = samples::of(JohnsonHolmquist{})[0];
  EXPECT_NEAR(s.at_hel(), 1.995e9, 1);
  const double whole = .93 * std::exp(.6 * std::log(3.2 / 1.46)) * 1.995e9;
  const double broken = .31 * std::exp(.6 * std::log(3.0 / 1.46)) * 1.995e9;
  EXPECT_NEAR(whole, 2.9708e9, 2e6);
  EXPECT_NEAR(broken, 0.9524e9, 2e6);
  EXPECT_NEAR(s.yield({.pressure = 3e9}), whole, 1);
  EXPECT_NEAR(s.yield({.pressure = 3e9, .damage = 1}), broken, 1);
  EXPECT_NEAR(s.yield({.pressure = 3e9, .damage = 0.25}), 0.75 * whole + 0.25 * broken, 1);
  EXPECT_EQ(s.yield({.pressure = -0.2e9}), 0);
  EXPECT_GT(s.yield({.pressure = -0.1e9}), 0);
  EXPECT_EQ(s.yield({.pressure = -0.1e9, .damage = 1}), 0);
}

/// Boron carbide: both strengths grow with the rate, and the fractured one ends at a fifth of that at the
/// HEL.
TEST(JohnsonHolmquist, RateAndBoundOfTheFracturedStrength) {
  const JohnsonHolmquist s = samples::of(JohnsonHolmquist{})[1];
  const double factor = 1 + .005 * std::log(1e5);
  EXPECT_NEAR(s.yield({.rate = 1e5, .pressure = 10e9}) / s.yield({.pressure = 10e9}), factor, 1e-12);
  EXPECT_NEAR(s.yield({.rate = 1e-3, .pressure = 10e9}), s.yield({.pressure = 10e9}), 1e-3);
  EXPECT_NEAR(s.yield({.pressure = 1e9, .damage = 1}), .7 * std::pow(1 / 8.71, .85) * s.at_hel(), 1);
  EXPECT_NEAR(s.yield({.pressure = 20e9, .damage = 1}), .2 * s.at_hel(), 1);
}

TEST(JohnsonHolmquist, DamageByStrainAndByTension) {
  const JohnsonHolmquistDamage d = samples::of(JohnsonHolmquistDamage{})[0];
  EXPECT_NEAR(d.failure_strain(2.72e9), .005 * 2, 1e-9);  // p* + T* = 2
  EXPECT_NEAR(d.growth({.pressure = 2.72e9, .strain_growth = 1e-4}), 0.01, 1e-9);
  EXPECT_EQ(d.growth({.pressure = -0.19e9}), 0);
  EXPECT_EQ(d.growth({.pressure = -0.21e9}), 1);
  EXPECT_EQ(d.growth({.damage = 0.5, .pressure = -0.11e9}), 1) << "half of the tension is left";
}

/// The strength at the HEL is that which HEL and p_HEL say, and the analytic elastic limit is the HEL.
TEST(JohnsonHolmquist, ElasticLimitIsTheHugoniotElasticLimit) {
  const ShockState s = shock_at_velocity(alumina(), 200);
  ASSERT_TRUE(s.has_precursor);
  EXPECT_NEAR(s.precursor_stress / 2.79e9, 1, 0.02);
}

TEST(JohnsonHolmquist, DamageNeedsTheStrength) {
  const auto read = [](const std::string& strength) {
    config::Diagnostics out;
    const config::Document own = config::parse_document(
        "[material.x]\neos = { kind = \"polynomial\", density = \"3.7 g/cm3\", k1 = \"131 GPa\" }\n"
        "thermal = { specific-heat = \"880 J/(kg K)\" }\n"
        "damage = { kind = \"johnson-holmquist\", d1 = 0.005, d2 = 1 }\nstrength = { " +
            strength + " }\n",
        "case.toml", out);
    const auto m = find_material("x", &own, {}, out, {});
    return m ? std::get<JohnsonHolmquistDamage>(m->damage).tension : -1.0;
  };
  EXPECT_EQ(read("kind = \"elastic\", shear-modulus = \"90 GPa\""), -1);
  EXPECT_NEAR(
      read("kind = \"johnson-holmquist\", shear-modulus = \"90 GPa\", a = 0.9, n = 0.6, b = 0.3, m = 0.6, "
           "tension = \"0.2 GPa\", hel = \"2.8 GPa\", hel-pressure = \"1.46 GPa\""),
      0.2e9, 1);
}

/// One cell under uniaxial strain, as in the single-element test of Johnson & Holmquist (1994) and Cronin et
/// al. (2003): 5 % compression, and release.
struct Element {
  using C = Components<1>;
  Grid<1> grid = make_test_grid<1>(4, 4, Edge::outflow, true);
  State<1> state = make_test_state<1>(grid, {[](const Vec<1>&) { return -100.0; }}, alumina());
  BodyBlock<1>& block = state.bodies[0].at(0);
  std::size_t n = 0;
  double strain = 0;

  Element() {
    cut_all(state);
    Primitives<1> w{};
    w[C::rho] = 3700;
    fill_body(state, 0, per_volume<1>(state.bodies[0].material, w));
    n = block.volume.size();
  }
  double& at(int c) { return block.contents[static_cast<std::size_t>(c) * n]; }
  double density() { return at(C::rho) / block.volume[0]; }
  double pressure() { return recoil::pressure(state.bodies[0].material.eos, density(), 0); }
  double equivalent() { return 1.5 * std::abs(at(C::s) / at(C::rho)); }
  double damage() { return at(C::damage) / at(C::rho); }
  double plastic() { return at(C::ep) / at(C::rho); }
  /// By a logarithmic strain, compression positive, in dt [s].
  void compress(double more, double dt) {
    strain += more;
    const double grown = std::exp(more);
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t c = 0; c < C::contents; ++c) block.contents[c * n + k] *= grown;
      block.contents[C::s * n + k] -= 4.0 / 3 * 90.16e9 * more * block.contents[k];
    }
    return_to_yield(state, state.bodies[0], 0, dt, state.ledger[0]);
  }
};

TEST(JohnsonHolmquist, SingleElementCompressedAndReleased) {
  const JohnsonHolmquist s = samples::of(JohnsonHolmquist{})[0];
  Element e;
  constexpr double step = 1e-5, dt = 1e-9;
  double sum = 0, highest = 0, whole_at = 0;
  bool yielded = false;
  while (e.strain < 0.05) {
    const double before = e.plastic(), damage = e.damage(), q_before = e.equivalent();
    e.compress(step, dt);
    const double p = e.pressure();
    if (!yielded && e.plastic() > 0) {
      yielded = true;
      EXPECT_NEAR((p + 2.0 / 3 * q_before) / 2.79e9, 1, 0.02) << "elastic up to the HEL";
    }
    if (!yielded) {
      EXPECT_NEAR(e.equivalent(), 2 * 90.16e9 * e.strain, 1e3);
    }
    if (damage > 0 && damage < 1 && e.plastic() > before) {
      EXPECT_NEAR(e.equivalent(), s.yield({.pressure = p, .damage = damage}), 1e-6 * s.at_hel());
    }
    if (damage < 1) sum += (e.plastic() - before) / (.005 * (p + .2e9) / 1.46e9), whole_at = e.plastic();
    highest = std::max(highest, e.equivalent());
  }
  EXPECT_NEAR(sum, 1, 0.01) << "damage is the integral of d ep/ep_f";
  EXPECT_GT(whole_at, 0.005);
  EXPECT_EQ(e.damage(), 1);
  EXPECT_GT(highest, 1.9e9);
  // Broken: 5 % compression give p = 130.95 GPa (exp(0.05) - 1), and the strength on the fractured curve.
  const double p = 130.95e9 * std::expm1(e.strain);
  EXPECT_NEAR(e.pressure(), p, 1e-9 * p);
  EXPECT_NEAR(e.equivalent(), .31 * std::pow(p / 1.46e9, .6) * 1.995e9, 1e-9 * p);
  EXPECT_LT(e.equivalent(), highest);
  // Release: elastic, then the fractured curve on the other side, and nothing where pressure ends.
  const double q = e.equivalent();
  e.compress(-0.001, dt);
  EXPECT_NEAR(e.equivalent(), q - 2 * 90.16e9 * 0.001, 1e3);
  while (e.strain > 0.02) e.compress(-step, dt);
  EXPECT_GT(e.at(Element::C::s), 0);
  EXPECT_NEAR(e.equivalent(), .31 * std::pow(e.pressure() / 1.46e9, .6) * 1.995e9, 1e6);
  while (e.strain > -1e-4) e.compress(-step, dt);
  EXPECT_EQ(e.equivalent(), 0) << "broken matter bears no tension";
}

}  // namespace
}  // namespace recoil::johnson_holmquist_test
