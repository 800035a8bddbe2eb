#pragma once

#include <array>

#include "material/parameter.hpp"
#include "material/strength/yield_state.hpp"

namespace recoil {

/// Elastic without limit.
struct Elastic {
  double shear_modulus = unset;  // Pa

  static constexpr const char* kind = "elastic";
  static constexpr const char* doc = "elastic without limit";
  static constexpr bool rate_dependent = false;
  static constexpr bool temperature_dependent = false;

  static constexpr auto parameters() {
    using P = Parameter<Elastic>;
    return std::array{P{"shear-modulus", "Pa", &Elastic::shear_modulus, 1, 1e13, "shear modulus"}};
  }

  constexpr double yield(const YieldState& /*state*/) const { return infinite; }
};

}  // namespace recoil
