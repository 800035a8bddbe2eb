#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "material/parameter.hpp"
#include "material/strength/yield_state.hpp"

namespace recoil {

/// Steinberg, Cochran & Guinan, J. Appl. Phys. 51 (1980) 1498, for high rates; with eta = rho/rho0
///   Y = min(y0 (1 + beta ep)^n, y_max) (1 + a p/eta^(1/3) - b (T - 300 K)), not below 0,
///   0 from the melting temperature on, T_m = T_m0 exp(2 s (1 - 1/eta)) eta^(2 (gamma0 - s - 1/3)).
/// In the source the shear modulus follows pressure and temperature with the same factor; here it does so to
/// the part `modulus_follows`, of which the default 0 keeps it at its value at rest: elastic waves in
/// compressed matter are then too slow.
struct SteinbergGuinan {
  double shear_modulus = unset;        // Pa, at rest and 300 K
  double y0 = unset, y_max = unset;    // Pa
  double beta = unset, n = unset;      // 1
  double a = unset;                    // 1/Pa
  double b = unset;                    // 1/K
  double melting_temperature = unset;  // K, at rest density
  double melting_slope = 1.5;          // s
  double gamma0 = unset;               // 1
  double modulus_follows = 0;          // 1

  static constexpr double least_modulus = 0.01;  // of that at rest: waves need one
  static constexpr const char* kind = "steinberg-guinan";
  static constexpr const char* doc =
      "Steinberg-Cochran-Guinan: yield stress with pressure, temperature and hardening; no rate";
  static constexpr bool rate_dependent = true;  // for its curve over strain
  static constexpr bool pressure_dependent = true;

  static constexpr auto parameters() {
    using S = SteinbergGuinan;
    using P = Parameter<S>;
    return std::array{
        P{"shear-modulus", "Pa", &S::shear_modulus, 1, 1e13, "shear modulus at rest and 300 K"},
        P{"y0", "Pa", &S::y0, 0, 1e12, "yield stress at rest and 300 K"},
        P{"y-max", "Pa", &S::y_max, 0, 1e12, "the most that hardening reaches, at rest and 300 K"},
        P{"beta", "1", &S::beta, 0, 1e5, "hardening"},
        P{"n", "1", &S::n, 0, 2, "exponent of hardening"},
        P{"a", "1/Pa", &S::a, 0, 1e-8, "relative growth with pressure"},
        P{"b", "1/K", &S::b, 0, 0.01, "relative fall with temperature"},
        P{"melting-temperature", "K", &S::melting_temperature, 50, 1e4,
          "melting temperature at rest density"},
        P{"melting-slope", "1", &S::melting_slope, 0, 5, "the source's a of the melting law"},
        P{"gamma0", "1", &S::gamma0, 0.01, 5, "Grueneisen coefficient of the melting law"},
        P{"modulus-follows", "1", &S::modulus_follows, 0, 1,
          "part in which the shear modulus follows pressure and temperature as the yield stress does; 1: as "
          "in "
          "the source, 0: it stays"}};
  }

  /// What is wrong with the constants together; null: nothing.
  constexpr const char* problem() const { return y_max < y0 ? "y-max must not be below y0" : nullptr; }

  /// Melting temperature [K] at density over that at rest.
  double melting_at(double compression) const {
    return melting_temperature * std::exp(2 * melting_slope * (1 - 1 / compression)) *
           std::pow(compression, 2 * (gamma0 - melting_slope - 1.0 / 3));
  }

  double yield(const YieldState& s) const {
    return s.temperature >= melting_at(s.compression) ? 0.0 : yield_of_solid(s);
  }

  /// The same of matter that is known to be solid.
  double yield_of_solid(const YieldState& s) const {
    const double hardened = std::min(y0 * std::pow(1 + beta * s.ep, n), y_max);
    const double state = 1 + a * s.pressure / std::cbrt(s.compression) - b * (s.temperature - 300);
    return hardened * std::max(state, 0.0);
  }

  /// Shear modulus [Pa] of a state.
  double modulus(const YieldState& s) const {
    const double growth = a * s.pressure / std::cbrt(s.compression) - b * (s.temperature - 300);
    return shear_modulus * std::max(1 + modulus_follows * growth, least_modulus);
  }
};

}  // namespace recoil
