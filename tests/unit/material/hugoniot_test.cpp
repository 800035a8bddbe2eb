#include "material/hugoniot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "samples.hpp"

namespace recoil::hugoniot_test {
namespace {

using samples::aluminium;
using samples::copper;
using samples::hydro;

/// Matching two straight U_s-u_p lines by hand: 134.05 m/s, 4.956 GPa.
TEST(Hugoniot, PlatesWithoutStrength) {
  const Impact i = match_impact(hydro(aluminium()), hydro(copper()), 450);
  EXPECT_NEAR(i.velocity, 134.05, 0.005);
  EXPECT_NEAR(i.stress / 1e9, 4.956, 0.0006);
  EXPECT_NEAR(i.target.shock_speed, 3940 + 1.49 * i.velocity, 1e-6);
  EXPECT_NEAR(i.flyer.shock_speed, 5386 + 1.339 * (450 - i.velocity), 1e-6);
  EXPECT_FALSE(i.target.has_precursor);
}

/// Independent two-wave solution, confirmed by a converged Lagrangian run.
TEST(Hugoniot, PlatesWithStrength) {
  const Impact i = match_impact(aluminium(), copper(), 450);
  EXPECT_NEAR(i.stress / 1e9, 5.0838, 0.0002);
  EXPECT_NEAR(i.velocity, 133.69, 0.01);
  ASSERT_TRUE(i.target.has_precursor);
  EXPECT_NEAR(2 * i.target.precursor_velocity, 43.44, 0.02);
  EXPECT_NEAR(15e-3 / i.target.precursor_speed * 1e6, 3.180, 0.001);
  EXPECT_NEAR(match_impact(copper(), aluminium(), 450).velocity, 316.31, 0.01);
}

TEST(Hugoniot, SymmetricAluminiumUpToAnOverdrivenShock) {
  const double speeds[] = {450, 1000, 1250, 1500, 1900};
  const double stress[] = {3.5777, 8.2954, 10.6197, 13.0567, 17.1906};
  for (int k = 0; k < 5; ++k) {
    const Impact i = match_impact(aluminium(), aluminium(), speeds[k]);
    EXPECT_NEAR(i.stress / 1e9, stress[k], 2e-4 * stress[k]) << speeds[k];
    EXPECT_NEAR(i.velocity, speeds[k] / 2, 1e-8);
    EXPECT_EQ(i.target.has_precursor, speeds[k] < 1800);
  }
}

/// Mass, momentum and energy across both fronts together.
TEST(Hugoniot, FrontsConserveMassMomentumAndEnergy) {
  for (const double u : {5.0, 30.0, 100.0, 400.0, 900.0}) {
    const Material m = copper();
    const ShockState s = shock_at_velocity(m, u);
    EXPECT_NEAR(s.velocity, u, 1e-9 * u);
    const double us = s.shock_speed, ue = s.precursor_velocity, c = s.precursor_speed;
    const double ahead = s.has_precursor ? density(m) * c / (c - ue) : density(m);
    EXPECT_NEAR(ahead * (us - ue), s.density * (us - u), 1e-9 * ahead * us);
    EXPECT_NEAR(s.stress - s.precursor_stress, ahead * (us - ue) * (u - ue), 1e-9 * s.stress);
    // Work of the face per mass swept: a budget over everything behind the precursor.
    const double front = s.has_precursor ? c : us;
    const double e_ahead = 0.5 * ue * ue;  // a shock from rest: e = u^2/2
    const double mass_between = s.has_precursor ? ahead * (c - us) : 0, mass = s.density * (us - u);
    EXPECT_NEAR(mass_between + mass, density(m) * front, 1e-9 * density(m) * front);
    EXPECT_NEAR(s.stress * u, mass * (s.energy + 0.5 * u * u) + mass_between * (e_ahead + 0.5 * ue * ue),
                1e-8 * s.stress * u);
  }
}

TEST(Hugoniot, StateIsOnTheYieldSurface) {
  const ShockState s = shock_at_velocity(aluminium(), 300);
  EXPECT_NEAR(s.stress - s.pressure, 2.0 / 3 * s.yield, 1e-6 * s.yield);
  EXPECT_NEAR(s.plastic_strain + s.yield / (3 * 26e9), 2.0 / 3 * std::log(s.density / 2700), 1e-9);
  EXPECT_GT(s.temperature, 298);
}

TEST(Hugoniot, ElasticPlatesHaveOneWave) {
  Material m = copper();
  m.strength = Elastic{43.33e9};
  const Impact i = match_impact(m, m, 20);
  EXPECT_FALSE(i.target.has_precursor);
  EXPECT_NEAR(i.target.shock_speed, longitudinal_speed(m), 20);
  EXPECT_NEAR(i.stress, density(m) * longitudinal_speed(m) * 10, 0.01 * i.stress);
}

TEST(Hugoniot, EnergyTemperatureSoftensTheLimit) {
  Material m = copper();
  m.thermal.rule = Thermal::Rule::energy;
  const ShockState warm = shock_at_velocity(m, 500), work = shock_at_velocity(copper(), 500);
  EXPECT_GT(warm.temperature, work.temperature);
  EXPECT_LT(warm.yield, work.yield);
}

TEST(Hugoniot, LighterFlyersLeave) {
  const Material al = aluminium(), cu = copper();
  EXPECT_TRUE(flyer_leaves(match_impact(al, cu, 450), al, cu));
  EXPECT_FALSE(flyer_leaves(match_impact(cu, al, 450), cu, al));
  EXPECT_FALSE(flyer_leaves(match_impact(cu, cu, 450), cu, cu));
  const Impact i = match_impact(al, cu, 450);
  EXPECT_NEAR(unloading_time(i.flyer, al, 2e-3), 0.695e-6, 0.05 * 0.695e-6)
      << "converged Lagrangian solution";
}

TEST(Hugoniot, BeyondTheEquationOfStateIsAnError) {
  EXPECT_THROW(shock_at_velocity(copper(), 80e3), PhysicsError);
  EXPECT_EQ(shock_at_velocity(copper(), 0).stress, 0);
}

/// Air, exact: U_s = (gamma + 1)/4 u + sqrt(((gamma + 1)/4 u)^2 + c0^2), and T of the ideal gas behind it.
TEST(Hugoniot, OfAnIdealGas) {
  Material air;
  air.eos = IdealGas{1.2041, 1.4, 101325};
  air.strength = NoStrength{};
  air.thermal.initial_temperature = 293.15;
  air.thermal.specific_heat = 101325 / (0.4 * 1.2041 * 293.15);
  const double u = 1000, us = 0.6 * u + std::sqrt(0.36 * u * u + 1.4 * 101325 / 1.2041);
  const ShockState s = shock_at_velocity(air, u);
  EXPECT_NEAR(s.shock_speed, us, 1e-6 * us);
  EXPECT_NEAR(s.pressure, 1.2041 * us * u, 1e-6 * s.pressure);
  const double t = 293.15 * (101325 + s.pressure) / 101325 * 1.2041 / s.density;
  EXPECT_NEAR(s.temperature, t, 1e-5 * t);
}

/// The energy of a Tillotson material is no linear function of its pressure: the jump must hold all the same.
TEST(Hugoniot, JumpConditionsHoldForEveryEquationOfState) {
  samples::for_each<Eos>([](const auto& eos) {
    Material m = hydro(copper());
    m.eos = eos;
    const double rho0 = density(m), u = std::min(2000.0, 0.7 * largest_velocity(m));
    const ShockState s = shock_at_velocity(m, u);
    EXPECT_NEAR(s.velocity, u, 1e-9 * u);
    const double u1 = s.precursor_velocity, p1 = s.precursor_stress;  // of porous matter, else 0
    const double rho1 = u1 > 0 ? rho0 / (1 - u1 / s.precursor_speed) : rho0;
    EXPECT_NEAR(s.pressure, p1 + rho1 * (s.shock_speed - u1) * (u - u1), 1e-9 * s.pressure) << eos.kind;
    EXPECT_NEAR(s.energy, 0.5 * u1 * u1 + 0.5 * (s.pressure + p1) * (1 / rho1 - 1 / s.density),
                1e-9 * s.energy)
        << eos.kind;
    if (!eos.barotropic) {
      EXPECT_NEAR(eos.pressure(s.density, s.energy), s.pressure, 1e-8 * s.pressure) << eos.kind;
    }
  });
}

/// Y = cohesion + friction p: behind the precursor 2 G ln(rho/rho0) has reached it, and the stress deviates
/// by 2/3.
TEST(Hugoniot, OfMatterWhoseYieldFollowsPressure) {
  Material rock;
  rock.eos = MieGruneisen{2660, 3700, 1.24, 0.9};
  const Lundborg strength{25e9, 50e6, 1.5, 2e9};
  rock.strength = strength;
  rock.thermal.specific_heat = 800;
  const ShockState s = shock_at_velocity(rock, 500);
  ASSERT_TRUE(s.has_precursor);
  EXPECT_NEAR(s.yield, strength.yield({.pressure = s.pressure}), 1e-9 * s.yield);
  EXPECT_NEAR(s.stress - s.pressure, 2.0 / 3 * s.yield, 1e-9 * s.yield);
  // At the elastic limit: stress = p + 2/3 Y, and the elastic law gives both from one density.
  const double strain = (s.precursor_stress - 0) / (2660 * s.precursor_speed * s.precursor_speed);
  const double rho = 2660 / (1 - strain), p = s.precursor_stress - 4.0 / 3 * 25e9 * std::log(rho / 2660);
  EXPECT_NEAR(2 * 25e9 * std::log(rho / 2660), strength.yield({.pressure = p}), 1e-3 * 100e6);
}

}  // namespace
}  // namespace recoil::hugoniot_test
