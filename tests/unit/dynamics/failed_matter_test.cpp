#include "dynamics/failed_matter.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../core/dimensions.hpp"
#include "../material/samples.hpp"
#include "dynamics/primitives.hpp"
#include "dynamics/stress_invariants.hpp"

namespace recoil::failed_matter_test {
namespace {

template <class D>
struct FailedMatterState : testing::Test {
  static constexpr int dim = D::value;
  using C = Components<dim>;
  /// Copper pulled to 0.8 of its density, moving, at 2 kJ/kg.
  Contents<dim> pulled(double volume, double damage) const {
    const double mass = 0.8 * 8930 * volume;
    Contents<dim> q{};
    q[C::rho] = mass;
    q[C::u] = 30 * mass;
    q[C::energy] = mass * (2000 + 450);
    for (int c = C::s; c < C::ep; ++c) q[c] = mass * 1e8;
    q[C::ep] = 0.1 * mass;
    q[C::damage] = damage * mass;
    return q;
  }
};
TYPED_TEST_SUITE(FailedMatterState, Dimensions);

/// No stress is left, the energy is, and what has not failed stays in tension.
TYPED_TEST(FailedMatterState, BearsNoTensionAndKeepsItsEnergy) {
  constexpr int dim = TestFixture::dim;
  using C = typename TestFixture::C;
  samples::for_each<Eos>([&](const auto& eos) {
    const auto scaled = [&](double damage) {
      auto q = this->pulled(1e-9, damage);
      for (double& c : q) c *= eos.rho0 / 8930;
      return to_primitives<dim>(eos, q, 1e-9);
    };
    auto whole = scaled(0.99);
    if (!(whole[C::p] < 0)) return;
    EXPECT_FALSE(relieve<dim>(eos, whole));
    auto failed = scaled(1);
    const double before = failed[C::p];
    EXPECT_TRUE(relieve<dim>(eos, failed)) << before;
    EXPECT_EQ(failed[C::p], 0);
    for (int c = C::s; c < C::ep; ++c) EXPECT_EQ(failed[c], 0);
    EXPECT_NEAR(eos.energy(failed[C::rho], 0) + failed[C::extra], 2000, 1e-6);
  });
}

/// The solid matter of a void is free of pressure at the energy of the cell.
TEST(FailedMatterState, TheSolidPartIsFreeOfPressure) {
  samples::for_each<Eos>([](const auto& eos) {
    for (const double e : {0.0, 1e4, 2e5}) {
      const double rho = 0.6 * eos.rho0;
      if (!(eos.pressure(rho, e) < 0)) continue;
      const double solid = solid_fraction(eos, rho, e, 0);
      EXPECT_GT(solid, 0.5);
      EXPECT_LT(solid, 1);
      EXPECT_NEAR(eos.pressure(rho / solid, e) / (eos.rho0 * 1e6), 0, 1e-9) << e;
    }
  });
}

/// Intact matter that comes to a cell of failed matter does not put its voids under tension.
TYPED_TEST(FailedMatterState, WhatHadFailedStaysSoInTension) {
  constexpr int dim = TestFixture::dim;
  using C = typename TestFixture::C;
  constexpr double volume = 1e-9;
  Body<dim> body;
  body.material = samples::copper();
  body.material.damage = TensileDamage{1e9, 1, 1e-6};
  body.temperature = temperature_law(body.material);
  const auto relieved = [&](double damage, bool may_have_failed) {
    auto q = this->pulled(volume, damage);
    const bool is = FailingCell<dim>(body, q.data(), 1, volume).relieve(may_have_failed);
    EXPECT_NEAR(q[C::damage] / q[C::rho], is ? 1 : damage, 1e-15);
    for (int c = C::s; c < C::ep; ++c) EXPECT_EQ(q[c] == 0, is);
    return is;
  };
  EXPECT_TRUE(relieved(1, false));
  EXPECT_FALSE(relieved(0.95, false)) << "damaged, but it has not failed";
  EXPECT_TRUE(relieved(0.95, true)) << "a twentieth of intact matter has come";
  EXPECT_FALSE(relieved(0.8, true)) << "mostly it is other matter by now";
  auto pressed = this->pulled(0.7 * volume, 0.95);
  EXPECT_FALSE(FailingCell<dim>(body, pressed.data(), 1, 0.5 * volume).relieve(true));
}

/// In the course of the return: stress off where there is a void, damage by the law, no more stress than
/// failed matter bears.
TYPED_TEST(FailedMatterState, DamageGrowsAndFailedMatterYields) {
  constexpr int dim = TestFixture::dim;
  using C = typename TestFixture::C;
  Body<dim> body;
  body.material = samples::copper();
  body.material.damage = TensileDamage{1e9, 1, 1e-6};
  body.material.failed = {20e6, 0.1};
  body.temperature = temperature_law(body.material);
  auto q = this->pulled(1e-9, 0.25);
  FailingCell<dim> cell(body, q.data(), 1, 1e-9);
  EXPECT_FALSE(cell.relieve());
  EXPECT_EQ(cell.grow(1e-9, 0), 0);
  const double after = q[C::damage] / q[C::rho];
  EXPECT_GT(after, 0.25 + 1e-3);
  EXPECT_FALSE(cell.has_failed());
  cell.grow(1e-3, 0);
  EXPECT_TRUE(cell.has_failed());
  EXPECT_DOUBLE_EQ(q[C::damage] / q[C::rho], 1);
  const double left = std::sqrt(equivalent_stress_squared<dim>(q.data() + C::s, 1)) / q[C::rho];
  EXPECT_NEAR(left, 20e6, 1e-3);  // in tension there is no friction
  EXPECT_TRUE(cell.relieve());
  for (int c = C::s; c < C::ep; ++c) EXPECT_EQ(q[c], 0);
  q[C::damage] = 1.5 * q[C::rho];
  EXPECT_EQ(cell.grow(1e-9, 0), 1);  // clamped, and counted
}

/// A model without a rate: a stage of a step leaves the damage, the end of the step sets it to 1.
TYPED_TEST(FailedMatterState, WithoutARateMatterFailsAtTheEndOfAStep) {
  constexpr int dim = TestFixture::dim;
  using C = typename TestFixture::C;
  for (const double tension : {1e9, 1e12}) {
    Body<dim> body;
    body.material = samples::copper();
    body.material.damage = MinimumPressure{tension};
    body.material.failed = {20e6, 0.1};
    body.temperature = temperature_law(body.material);
    ASSERT_TRUE(fails_at_once(body.material.damage));
    auto q = this->pulled(1e-9, 0.25);
    FailingCell<dim> cell(body, q.data(), 1, 1e-9);
    EXPECT_EQ(cell.grow(1e-9, 0), 0);
    EXPECT_DOUBLE_EQ(q[C::damage] / q[C::rho], 0.25);
    EXPECT_EQ(cell.fail_at_once(), tension < 1e10);
    EXPECT_DOUBLE_EQ(q[C::damage] / q[C::rho], tension < 1e10 ? 1 : 0.25);
    EXPECT_FALSE(cell.fail_at_once());  // only once
    if (tension > 1e10) continue;
    const double left = std::sqrt(equivalent_stress_squared<dim>(q.data() + C::s, 1)) / q[C::rho];
    EXPECT_NEAR(left, 20e6, 1e-3);
  }
}

}  // namespace
}  // namespace recoil::failed_matter_test
