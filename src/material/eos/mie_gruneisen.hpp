#pragma once

#include <array>

#include "material/eos/density_range.hpp"
#include "material/parameter.hpp"

namespace recoil {

/// Mie-Grueneisen with the principal Hugoniot U_s = c0 + s u_p as its reference:
///   p = Gamma rho e + f(rho),  Gamma rho = Gamma0 rho0,  Phi = 1 - rho0/rho,
///   f = rho0 c0^2 Phi/(1 - s Phi)^2 (1 - Gamma0 Phi/2) in compression, c0^2 (rho - rho0) in expansion.
/// The latter is p = Gamma rho (e - e_b), e_b = c0^2/Gamma0 (1 - rho/rho0): at c0^2/Gamma0 matter evaporates.
/// Below 0.9 rho0, where a constant Gamma rho would give thin matter any tension and any pressure, it falls
/// with x = rho/(0.9 rho0),
///   Gamma rho = Gamma0 rho0 (1 - (1 - x)^2 (1 + 2 (1 - h) x)),  h = min(1/2, 0.1125/Gamma0),
/// so that Gamma ends at 0.25 (ours: docs/decisions/0072).
/// e [J/kg] is zero at rho0 and zero pressure. All functions are free of branches: loops over arrays
/// of cells call them and must vectorise. See docs/theory.md, equation of state.
struct MieGruneisen {
  double rho0 = unset;    // kg/m3
  double c0 = unset;      // m/s, bulk sound speed at rho0
  double s = unset;       // slope of the Hugoniot
  double gamma0 = unset;  // Grueneisen coefficient at rho0

  static constexpr const char* kind = "mie-gruneisen";
  static constexpr const char* doc = "Mie-Grueneisen on the principal Hugoniot U_s = c0 + s u_p";
  static constexpr bool barotropic = false;
  /// 1 - s Phi is kept from going below this; states beyond are not admissible().
  static constexpr double guard = 0.1;
  /// Density, as a part of that at rest, below which Gamma rho falls.
  static constexpr double straight_to = 0.9;

  static constexpr bool evaporates() { return true; }
  static constexpr DensityRange range{0.001, 2.5};

  static constexpr auto parameters() {
    using P = Parameter<MieGruneisen>;
    return std::array{P{"density", "kg/m3", &MieGruneisen::rho0, 1, 3e4, "density at rest"},
                      P{"c0", "m/s", &MieGruneisen::c0, 10, 2e4, "bulk sound speed at rest"},
                      P{"s", "1", &MieGruneisen::s, 0, 5, "slope of shock speed over particle speed"},
                      P{"gamma0", "1", &MieGruneisen::gamma0, 0.01, 5, "Grueneisen coefficient at rest"}};
  }

  /// Pressure [Pa] at density rho [kg/m3] and specific internal energy e [J/kg].
  constexpr double pressure(double rho, double e) const { return gamma0 * rho0 * fall(rho) * e + cold(rho); }

  /// Specific internal energy [J/kg] at density rho and pressure p [Pa].
  constexpr double energy(double rho, double p) const {
    return (p - cold(rho)) / (gamma0 * rho0 * fall(rho));
  }

  /// (dp/drho) at constant entropy [m2/s2]: f' + (Gamma rho)' e + Gamma rho p/rho^2. No floor: negative where
  /// the state is unstable. In expansion the first two are c0^2 F + p F'/F, F = Gamma rho/(Gamma0 rho0).
  constexpr double sound_speed_squared(double rho, double p) const {
    const double per_rho = 1 / rho, part_of_rest = fall(rho);
    const double expanded = c0 * c0 * part_of_rest + p * (fall_slope(rho) / part_of_rest);
    const double along = rho0 * per_rho <= 1 ? cold_slope_compressed(rho0 * per_rho) : expanded;
    return along + gamma0 * rho0 * part_of_rest * p * (per_rho * per_rho);
  }

  /// Whether the equation of state means anything at this density.
  constexpr bool admissible(double rho) const { return rho > 0 && 1 - s * (1 - rho0 / rho) > guard; }

  /// The largest admissible density (infinite for a small s).
  constexpr double largest_density() const {
    const double phi = s > 0 ? (1 - guard) / s : 1.0;
    return phi < 1 ? rho0 / (1 - phi) : infinite;
  }

  /// f(rho) [Pa]: the pressure where e = 0.
  constexpr double cold(double rho) const {
    const double phi = 1 - rho0 * (1 / rho);
    const double d = guarded(1 - s * phi);
    const double compressed = rho0 * c0 * c0 * phi * (1 - 0.5 * gamma0 * phi) / (d * d);
    const double expanded = c0 * c0 * (rho - rho0) * fall(rho);
    return phi >= 0 ? compressed : expanded;
  }

  /// f'(rho) [m2/s2].
  constexpr double cold_slope(double rho) const {
    const double x = rho0 * (1 / rho);
    const double expanded = c0 * c0 * (fall(rho) + (rho - rho0) * fall_slope(rho));
    return x <= 1 ? cold_slope_compressed(x) : expanded;
  }

 private:
  /// f'(rho) in compression, by x = rho0/rho.
  constexpr double cold_slope_compressed(double x) const {
    const double phi = 1 - x, per_d = 1 / guarded(1 - s * phi);
    const double by_phi = 1 - gamma0 * phi + 2 * s * phi * (1 - 0.5 * gamma0 * phi) * per_d;
    return c0 * c0 * by_phi * (per_d * per_d) * (x * x);
  }
  /// rho/(0.9 rho0), from something above 0 to 1.
  constexpr double part(double rho) const {
    const double x = rho * (1 / (straight_to * rho0));
    return x < 1 ? (x > 1e-9 ? x : 1e-9) : 1;
  }
  /// h of Gamma rho.
  constexpr double gas_part() const { return gamma0 > 0.225 ? 0.1125 / gamma0 : 0.5; }
  /// Gamma rho by that at rest.
  constexpr double fall(double rho) const {
    const double x = part(rho);
    return 1 - (1 - x) * (1 - x) * (1 + 2 * (1 - gas_part()) * x);
  }
  /// Its slope [m3/kg].
  constexpr double fall_slope(double rho) const {
    const double x = part(rho), k = 2 * (1 - gas_part());
    return (1 - x) * (2 - k + 3 * k * x) * (1 / (straight_to * rho0));
  }
  static constexpr double guarded(double d) { return d > guard ? d : guard; }
};

/// Bulk sound speed at rest [m/s].
constexpr double bulk_sound_speed(const MieGruneisen& eos) { return eos.c0; }

}  // namespace recoil
