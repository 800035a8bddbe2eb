#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "material/damage/damage_point.hpp"
#include "material/parameter.hpp"

namespace recoil {

/// Johnson & Cook (Eng. Fract. Mech. 21 (1985) 31): dD = d ep/ep_f,
///   ep_f = (d1 + d2 exp(d3 s*))(1 + d4 ln max(rate/reference_rate, 1))(1 + d5 T*),
/// s* = -p/q the triaxiality, positive in tension, T* = (T - reference)/(melting - reference) in [0, 1].
/// The published fits end at s* = 1.5, which larger tension counts as; ep_f is at least least_strain.
struct JohnsonCookDamage {
  double d1 = unset, d2 = unset, d3 = unset;
  double d4 = 0, d5 = 0;
  double melting_temperature = 0;      // K; 0: T* = 0
  double reference_temperature = 298;  // K
  double reference_rate = 1;           // 1/s
  double least_strain = 1e-3;          // of ep_f
  double weakening = 0;                // see strength_left() in damage.hpp

  static constexpr const char* kind = "johnson-cook";
  static constexpr const char* doc = "Johnson-Cook: grows with plastic strain, by triaxiality, rate, heat";
  static constexpr double most_triaxial = 1.5;

  static constexpr auto parameters() {
    using J = JohnsonCookDamage;
    using P = Parameter<J>;
    return std::array{
        P{"d1", "1", &J::d1, -10, 10, "strain to failure, constant part"},
        P{"d2", "1", &J::d2, -10, 100, "strain to failure, part that depends on triaxiality"},
        P{"d3", "1", &J::d3, -20, 20, "exponent of triaxiality, tension positive: negative for metals"},
        P{"d4", "1", &J::d4, -1, 1, "effect of strain rate"},
        P{"d5", "1", &J::d5, -10, 100, "effect of temperature"},
        P{"melting-temperature", "K", &J::melting_temperature, 0, 1e4,
          "where T* is 1; 0: no effect of temperature"},
        P{"reference-temperature", "K", &J::reference_temperature, 1, 2000, "where T* is 0"},
        P{"reference-rate", "1/s", &J::reference_rate, 1e-8, 1e8, "strain rate of d1 to d3"},
        P{"least-strain", "1", &J::least_strain, 1e-6, 1, "least strain to failure"},
        P{"weakening", "1", &J::weakening, 0, 1,
          "part of its yield stress that damage takes away: Y (1 - weakening D)"}};
  }

  /// What is wrong with the constants together; null: nothing.
  constexpr const char* problem() const {
    return d5 != 0 && melting_temperature <= reference_temperature
               ? "with d5 melting-temperature must exceed reference-temperature"
               : nullptr;
  }

  /// Strain to failure at one state of stress.
  double failure_strain(double triaxiality, double rate, double temperature) const {
    const double hot = melting_temperature <= reference_temperature
                           ? 0.0
                           : std::clamp((temperature - reference_temperature) /
                                            (melting_temperature - reference_temperature),
                                        0.0, 1.0);
    const double by_stress = d1 + d2 * std::exp(d3 * std::min(triaxiality, most_triaxial));
    const double by_rate = rate > reference_rate ? 1 + d4 * std::log(rate / reference_rate) : 1.0;
    return std::max(by_stress * by_rate * (1 + d5 * hot), least_strain);
  }

  double growth(const DamagePoint& at) const {
    if (!(at.strain_growth > 0)) return 0;
    const double triaxiality = at.equivalent > 0 ? -at.pressure / at.equivalent
                               : at.pressure < 0 ? most_triaxial
                                                 : -most_triaxial;
    return at.strain_growth / failure_strain(triaxiality, at.strain_growth / at.dt, at.temperature);
  }
};

}  // namespace recoil
