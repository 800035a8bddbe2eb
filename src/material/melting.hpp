#pragma once

#include <array>
#include <cmath>

#include "material/parameter.hpp"

namespace recoil {

/// How matter melts: [melting] of a material. Without a temperature it does not, but for what its strength
/// model knows of it. The melting temperature rises with density by Lindemann's law,
///   d ln T_m/d ln rho = 2 (Gamma - 1/3),
/// with the Grueneisen coefficient of the equation of state, see TemperatureLaw::melting_at(), or with
/// constants of its own, as Steinberg, Cochran & Guinan, J. Appl. Phys. 51 (1980) 1498 write it:
///   T_m = T_m0 exp(2 a (1 - 1/x)) x^(2 (gamma0 - a - 1/3)), x = rho/rho0.
struct Melting {
  double temperature = unset;  // K, without pressure
  double heat = 0;             // J/kg, latent heat of fusion
  double slope = unset;        // 1, a; not a number: by the equation of state
  double gamma0 = unset;       // 1; likewise
  bool at_rest = false;  // the temperature is that at rest density, and not of matter expanded by its heat

  static constexpr auto parameters() {
    using P = Parameter<Melting>;
    return std::array{
        P{"temperature", "K", &Melting::temperature, 50, 1e4, "melting temperature without pressure"},
        P{"heat", "J/kg", &Melting::heat, 0, 1e7, "latent heat of fusion"},
        P{"slope", "1", &Melting::slope, 0, 5, "a of Lindemann's law; without it by the equation of state"},
        P{"gamma0", "1", &Melting::gamma0, 0, 5, "Grueneisen coefficient of Lindemann's law; likewise"}};
  }

  bool melts() const { return !std::isnan(temperature); }
  bool has_own_curve() const { return !std::isnan(slope); }

  /// T_m/T_m0 by the constants of its own.
  double growth(double compression) const {
    return std::exp(2 * slope * (1 - 1 / compression)) *
           std::pow(compression, 2 * (gamma0 - slope - 1.0 / 3));
  }
};

/// What is molten of a state.
struct Melt {
  double molten = 0;       // 0 to 1
  double temperature = 0;  // K
  double at = infinite;    // K, its melting temperature
  double unmelted = 0;     // K, the temperature without latent heat
};

/// @param unmelted temperature [K] that the state would have without latent heat. @param at its melting
/// temperature [K]. @param delay latent heat over specific heat [K].
inline Melt melt(double unmelted, double at, double delay) {
  const double excess = unmelted - at;
  if (!(excess >= 0)) return {0, unmelted, at, unmelted};
  if (excess >= delay) return {1, unmelted - delay, at, unmelted};
  return {excess / delay, at, at, unmelted};
}

}  // namespace recoil
