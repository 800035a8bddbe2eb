#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "material/parameter.hpp"
#include "material/strength/yield_state.hpp"

namespace recoil {

/// Zerilli & Armstrong, J. Appl. Phys. 61 (1987) 1816, both crystals in one form:
///   Y = c0 + (c1 + c2 sqrt(ep)) exp(-T (c3 - c4 ln(ep_rate/(1/s)))) + c5 ep^n.
/// Cubic face-centred metals have c1 = c5 = 0, body-centred ones c2 = 0. Rates below 1/s count as 1/s, and
/// the exponential is at most 1. The model does not melt.
struct ZerilliArmstrong {
  double shear_modulus = unset;   // Pa
  double c0 = unset;              // Pa, athermal part
  double c1 = 0, c2 = 0;          // Pa
  double c3 = unset, c4 = unset;  // 1/K
  double c5 = 0;                  // Pa
  double n = 0.5;                 // 1

  static constexpr const char* kind = "zerilli-armstrong";
  static constexpr const char* doc = "Zerilli-Armstrong: thermally activated flow of fcc and bcc metals";
  static constexpr bool rate_dependent = true;

  static constexpr auto parameters() {
    using Z = ZerilliArmstrong;
    using P = Parameter<Z>;
    return std::array{P{"shear-modulus", "Pa", &Z::shear_modulus, 1, 1e13, "shear modulus"},
                      P{"c0", "Pa", &Z::c0, 0, 1e11, "part that does not depend on strain and temperature"},
                      P{"c1", "Pa", &Z::c1, 0, 1e11, "thermal part without strain; 0 for fcc"},
                      P{"c2", "Pa", &Z::c2, 0, 1e11, "thermal part with the root of strain; 0 for bcc"},
                      P{"c3", "1/K", &Z::c3, 0, 1, "thermal softening"},
                      P{"c4", "1/K", &Z::c4, 0, 0.1, "its change with the logarithm of the rate in 1/s"},
                      P{"c5", "Pa", &Z::c5, 0, 1e11, "hardening; 0 for fcc"},
                      P{"n", "1", &Z::n, 0.01, 5, "exponent of that hardening"}};
  }

  /// What is wrong with the constants together; null: nothing.
  constexpr const char* problem() const {
    return c0 + c1 + c2 + c5 > 0 ? nullptr : "without c0, c1, c2 and c5 there is no strength";
  }

  double yield(const YieldState& s) const {
    const double log_rate = s.rate > 1 ? std::log(s.rate) : 0.0;
    const double thermal = std::exp(-s.temperature * std::max(c3 - c4 * log_rate, 0.0));
    const double hardening = c5 > 0 && s.ep > 0 ? c5 * std::pow(s.ep, n) : 0.0;
    return c0 + (c1 + c2 * std::sqrt(s.ep)) * thermal + hardening;
  }
};

}  // namespace recoil
