#pragma once

#include <array>
#include <cmath>

#include "material/eos/density_range.hpp"
#include "material/eos/quick_exp.hpp"
#include "material/parameter.hpp"

namespace recoil {

/// Products of a detonation: Jones, Wilkins and Lee (Lee, Hornig & Kury, UCRL-50422, 1968), with V = rho0/rho
///   p = a (1 - omega/(r1 V)) exp(-r1 V) + b (1 - omega/(r2 V)) exp(-r2 V) + omega rho E.
/// e = E - E_rest, where E_rest is the energy of products without pressure at the density of the explosive.
/// Rest is therefore cold products, not the explosive: what detonates in place begins at detonated_energy().
struct Jwl {
  double rho0 = unset;                 // kg/m3, of the explosive
  double a = unset, b = unset;         // Pa
  double r1 = unset, r2 = unset;       // 1
  double omega = unset;                // 1, Grueneisen coefficient of thin products
  double energy0 = unset;              // J/m3 of explosive
  double detonation_velocity = unset;  // m/s

  static constexpr const char* kind = "jwl";
  static constexpr const char* doc = "products of a detonated explosive: Jones, Wilkins and Lee";
  static constexpr bool barotropic = false;
  static constexpr bool fluid = true;
  static constexpr DensityRange range{1e-30, 8};  // for shocks that run to a point (decision 0081)

  static constexpr auto parameters() {
    using P = Parameter<Jwl>;
    return std::array{
        P{"density", "kg/m3", &Jwl::rho0, 100, 3e3, "density of the explosive"},
        P{"a", "Pa", &Jwl::a, 1e9, 1e13, "first pressure"},
        P{"b", "Pa", &Jwl::b, -1e11, 1e12, "second pressure"},
        P{"r1", "1", &Jwl::r1, 1, 20, "first exponent"},
        P{"r2", "1", &Jwl::r2, 0.1, 10, "second exponent"},
        P{"omega", "1", &Jwl::omega, 0.05, 1, "Grueneisen coefficient of thin products"},
        P{"energy", "J/m3", &Jwl::energy0, 1e8, 3e10, "energy of detonation per volume of explosive"},
        P{"detonation-velocity", "m/s", &Jwl::detonation_velocity, 1000, 12000,
          "measured; lint compares it with what the other constants give"}};
  }

  /// Pressure [Pa] at density rho [kg/m3] and energy e [J/kg] above rest.
  constexpr double pressure(double rho, double e) const {
    return fixed(rho).pressure + omega * rho * (e + rest_energy());
  }

  /// Specific internal energy [J/kg] above rest at density rho and pressure p [Pa].
  constexpr double energy(double rho, double p) const {
    return (p - fixed(rho).pressure) / (omega * rho) - rest_energy();
  }

  /// (dp/drho) at constant entropy [m2/s2].
  constexpr double sound_speed_squared(double rho, double p) const {
    const Fixed at = fixed(rho);
    return at.slope + ((1 + omega) * p - at.pressure) / rho;
  }

  constexpr bool admissible(double rho) const { return rho > 0 && rho < largest_density(); }
  constexpr double largest_density() const { return range.most * rho0; }

  /// e [J/kg] of products that have detonated without motion: all of the energy is still in them.
  constexpr double detonated_energy() const { return energy0 / rho0 - rest_energy(); }

 private:
  struct Fixed {
    double pressure, slope;  // Pa, m2/s2
  };
  /// What does not depend on the energy.
  constexpr Fixed fixed(double rho) const {
    const double x = rho / rho0;
    const double first = a * quick_exp(-r1 / x), second = b * quick_exp(-r2 / x);
    const double part1 = 1 - omega * x / r1, part2 = 1 - omega * x / r2;
    return {
        first * part1 + second * part2,
        (first * (part1 * r1 / (x * x) - omega / r1) + second * (part2 * r2 / (x * x) - omega / r2)) / rho0};
  }
  constexpr double rest_energy() const { return -fixed(rho0).pressure / (omega * rho0); }
};

/// Bulk sound speed at rest [m/s].
inline double bulk_sound_speed(const Jwl& eos) { return std::sqrt(eos.sound_speed_squared(eos.rho0, 0)); }

}  // namespace recoil
