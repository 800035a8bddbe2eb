#pragma once

#include <array>

#include "material/damage/damage_point.hpp"
#include "material/parameter.hpp"

namespace recoil {

/// Matter that never fails.
struct NoDamage {
  static constexpr const char* kind = "none";
  static constexpr const char* doc = "never fails";

  static constexpr std::array<Parameter<NoDamage>, 0> parameters() { return {}; }

  constexpr double growth(const DamagePoint& /*at*/) const { return 0; }
};

}  // namespace recoil
