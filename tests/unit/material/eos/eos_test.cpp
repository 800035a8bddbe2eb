#include "material/eos/eos.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../samples.hpp"

namespace recoil {
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
    for (const double rho : densities(eos))
      for (const double e : {-1e5, 0.0, 3e4, 2e6}) {
        const double p = eos.pressure(rho, e);
        EXPECT_NEAR(eos.energy(rho, p), e, 1e-9 * (std::fabs(e) + std::fabs(p) / eos.rho0)) << rho;
      }
  });
}

/// Along an isentrope de/drho = p/rho^2, so dp/drho is the sound speed squared and, for a barotropic
/// material, the energy is the integral of that.
TEST(Eos, SoundSpeedIsTheSlopeOfTheIsentrope) {
  samples::for_each<Eos>([](const auto& eos) {
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
            << eos.kind << " rho " << rho;
      }
    }
  });
}

TEST(Eos, SoundSpeedIsRealInCompression) {
  samples::for_each<Eos>([](const auto& eos) {
    for (const double rho : densities(eos)) {
      if (rho < eos.rho0) continue;
      ASSERT_TRUE(eos.admissible(rho));
      for (const double e : {1e4, 1e5, 1e6}) {
        const double p = std::max(eos.pressure(rho, e), 0.0);
        EXPECT_GT(eos.sound_speed_squared(rho, p), 0) << eos.kind << " rho/rho0 " << rho / eos.rho0;
      }
    }
  });
}

TEST(Eos, SlopeOfTheColdCurveIsContinuousAtRest) {
  for (const MieGruneisen& eos : samples::of(MieGruneisen{})) {
    const double h = 1e-9 * eos.rho0;
    EXPECT_NEAR(eos.cold_slope(eos.rho0 + h), eos.cold_slope(eos.rho0 - h), 1e-6 * eos.c0 * eos.c0);
  }
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

}  // namespace
}  // namespace recoil
