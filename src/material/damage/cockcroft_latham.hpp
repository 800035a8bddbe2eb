#pragma once

#include <array>

#include "material/damage/damage_point.hpp"
#include "material/parameter.hpp"

namespace recoil {

/// Cockcroft & Latham (J. Inst. Met. 96 (1968) 33): dD = max(sigma_1, 0) d ep/W,
/// sigma_1 the largest principal stress. Plastic work under tension alone counts: nothing grows where all
/// principal stresses press.
struct CockcroftLatham {
  double work = unset;   // Pa (J/m3), W: to failure
  double weakening = 0;  // see strength_left() in damage.hpp

  static constexpr const char* kind = "cockcroft-latham";
  static constexpr const char* doc = "Cockcroft-Latham: grows with plastic strain times the largest tension";

  static constexpr auto parameters() {
    using C = CockcroftLatham;
    using P = Parameter<C>;
    return std::array{P{"work", "Pa", &C::work, 1, 1e12,
                        "W, integral of the largest principal stress over plastic strain at failure"},
                      P{"weakening", "1", &C::weakening, 0, 1,
                        "part of its yield stress that damage takes away: Y (1 - weakening D)"}};
  }

  double growth(const DamagePoint& at) const {
    return at.principal > 0 && at.strain_growth > 0 ? at.principal * at.strain_growth / work : 0.0;
  }
};

}  // namespace recoil
