#pragma once

#include <array>
#include <cmath>

#include "material/eos/density_range.hpp"
#include "material/parameter.hpp"

namespace recoil {

/// Ideal gas, or with a stiffness p_inf > 0 stiffened gas (Harlow & Amsden, LA-4700, 1971):
///   P = (gamma - 1) rho E - gamma p_inf.
/// Pressures are measured from that of the state at rest, p = P - p0: empty space then presses with p0 on
/// every free surface, and gas at rest stays at rest. The energy that goes with it, e = E - E0 + p0/rho -
/// p0/rho0, is zero at rest, and obeys de = -p d(1/rho) on an isentrope as E obeys with P. In these terms
/// both gases have one form, P_inf = p0 + p_inf:
///   p = (gamma - 1) rho e + (gamma/rho0) P_inf (rho - rho0),   c^2 = gamma (p + P_inf)/rho.
struct IdealGas {
  double rho0 = unset;   // kg/m3
  double gamma = unset;  // ratio of specific heats
  double p0 = unset;     // Pa, pressure at rest
  double p_inf = 0;      // Pa, 0: ideal

  static constexpr const char* kind = "ideal-gas";
  static constexpr const char* doc =
      "ideal gas, or stiffened gas for liquids; pressures are measured from that at rest";
  static constexpr bool barotropic = false;
  static constexpr bool fluid = true;
  /// Gas has neither tension nor a hard core: shocks that converge to a point compress it to some hundred
  /// times (64 times in Noh's problem with gamma 5/3, J. Comput. Phys. 72 (1987) 78).
  static constexpr DensityRange range{1e-30, 1e4};

  static constexpr auto parameters() {
    using P = Parameter<IdealGas>;
    return std::array{
        P{"density", "kg/m3", &IdealGas::rho0, 1e-3, 3e4, "density at rest"},
        P{"gamma", "1", &IdealGas::gamma, 1.01, 10, "ratio of specific heats"},
        P{"pressure", "Pa", &IdealGas::p0, 1, 1e12, "pressure at rest, which empty space has too"},
        P{"stiffness", "Pa", &IdealGas::p_inf, 0, 1e12, "of a stiffened gas; 0: ideal gas"}};
  }

  /// Pressure [Pa] above that at rest, at density rho [kg/m3] and energy e [J/kg].
  constexpr double pressure(double rho, double e) const { return (gamma - 1) * rho * e + cold(rho); }

  /// Specific internal energy [J/kg] at density rho and pressure p [Pa].
  constexpr double energy(double rho, double p) const { return (p - cold(rho)) / ((gamma - 1) * rho); }

  /// (dp/drho) at constant entropy [m2/s2].
  constexpr double sound_speed_squared(double rho, double p) const { return gamma * (p + p0 + p_inf) / rho; }

  constexpr bool admissible(double rho) const { return rho > 0; }
  constexpr double largest_density() const { return infinite; }

  /// The pressure where e = 0 [Pa].
  constexpr double cold(double rho) const { return gamma * (p0 + p_inf) * (rho - rho0) / rho0; }
};

/// Bulk sound speed at rest [m/s].
inline double bulk_sound_speed(const IdealGas& eos) {
  return std::sqrt(eos.gamma * (eos.p0 + eos.p_inf) / eos.rho0);
}

}  // namespace recoil
