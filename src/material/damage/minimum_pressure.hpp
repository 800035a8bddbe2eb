#pragma once

#include <array>

#include "material/damage/damage_point.hpp"
#include "material/parameter.hpp"

namespace recoil {

/// Fails at once where the pressure falls below -tension. How much fails depends on the mesh: a wave of
/// tension that fails at once leaves no time for it to be resolved.
struct MinimumPressure {
  double tension = unset;  // Pa

  static constexpr bool at_once = true;  // see fails_at_once()
  static constexpr const char* kind = "minimum-pressure";
  static constexpr const char* doc = "fails at once at a tension; what fails depends on the mesh";

  static constexpr auto parameters() {
    using P = Parameter<MinimumPressure>;
    return std::array{
        P{"tension", "Pa", &MinimumPressure::tension, 1, 1e12, "negative pressure at which matter fails"}};
  }

  constexpr double growth(const DamagePoint& at) const { return at.pressure < -tension ? 1 : 0; }
};

}  // namespace recoil
