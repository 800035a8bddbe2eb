#pragma once

#include <array>

#include "material/parameter.hpp"
#include "material/strength/yield_state.hpp"

namespace recoil {

/// Y = yield_stress + hardening ep.
struct LinearHardening {
  double shear_modulus = unset;  // Pa
  double yield_stress = unset;   // Pa
  double hardening = unset;      // Pa per unit of equivalent plastic strain

  static constexpr const char* kind = "linear-hardening";
  static constexpr const char* doc = "yield stress linear in equivalent plastic strain";
  static constexpr bool rate_dependent = false;
  static constexpr bool temperature_dependent = false;

  static constexpr auto parameters() {
    using P = Parameter<LinearHardening>;
    return std::array{
        P{"shear-modulus", "Pa", &LinearHardening::shear_modulus, 1, 1e13, "shear modulus"},
        P{"yield", "Pa", &LinearHardening::yield_stress, 0, 1e13, "yield stress before plastic strain"},
        P{"hardening", "Pa", &LinearHardening::hardening, 0, 1e13, "growth per unit of plastic strain"}};
  }

  constexpr double yield(const YieldState& s) const { return yield_stress + hardening * s.ep; }
};

}  // namespace recoil
