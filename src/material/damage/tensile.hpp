#pragma once

#include <array>
#include <cmath>

#include "material/damage/damage_point.hpp"
#include "material/parameter.hpp"

namespace recoil {

/// Cumulative tensile damage (Tuler & Butcher, Int. J. Fract. Mech. 4 (1968) 431):
///   dD/dt = (sigma_1/sigma_0 - 1)^n / tau while the largest principal stress sigma_1 exceeds sigma_0.
struct TensileDamage {
  double threshold = unset;  // Pa, sigma_0
  double exponent = 1;       // n
  double time = unset;       // s, tau: to failure at twice the threshold

  static constexpr const char* kind = "tensile";
  static constexpr const char* doc =
      "Tuler-Butcher: grows with the tension beyond a threshold, and with time";

  static constexpr auto parameters() {
    using T = TensileDamage;
    using P = Parameter<T>;
    return std::array{
        P{"threshold", "Pa", &T::threshold, 1, 1e12, "largest principal stress from which on damage grows"},
        P{"exponent", "1", &T::exponent, 0, 10, "power of the tension beyond the threshold"},
        P{"time", "s", &T::time, 1e-12, 1, "time to failure at twice the threshold"}};
  }

  double growth(const DamagePoint& at) const {
    const double beyond = at.principal / threshold - 1;
    if (!(beyond > 0)) return 0;
    return at.dt / time * (exponent == 1 ? beyond : std::pow(beyond, exponent));
  }
};

}  // namespace recoil
