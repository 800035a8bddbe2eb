#pragma once

#include <array>

#include "material/parameter.hpp"
#include "material/strength/yield_state.hpp"

namespace recoil {

/// One yield stress, whatever strain, rate and temperature.
struct PerfectlyPlastic {
  double shear_modulus = unset;  // Pa
  double yield_stress = unset;   // Pa

  static constexpr const char* kind = "perfectly-plastic";
  static constexpr const char* doc = "elastic, perfectly plastic";
  static constexpr bool rate_dependent = false;
  static constexpr bool temperature_dependent = false;

  static constexpr auto parameters() {
    using P = Parameter<PerfectlyPlastic>;
    return std::array{
        P{"shear-modulus", "Pa", &PerfectlyPlastic::shear_modulus, 1, 1e13, "shear modulus"},
        P{"yield", "Pa", &PerfectlyPlastic::yield_stress, 0, 1e13, "yield stress in simple tension"}};
  }

  constexpr double yield(const YieldState& /*state*/) const { return yield_stress; }
};

}  // namespace recoil
