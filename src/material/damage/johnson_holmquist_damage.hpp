#pragma once

#include <array>
#include <cmath>

#include "material/damage/damage_point.hpp"
#include "material/parameter.hpp"

namespace recoil {

/// The damage of Johnson and Holmquist's second model (see JohnsonHolmquist): dD = d ep/ep_f,
///   ep_f = d1 (p* + T*)^d2;
/// and matter fails at once where the pressure falls below -T (1 - D), the tension that is left of T.
/// T and the pressure that normalises are those of the strength, which reading a material sets.
struct JohnsonHolmquistDamage {
  double d1 = unset, d2 = unset;
  double tension = unset;       // Pa, of the strength
  double hel_pressure = unset;  // Pa, of the strength

  static constexpr const char* kind = "johnson-holmquist";
  static constexpr const char* doc =
      "Johnson-Holmquist 2: grows with plastic strain, by pressure; with strength of the same kind";
  static constexpr double least_strain = 1e-9;  // of ep_f: what has none fails at once

  static constexpr auto parameters() {
    using J = JohnsonHolmquistDamage;
    using P = Parameter<J>;
    return std::array{P{"d1", "1", &J::d1, 0, 100, "strain to fracture where p* + T* is 1"},
                      P{"d2", "1", &J::d2, 0, 10, "exponent of the strain to fracture over pressure"}};
  }

  /// Plastic strain to fracture at constant pressure [Pa].
  double failure_strain(double pressure) const {
    const double base = (pressure + tension) / hel_pressure;
    return base > 0 ? d1 * std::pow(base, d2) : 0.0;
  }

  double growth(const DamagePoint& at) const {
    if (at.pressure < -tension * (1 - at.damage)) return 1;
    if (!(at.strain_growth > 0)) return 0;
    const double strain = failure_strain(at.pressure);
    return at.strain_growth / (strain > least_strain ? strain : least_strain);
  }
};

}  // namespace recoil
