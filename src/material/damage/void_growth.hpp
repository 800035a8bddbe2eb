#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "material/damage/damage_point.hpp"
#include "material/parameter.hpp"

namespace recoil {

/// Nucleation and growth of voids in a ductile metal (Barbee, Seaman, Crewdson & Curran, J. Materials 7
/// (1972) 393), with the volume of voids as the one measure of damage, D = f/f_c. Where the mean tension
/// s = -p exceeds its thresholds,
///   df/dt = 8 pi R^3 N exp((s - s_n)/s_1) + 3 f (s - s_g)/(4 eta):
/// new voids, N per volume and time of size R, and viscous growth of those there are.
struct VoidGrowth {
  double nucleation_stress = unset;  // Pa, s_n
  double nucleation_scale = unset;   // Pa, s_1
  double nucleation_rate = unset;    // 1/(m3 s), N
  double nucleation_size = unset;    // m, R
  double growth_stress = unset;      // Pa, s_g
  double viscosity = unset;          // Pa s, eta
  double failure_fraction = 0.3;     // f_c: voids that join

  static constexpr const char* kind = "void-growth";
  static constexpr const char* doc = "nucleation and viscous growth of voids in ductile metals";
  /// The exponential of nucleation ends here: beyond it everything fails in a step.
  static constexpr double most_exponent = 50;

  static constexpr auto parameters() {
    using V = VoidGrowth;
    using P = Parameter<V>;
    return std::array{
        P{"nucleation-stress", "Pa", &V::nucleation_stress, 0, 1e12, "mean tension that makes voids"},
        P{"nucleation-scale", "Pa", &V::nucleation_scale, 1, 1e12, "tension that makes e times as many"},
        P{"nucleation-rate", "1/(m3 s)", &V::nucleation_rate, 0, 1e30, "voids made at that tension"},
        P{"nucleation-size", "m", &V::nucleation_size, 1e-9, 1e-2, "size of new voids"},
        P{"growth-stress", "Pa", &V::growth_stress, 0, 1e12, "mean tension from which on voids grow"},
        P{"viscosity", "Pa s", &V::viscosity, 1e-6, 1e9, "that slows their growth"},
        P{"failure-fraction", "1", &V::failure_fraction, 1e-4, 1, "part of the volume at which voids join"}};
  }

  double growth(const DamagePoint& at) const {
    const double tension = -at.pressure;
    double rate = 0;
    if (tension > nucleation_stress)
      rate += 8 * std::numbers::pi * nucleation_size * nucleation_size * nucleation_size * nucleation_rate *
              std::exp(std::min((tension - nucleation_stress) / nucleation_scale, most_exponent));
    double grown = rate * at.dt / failure_fraction;
    // The growth of what is there over the step is exponential.
    if (tension > growth_stress) {
      const double exponent = std::min(0.75 * (tension - growth_stress) / viscosity * at.dt, most_exponent);
      grown += at.damage * std::expm1(exponent);
    }
    return grown;
  }
};

}  // namespace recoil
