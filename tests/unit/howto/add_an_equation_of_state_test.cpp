// What docs/how-to/add-an-equation-of-state.md shows, compiled and tried. Its blocks of C++ stand here word
// for word.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "material/model_keys.hpp"

namespace recoil {

/// Murnaghan's equation, p = K/n ((rho/rho0)^n - 1), whatever the energy. F. D. Murnaghan, The
/// compressibility of media under extreme pressures, PNAS 30 (1944) 244.
struct Murnaghan {
  double rho0 = unset;          // kg/m3
  double bulk_modulus = unset;  // Pa, at rest
  double n = unset;             // slope of the bulk modulus over pressure

  static constexpr const char* kind = "murnaghan";
  static constexpr const char* doc = "bulk modulus linear in pressure, independent of energy";
  static constexpr bool barotropic = true;

  static constexpr auto parameters() {
    using P = Parameter<Murnaghan>;
    return std::array{P{"density", "kg/m3", &Murnaghan::rho0, 1, 3e4, "density at rest"},
                      P{"bulk-modulus", "Pa", &Murnaghan::bulk_modulus, 1e5, 1e13, "bulk modulus at rest"},
                      P{"n", "1", &Murnaghan::n, 1.1, 15, "slope of the bulk modulus over pressure"}};
  }

  /// Pressure [Pa] at density rho [kg/m3].
  double pressure(double rho, double /*e*/) const { return bulk_modulus / n * (std::pow(rho / rho0, n) - 1); }
  /// The integral of p/rho^2 from rho0 [J/kg].
  double energy(double rho, double /*p*/) const {
    const double x = rho / rho0;
    return bulk_modulus / (n * rho0) * ((std::pow(x, n - 1) - 1) / (n - 1) + 1 / x - 1);
  }
  /// (dp/drho) [m2/s2].
  double sound_speed_squared(double rho, double /*p*/) const {
    return bulk_modulus / rho0 * std::pow(rho / rho0, n - 1);
  }
  bool admissible(double rho) const { return rho > 0.1 * rho0 && rho < largest_density(); }
  double largest_density() const { return 3 * rho0; }
};

/// Bulk sound speed at rest [m/s].
inline double bulk_sound_speed(const Murnaghan& eos) { return std::sqrt(eos.bulk_modulus / eos.rho0); }

namespace {

TEST(HowToAddAnEquationOfState, TheModelIsConsistent) {
  const Murnaghan water{998, 2.2e9, 7.15};
  EXPECT_EQ(water.pressure(998, 0), 0);
  EXPECT_EQ(water.energy(998, 0), 0);
  EXPECT_NEAR(water.sound_speed_squared(998, 0), std::pow(bulk_sound_speed(water), 2), 1e-6);
  for (const double rho : {800.0, 1100.0, 1500.0}) {
    const double h = 1e-3;
    EXPECT_NEAR((water.energy(rho + h, 0) - water.energy(rho - h, 0)) / (2 * h) * rho * rho,
                water.pressure(rho, 0), 1e-5 * std::abs(water.pressure(rho, 0)));
    EXPECT_NEAR((water.pressure(rho + h, 0) - water.pressure(rho - h, 0)) / (2 * h),
                water.sound_speed_squared(rho, 0), 1e-6 * water.sound_speed_squared(rho, 0));
  }
}

TEST(HowToAddAnEquationOfState, ItsKeysFollowFromTheParameters) {
  const std::vector<config::Key> keys = model_keys::keys_of_model<Murnaghan>();
  ASSERT_EQ(keys.size(), 3U);
  EXPECT_TRUE(keys[2].required);
  EXPECT_EQ(keys[2].maximum, 15);
}

}  // namespace
}  // namespace recoil
