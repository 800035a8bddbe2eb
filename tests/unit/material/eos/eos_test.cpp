#include "material/eos/eos.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../samples.hpp"
#include "material/eos/quick_exp.hpp"

namespace recoil::eos_test {
namespace {

/// Densities over the admissible range, rest density between them.
template <class Model>
std::vector<double> densities(const Model& eos) {
  const double top = std::min(eos.largest_density(), 3.0 * eos.rho0);
  std::vector<double> list;
  for (int i = 0; i <= 20; ++i) list.push_back(eos.rho0 * (0.5 + 0.025 * i));
  for (int i = 1; i < 40; ++i) list.push_back(eos.rho0 + (top - eos.rho0) * i / 40);
  return list;
}

TEST(Eos, RestIsFreeOfPressureAndEnergy) {
  samples::for_each<Eos>([](const auto& eos) {
    EXPECT_EQ(eos.pressure(eos.rho0, 0), 0);
    EXPECT_EQ(eos.energy(eos.rho0, 0), 0);
    const double c0 = bulk_sound_speed(eos);
    EXPECT_NEAR(eos.sound_speed_squared(eos.rho0, 0), c0 * c0, 1e-9 * c0 * c0);
    EXPECT_TRUE(eos.admissible(eos.rho0));
  });
}

TEST(Eos, EnergyInvertsPressure) {
  samples::for_each<Eos>([](const auto& eos) {
    if (eos.barotropic) return;
    const double coldest = has_tension(eos) ? -1e5 : 0.0;
    for (const double rho : densities(eos))
      for (const double e : {coldest, 0.0, 3e4, 2e6}) {
        const double p = eos.pressure(rho, e);
        EXPECT_NEAR(eos.energy(rho, p), e, 1e-9 * (std::fabs(e) + std::fabs(p) / eos.rho0)) << rho;
      }
  });
}

/// Along an isentrope de/drho = p/rho^2, so dp/drho is the sound speed squared and, for a barotropic
/// material, the energy is the integral of that.
TEST(Eos, SoundSpeedIsTheSlopeOfTheIsentrope) {
  samples::for_each<Eos>([](const auto& model) {
    const auto& eos = frozen(model, 0.0);
    for (const double rho : densities(eos)) {
      if (std::fabs(rho - eos.rho0) < 1e-3 * eos.rho0) continue;
      for (const double e : {0.0, 1e5, 1e6}) {
        const double p = eos.pressure(rho, e), h = 1e-5 * rho;
        const double de = p / (rho * rho) * h;
        const double curve = 0.5 * h * (eos.sound_speed_squared(rho, p) - 2 * p / rho) / (rho * rho) * h;
        const double slope =
            (eos.pressure(rho + h, e + de + curve) - eos.pressure(rho - h, e - de + curve)) / (2 * h);
        const double c2 = eos.sound_speed_squared(rho, p);
        EXPECT_NEAR(slope, c2, 2e-6 * std::fabs(c2) + 1e-6 * std::fabs(p / rho))
            << model.kind << " rho " << rho;
      }
    }
  });
}

/// On the isentrope through rest and hotter: colder matter cannot be had.
TEST(Eos, SoundSpeedIsRealInCompression) {
  samples::for_each<Eos>([](const auto& model) {
    const auto& eos = frozen(model, 0.0);
    const double h = 1e-3 * eos.rho0, top = std::min(eos.largest_density(), 2.1 * eos.rho0);
    double isentrope = 0;
    for (double rho = eos.rho0; rho + h < top; rho += h) {
      ASSERT_TRUE(eos.admissible(rho));
      for (const double e : {1e4, 1e5, 1e6}) {
        const double p = eos.pressure(rho, isentrope + e);
        EXPECT_GT(eos.sound_speed_squared(rho, p), 0) << model.kind << " rho/rho0 " << rho / eos.rho0;
      }
      const double p = eos.pressure(rho, isentrope), middle = rho + 0.5 * h;
      isentrope += h * eos.pressure(middle, isentrope + 0.5 * h * p / (rho * rho)) / (middle * middle);
    }
  });
}

TEST(Eos, SlopeOfTheColdCurveIsContinuousAtRest) {
  const auto check = [](const auto& eos) {
    const double h = 1e-9 * eos.rho0;
    EXPECT_NEAR(eos.cold_slope(eos.rho0 + h), eos.cold_slope(eos.rho0 - h), 1e-6 * eos.c0 * eos.c0);
  };
  for (const MieGruneisen& eos : samples::of(MieGruneisen{})) check(eos);
  for (const MieGruneisenCubic& eos : samples::of(MieGruneisenCubic{})) check(eos);
}

/// On the principal Hugoniot: p = rho0 U_s u, e = u^2/2, rho = rho0 U_s/(U_s - u) with U_s = c0 + s u.
TEST(MieGruneisen, ReproducesItsHugoniot) {
  for (const MieGruneisen& eos : samples::of(MieGruneisen{}))
    for (const double u : {10.0, 200.0, 1500.0}) {
      const double us = eos.c0 + eos.s * u;
      const double p = eos.rho0 * us * u;
      EXPECT_NEAR(eos.pressure(eos.rho0 * us / (us - u), 0.5 * u * u), p, 1e-10 * p + 1e-3);
    }
}

/// Down to 0.9 of the density at rest nothing but the straight line of the references.
TEST(MieGruneisen, IsStraightDownToNineTenthsOfRest) {
  for (const MieGruneisen& eos : samples::of(MieGruneisen{}))
    for (const double x : {0.9, 0.95, 0.99}) {
      const double rho = x * eos.rho0, line = eos.c0 * eos.c0 * (rho - eos.rho0);
      EXPECT_NEAR(eos.cold(rho), line, 1e-14 * eos.rho0 * eos.c0 * eos.c0);
      EXPECT_NEAR(eos.pressure(rho, 1e6), line + eos.gamma0 * eos.rho0 * 1e6, 1e-6);
    }
  const MieGruneisen eos{8930, 3940, 1.49, 2.0};
  const double h = 1e-7 * eos.rho0, at = 0.9 * eos.rho0;
  EXPECT_NEAR(eos.cold_slope(at - h), eos.cold_slope(at + h), 1e-6 * eos.c0 * eos.c0);
}

/// On the isentrope through rest tension ends, and matter comes near to the energy that evaporates it; what
/// is hotter and thin is a gas of Grueneisen coefficient 0.25.
TEST(MieGruneisen, ExpandsIntoAGas) {
  for (const MieGruneisen& eos : samples::of(MieGruneisen{})) {
    const double bulk = eos.rho0 * eos.c0 * eos.c0, h = 1e-4 * eos.rho0,
                 evaporation = eos.c0 * eos.c0 / eos.gamma0;
    double energy = 0, least = 0;
    for (double rho = eos.rho0; rho > 2e-3 * eos.rho0; rho -= h) {
      const double half = energy - 0.5 * h * eos.pressure(rho, energy) / (rho * rho), middle = rho - 0.5 * h;
      energy -= h * eos.pressure(middle, half) / (middle * middle);
      least = std::min(least, eos.pressure(rho - h, energy));
    }
    EXPECT_GT(energy, 0.9 * evaporation);
    EXPECT_LT(energy, evaporation);
    EXPECT_LT(least, -0.15 * bulk);
    EXPECT_GT(least, -0.20 * bulk);
    const double thin = 1.5e-3 * eos.rho0, p = eos.pressure(thin, 2 * evaporation);
    EXPECT_NEAR(p / (thin * evaporation), 0.25, 0.02);
    EXPECT_NEAR(eos.sound_speed_squared(thin, p) / (1.25 * p / thin), 1, 0.05);
  }
}

/// Vapour of a material of small Grueneisen coefficient may have less than p/rho.
TEST(Eos, WavesOfEvaporatingMatterRunAtLeastAsInAGas) {
  const MieGruneisen ptfe{2147, 1682, 1.819, 0.59};
  int slower = 0;
  for (double x = 0.01; x < 1; x += 0.01)
    for (double e = 1e6; e < 2e7; e += 5e5) {
      const double rho = x * ptfe.rho0, p = ptfe.pressure(rho, e), c2 = ptfe.sound_speed_squared(rho, p);
      if (p > 0 && c2 < p / rho) ++slower;
      EXPECT_DOUBLE_EQ(wave_speed_squared(ptfe, rho, p), std::max(c2, p / rho));
    }
  EXPECT_GT(slower, 0);
  const LinearEos solid{8930, 130e9};
  EXPECT_EQ(wave_speed_squared(solid, 8000.0, -1e9), solid.sound_speed_squared(8000.0, -1e9));
}

TEST(MieGruneisen, IsNotAdmissibleWhereTheHugoniotEnds) {
  const MieGruneisen eos{8930, 3940, 1.49, 2.0};
  EXPECT_TRUE(eos.admissible(0.999 * eos.largest_density()));
  EXPECT_FALSE(eos.admissible(1.001 * eos.largest_density()));
  EXPECT_FALSE(eos.admissible(0));
  EXPECT_FALSE(eos.admissible(-1));
  EXPECT_FALSE(eos.admissible(std::nan("")));
}

TEST(LinearEos, EnergyIsTheIntegralOfPressure) {
  const LinearEos eos{8930, 130e9};
  for (const double x : {0.5, 0.8, 0.99, 0.9999, 1.0001, 1.01, 1.3, 2.0, 2.9}) {
    const double exact = eos.bulk_modulus / eos.rho0 * (std::log(x) + 1 / x - 1);
    // The plain formula itself loses digits near 1.
    EXPECT_NEAR(eos.energy(x * eos.rho0, 0), exact, 1e-9 * exact + 1e-15 * eos.bulk_modulus / eos.rho0) << x;
  }
}

TEST(LinearEos, EnergyKeepsItsDigitsNearRest) {
  const LinearEos eos{8930, 130e9};
  const double d = 1e-7;  // e = K/rho0 (d^2/2 - 2 d^3/3 + ...)
  const double series = eos.bulk_modulus / eos.rho0 * (d * d / 2 - 2 * d * d * d / 3);
  EXPECT_NEAR(eos.energy(eos.rho0 * (1 + d), 0), series, 1e-8 * series);
}

/// Without s2, s3 and a it is Mie-Grueneisen, as far as matter is compressed.
TEST(MieGruneisenCubic, HasMieGruneisenAsASpecialCase) {
  const MieGruneisen plain{8930, 3940, 1.49, 2.0};
  const MieGruneisenCubic curved{8930, 3940, 1.49, 0, 0, 2.0, 0};
  for (const double rho : {8930.0, 9500.0, 14000.0})
    for (const double e : {0.0, 2e6}) {
      const double p = plain.pressure(rho, e), c2 = plain.sound_speed_squared(rho, p);
      EXPECT_NEAR(curved.pressure(rho, e), p, 1e-12 * p);
      EXPECT_NEAR(curved.sound_speed_squared(rho, p), c2, 1e-10 * c2);
    }
  EXPECT_NEAR(curved.largest_density(), plain.largest_density(), 1e-9 * plain.largest_density());
}

/// Steinberg's form: on the Hugoniot U_s - (s1 + s2 w + s3 w^2) u = c0 with w = u/U_s.
TEST(MieGruneisenCubic, ReproducesItsHugoniot) {
  for (const MieGruneisenCubic& eos : samples::of(MieGruneisenCubic{}))
    for (const double w : {0.01, 0.1, 0.3}) {
      const double us = eos.c0 / (1 - w * (eos.s1 + w * (eos.s2 + w * eos.s3))), u = w * us;
      const double p = eos.rho0 * us * u;
      EXPECT_NEAR(eos.pressure(eos.rho0 / (1 - w), 0.5 * u * u), p, 1e-10 * p);
    }
}

TEST(MieGruneisenCubic, TensionEndsAndThinMatterIsAGas) {
  const MieGruneisenCubic eos{8930, 3940, 1.489, 0, 0, 2.02, .47};
  const double k = 4 * 1.489 / 3, strongest = eos.rho0 * eos.c0 * eos.c0 / (4 * k);
  double least = 0, along = 0;  // along the isentrope through rest: e by small steps
  for (double rho = eos.rho0, h = 1e-4 * eos.rho0; rho > 0.3 * eos.rho0; rho -= h) {
    const double p = eos.pressure(rho, along), middle = rho - 0.5 * h;
    along -= h * eos.pressure(middle, along - 0.5 * h * p / (rho * rho)) / (middle * middle);
    least = std::min(least, p);
  }
  EXPECT_NEAR(least, -strongest, 1e-3 * strongest);
  const double thin = 1e-3 * eos.rho0, e = 1e7, cohesion = eos.c0 * eos.c0 / (2 * k * k);
  EXPECT_NEAR(eos.pressure(thin, e), eos.gamma0 * thin * (e - cohesion), 1e-6 * eos.gamma0 * thin * e);
}

constexpr MieGruneisenCubic vapour_of_copper{8930, 3940, 1.489, 0, 0, 2.02, .47, 5.31e6, .25};

/// Thin and hot it is the gas of its constant, which the energy of sublimation has been taken from; the
/// tension that it bears ends.
TEST(MieGruneisenCubic, EvaporatesAtTheEnergyOfSublimation) {
  const MieGruneisenCubic& eos = vapour_of_copper;
  const double thin = 1e-6 * eos.rho0, e = 1e7;
  EXPECT_NEAR(eos.pressure(thin, e), .25 * thin * (e - 5.31e6), 0.01 * .25 * thin * e);
  EXPECT_LT(eos.pressure(0.05 * eos.rho0, 5.2e6), 0);
  EXPECT_GT(eos.pressure(0.05 * eos.rho0, 5.4e6), 0);
  double least = 0;
  for (double part = 1; part > 0.1; part -= 0.001) least = std::min(least, eos.cold(part * eos.rho0));
  EXPECT_NEAR(least, -0.22 * eos.rho0 * eos.c0 * eos.c0, 0.01 * eos.rho0 * eos.c0 * eos.c0);
}

/// K' = dK/dp of the isentrope through rest is 4 s1 - 1 on both sides (third-order terms of the Hugoniot).
TEST(MieGruneisenCubic, BulkModulusHasOneSlopeAtRest) {
  for (const MieGruneisenCubic& eos : {vapour_of_copper, samples::of(MieGruneisenCubic{})[2]})
    for (const double step : {1e-4, -1e-4}) {
      // e = c0^2 step^2/2 to third order, which moves the modulus by the next order alone.
      const double rho = eos.rho0 * (1 + step), e = 0.5 * eos.c0 * eos.c0 * step * step,
                   p = eos.pressure(rho, e);
      const double modulus = rho * eos.sound_speed_squared(rho, p), at_rest = eos.rho0 * eos.c0 * eos.c0;
      EXPECT_NEAR((modulus - at_rest) / p, 4 * eos.s1 - 1, 0.01) << step;
    }
}

/// Released from 508 GPa (5 km/s), copper stays liquid: it keeps 2.2 of the 5.3 MJ/kg, and three quarters of
/// its density.
TEST(MieGruneisenCubic, StrongShocksReleaseToALiquid) {
  const MieGruneisenCubic& eos = vapour_of_copper;
  const double u = 5000, us = eos.c0 + eos.s1 * u;
  double rho = eos.rho0 * us / (us - u), e = 0.5 * u * u;
  for (const double h = 1e-5; eos.pressure(rho, e) > 0;) {
    const double middle = rho * (1 - 0.5 * h), half = e - 0.5 * h * eos.pressure(rho, e) / rho;
    e -= h * rho * eos.pressure(middle, half) / (middle * middle);
    rho *= 1 - h;
  }
  EXPECT_NEAR(rho / eos.rho0, 0.738, 0.003);
  EXPECT_NEAR(e, 2.23e6, 0.02e6);
}

/// Lead's Hugoniot bends until it no longer rises: from there on no density is admissible.
TEST(MieGruneisenCubic, EndsWhereTheHugoniotNoLongerRises) {
  const MieGruneisenCubic lead{11340, 2006, 1.429, .8506, -1.64, 2.74, .54};
  const double last = lead.largest_density();
  EXPECT_TRUE(lead.admissible(0.999 * last));
  EXPECT_FALSE(lead.admissible(1.001 * last));
  EXPECT_GT(last, 3 * lead.rho0);
}

/// Between e-iv and e-cv, and beyond, energy and sound speed still fit the pressure.
TEST(Tillotson, IsConsistentFromColdMatterToVapour) {
  for (const Tillotson& eos : samples::of(Tillotson{}))
    for (const double part : {0.02, 0.1, 0.4, 0.7, 0.95})
      for (const double x : {0.3, 0.9, 1.2, 1.6, 2.5, 5.9, 7.0}) {
        const double rho = part * eos.rho0, e = x * eos.e_iv, p = eos.pressure(rho, e);
        EXPECT_NEAR(eos.energy(rho, p), e, 1e-8 * e) << part << " " << x;
        const double h = 1e-5 * rho, de = h * p / (rho * rho);
        const double c2 = eos.sound_speed_squared(rho, p);
        const double curve = 0.5 * h * h * (c2 - 2 * p / rho) / (rho * rho);
        const double slope =
            (eos.pressure(rho + h, e + de + curve) - eos.pressure(rho - h, e - de + curve)) / (2 * h);
        EXPECT_NEAR(slope, c2, 2e-6 * (std::fabs(c2) + std::fabs(p / rho))) << part << " " << x;
      }
}

/// Pure forms: thin hot vapour is an ideal gas of gamma = 1 + a; pressure is continuous where forms end.
TEST(Tillotson, VapourIsAGasAndFormsMeet) {
  const Tillotson eos{2700, .5, 1.63, 75.2e9, 65e9, 5e6, 5, 5, 3e6, 13.9e6};
  EXPECT_NEAR(eos.pressure(0.01 * 2700, 2e7), 0.5 * 27 * 2e7, 1e-6 * 27 * 1e7);
  for (const double e : {eos.e_iv, eos.e_cv}) {
    const double p = eos.pressure(2000, e);
    EXPECT_NEAR(eos.pressure(2000, e * (1 - 1e-9)), eos.pressure(2000, e * (1 + 1e-9)), 1e-7 * std::fabs(p));
  }
  EXPECT_NEAR(eos.pressure(2700 * (1 - 1e-9), 2e7), eos.pressure(2700 * (1 + 1e-9), 2e7), 1e3);
}

/// Ice that has just evaporated has its own speed of sound, below the floor of a solid's, and may expand as
/// far as other vapours.
TEST(Tillotson, VapourIsSlowAndThin) {
  const Tillotson ice{917, .3, .1, 9.47e9, 9.47e9, 1e7, 10, 5, 7.73e5, 3.04e6};
  const double rho = 0.7 * 917, c2 = ice.sound_speed_squared(rho, ice.pressure(rho, 3.1e6));
  EXPECT_GT(c2, least_sound_squared(ice));
  EXPECT_LT(c2, 0.05 * 9.47e9 / 917);  // the floor of a solid
  EXPECT_LE(density_range(ice).least, 0.001);
}

/// Without pressure, beside the saturated liquid of the steam tables (100, 200, 300 C) [MJ/kg above 25 C]:
/// constants of the library, nothing fitted.
TEST(MieGruneisenCubic, WaterIsALiquidUntilItHasItsHeatOfEvaporation) {
  MieGruneisenCubic water{998, 1480, 2.56, -1.986, 0.2268, 0.5, 0, 2.44e6, 0.33};
  EXPECT_NEAR(water.energy(958.35, 0) * 1e-6, 0.314, 0.15);
  EXPECT_NEAR(water.energy(864.7, 0) * 1e-6, 0.746, 0.16);
  EXPECT_NEAR(water.energy(712.1, 0) * 1e-6, 1.228, 0.03);
  water.sublimation = 0;
  EXPECT_LT(water.energy(712.1, 0), 0.45e6);  // Morse's potential
}

/// A shock in air, exact: U_s = (gamma + 1)/4 u + sqrt(((gamma + 1)/4 u)^2 + c0^2).
TEST(IdealGas, HasTheHugoniotOfAnIdealGas) {
  const IdealGas air{1.2, 1.4, 101325};
  const double u = 1000, us = 0.6 * u + std::sqrt(0.36 * u * u + 1.4 * 101325 / 1.2);
  const double rho = 1.2 * us / (us - u), p = 1.2 * us * u;
  EXPECT_NEAR(air.pressure(rho, 0.5 * p * (1 / 1.2 - 1 / rho)), p, 1e-10 * p);
}

/// In absolute terms it is P = (gamma - 1) rho E - gamma p_inf.
TEST(IdealGas, MeasuresPressureAndEnergyFromRest) {
  for (const IdealGas& gas : samples::of(IdealGas{})) {
    const double rest = (gas.p0 + gas.gamma * gas.p_inf) / ((gas.gamma - 1) * gas.rho0);
    for (const double part : {0.1, 0.9, 3.0}) {
      const double rho = part * gas.rho0, absolute = 1.7 * rest;
      const double e = absolute - rest + gas.p0 / rho - gas.p0 / gas.rho0;
      const double p = (gas.gamma - 1) * rho * absolute - gas.gamma * gas.p_inf - gas.p0;
      EXPECT_NEAR(gas.pressure(rho, e), p, 1e-11 * (std::fabs(p) + gas.gamma * (gas.p0 + gas.p_inf)));
    }
  }
}

TEST(Eos, QuickExponentialHasAllDigits) {
  for (double x = -699; x < 700; x += 0.137) EXPECT_NEAR(quick_exp(x) / std::exp(x), 1, 5e-16) << x;
  EXPECT_EQ(quick_exp(0), 1);
  EXPECT_GT(quick_exp(-1e9), 0);
  EXPECT_TRUE(std::isfinite(quick_exp(1e9)));
}

}  // namespace
}  // namespace recoil::eos_test
