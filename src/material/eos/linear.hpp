#pragma once

#include <array>
#include <cmath>

#include "material/parameter.hpp"

namespace recoil {

/// p = K (rho/rho0 - 1), whatever the energy: the linear bulk law of the Taylor-bar literature.
struct LinearEos {
  double rho0 = unset;          // kg/m3
  double bulk_modulus = unset;  // Pa

  static constexpr const char* kind = "linear";
  static constexpr const char* doc = "pressure linear in density, independent of energy";
  static constexpr bool barotropic = true;

  static constexpr auto parameters() {
    using P = Parameter<LinearEos>;
    return std::array{P{"density", "kg/m3", &LinearEos::rho0, 1, 3e4, "density at rest"},
                      P{"bulk-modulus", "Pa", &LinearEos::bulk_modulus, 1e5, 1e13, "bulk modulus"}};
  }

  /// Pressure [Pa] at density rho [kg/m3]; the energy does not matter.
  constexpr double pressure(double rho, double /*e*/) const { return bulk_modulus * (rho / rho0 - 1); }

  /// The elastic (cold) energy [J/kg], the integral of p/rho^2 from rho0 to rho:
  /// K/rho0 (ln(rho/rho0) + rho0/rho - 1). The logarithm is its series in z = (rho - rho0)/(rho + rho0),
  /// arranged so that nothing cancels near rho0 and loops vectorise: relative error below 1e-9 over
  /// the admissible range, below 1e-14 for rho within a factor 2 of rho0.
  constexpr double energy(double rho, double /*p*/) const {
    const double z = (rho - rho0) / (rho + rho0);
    const double zz = z * z;
    double tail = 1.0 / 33;
    for (int k = 31; k >= 3; k -= 2) tail = tail * zz + 1.0 / k;
    return 2 * bulk_modulus / rho0 * zz * (1 / (1 + z) + z * tail);
  }

  /// (dp/drho) [m2/s2].
  constexpr double sound_speed_squared(double /*rho*/, double /*p*/) const { return bulk_modulus / rho0; }

  /// Whether the density is within the range of the series of energy().
  constexpr bool admissible(double rho) const { return rho > 0.34 * rho0 && rho < largest_density(); }

  constexpr double largest_density() const { return 3 * rho0; }
};

/// Bulk sound speed at rest [m/s].
inline double bulk_sound_speed(const LinearEos& eos) { return std::sqrt(eos.bulk_modulus / eos.rho0); }

}  // namespace recoil
