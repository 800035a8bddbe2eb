#include "material/temperature.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "samples.hpp"

namespace recoil::temperature_test {
namespace {

TemperatureLaw by_energy(const Eos& eos) {
  Thermal thermal;
  thermal.rule = Thermal::Rule::energy;
  thermal.specific_heat = 383.5;
  return {thermal, eos};
}

TEST(Temperature, PlasticWorkRuleAddsTheHeat) {
  Thermal thermal;
  thermal.rule = Thermal::Rule::plastic_work;
  thermal.specific_heat = 400;
  thermal.taylor_quinney = 0.9;
  const TemperatureLaw law(thermal, MieGruneisen{8930, 3940, 1.49, 2.0});
  EXPECT_EQ(law(9000, 1e5, 0), 298);
  EXPECT_EQ(law(9000, 1e5, 12.5), 310.5);
  EXPECT_NEAR(plastic_heating(thermal, 5e8, 0.1, 8000), 0.9 * 5e8 * 0.1 / (8000 * 400), 1e-12);
}

TEST(Temperature, RestIsAtTheStart) {
  samples::for_each<Eos>([](const auto& eos) {
    EXPECT_NEAR(by_energy(eos)(eos.rho0, 0, 0), 298, 1e-9);
    // By energy the heating by plastic work does not count; porous matter has its lost distension there.
    if (!by_energy(eos).has_pores()) {
      EXPECT_NEAR(by_energy(eos)(eos.rho0, 0, 7), 298, 1e-9);
    }
  });
}

TEST(Temperature, HeatAtRestDensityIsSpecificHeat) {
  samples::for_each<Eos>(
      [](const auto& eos) { EXPECT_NEAR(by_energy(eos)(eos.rho0, 38350, 0), 398, 1e-6) << eos.kind; });
}

/// de_s/drho = p/rho^2 by finite differences of the table.
TEST(Temperature, IsentropeIsAdiabatic) {
  samples::for_each<Eos>([](const auto& eos) {
    const TemperatureLaw law = by_energy(eos);
    const double rest = law.solid_density(eos.rho0, 0);  // the isentrope is that of the solid
    for (const double x : {0.6, 0.9, 1.05, 1.3, 1.6}) {
      const double rho = x * rest, h = 0.01 * rest;
      const double slope = (law.isentrope(rho + h) - law.isentrope(rho - h)) / (2 * h);
      const double exact = frozen(eos, 1e9).pressure(rho, law.isentrope(rho)) / (rho * rho);
      EXPECT_NEAR(slope, exact, 5e-3 * std::fabs(exact)) << eos.kind << " " << x;
    }
  });
}

/// The way to a state does not matter: behind a shock by the jump conditions e = p (1/rho0 - 1/rho)/2.
TEST(Temperature, ShocksHeatByTheirEnergyAndElasticDistortionDoesNot) {
  const MieGruneisen eos{8930, 3940, 1.49, 2.0};
  const TemperatureLaw law = by_energy(eos);
  const double rho = 1.25 * eos.rho0, phi = 1 - eos.rho0 / rho;
  const double p = eos.rho0 * eos.c0 * eos.c0 * phi / ((1 - eos.s * phi) * (1 - eos.s * phi));
  const double e = 0.5 * p * (1 / eos.rho0 - 1 / rho);
  EXPECT_NEAR(eos.pressure(rho, e), p, 1e-6 * p);
  // dT = Gamma0/rho0 T drho rho0/rho^2 + (de - p dv)/c_v integrated along the Hugoniot.
  double t = 298, e_before = 0, p_before = 0;
  const int steps = 20000;
  const double h = phi / steps;
  for (int k = 1; k <= steps; ++k) {
    const double x = k * h, p_now = eos.rho0 * eos.c0 * eos.c0 * x / ((1 - eos.s * x) * (1 - eos.s * x));
    const double e_now = 0.5 * p_now * x / eos.rho0;
    const double heat = e_now - e_before - 0.5 * (p_now + p_before) * h / eos.rho0;  // T ds
    t += (heat / 383.5 + 2.0 * h * t) / (1 - eos.gamma0 * 0.5 * h);
    e_before = e_now, p_before = p_now;
  }
  EXPECT_NEAR(law(rho, e, 0), t, 0.002 * t);
  EXPECT_DOUBLE_EQ(distortion_energy(4e16, 43e9, 9000), 4e16 / (6 * 43e9 * 9000));
  EXPECT_EQ(distortion_energy(4e16, 0, 9000), 0);
}

TEST(Temperature, LinearMaterialIsColdOnItsElasticCurve) {
  const LinearEos eos{8930, 130e9};
  const TemperatureLaw law = by_energy(eos);
  for (const double x : {0.8, 1.0, 1.2})
    EXPECT_NEAR(law(x * eos.rho0, eos.energy(x * eos.rho0, 0), 0), 298, 0.01) << x;
}

TEST(Temperature, IsentropicCompressionHeatsByTheGrueneisenLaw) {
  const MieGruneisen eos{8930, 3940, 1.49, 2.0};
  const TemperatureLaw law = by_energy(eos);
  const double rho = 1.2 * eos.rho0;
  EXPECT_NEAR(law(rho, law.isentrope(rho), 0), 298 * std::exp(2.0 * (1 - 1 / 1.2)), 1e-6);
}

/// An ideal gas has T = P/((gamma - 1) rho c_v), whatever its density.
TEST(Temperature, OfAnIdealGas) {
  const IdealGas air{1.2041, 1.4, 101325};
  Thermal thermal;
  thermal.initial_temperature = 293.15;
  thermal.specific_heat = 101325 / (0.4 * 1.2041 * 293.15);
  const TemperatureLaw law(thermal, air);
  for (const double part : {0.05, 0.4, 1.0, 3.0, 6.0})
    for (const double t : {200.0, 500.0, 4000.0}) {
      const double rho = part * 1.2041, p = 0.4 * rho * thermal.specific_heat * t - 101325;
      EXPECT_NEAR(law.by_energy(rho, air.energy(rho, p)), t, 0.1) << part;
    }
}

/// Products of an explosive: Gamma = omega, so T_s = T0 (rho/rho0)^omega on the isentrope.
TEST(Temperature, IsentropeOfProducts) {
  const Jwl tnt{1630, 371.2e9, 3.231e9, 4.15, .95, .30, 7e9, 6930};
  Thermal thermal;
  thermal.specific_heat = 1000;
  const TemperatureLaw law(thermal, tnt);
  for (const double part : {0.1, 0.5, 1.4})
    EXPECT_NEAR(law.on_isentrope(part * 1630), 298 * std::pow(part, .30), 0.05) << part;
}

}  // namespace
}  // namespace recoil::temperature_test
