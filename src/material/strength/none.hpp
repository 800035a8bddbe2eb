#pragma once

#include <array>

#include "material/parameter.hpp"
#include "material/strength/yield_state.hpp"

namespace recoil {

/// A fluid: no shear stress at all.
struct NoStrength {
  static constexpr double shear_modulus = 0;  // Pa

  static constexpr const char* kind = "none";
  static constexpr const char* doc = "no strength: a fluid";
  static constexpr bool rate_dependent = false;
  static constexpr bool temperature_dependent = false;

  static constexpr std::array<Parameter<NoStrength>, 0> parameters() { return {}; }

  constexpr double yield(const YieldState& /*state*/) const { return 0; }
};

}  // namespace recoil
