#pragma once

#include <array>

#include "material/parameter.hpp"
#include "material/strength/yield_state.hpp"

namespace recoil {

/// N. Lundborg, Strength of rock-like materials, Int. J. Rock Mech. Min. Sci. 5 (1968) 427:
///   Y = cohesion + friction p/(1 + friction p/(limit - cohesion)) for p > 0,
/// under tension on along its slope at p = 0, not below 0: matter without cohesion carries no shear there.
/// Plastic flow keeps the volume.
struct Lundborg {
  double shear_modulus = unset;  // Pa
  double cohesion = unset;       // Pa
  double friction = unset;       // 1
  double limit = unset;          // Pa

  static constexpr const char* kind = "lundborg";
  static constexpr const char* doc =
      "yield stress that grows with pressure up to a limit: rock, concrete, ice";
  static constexpr bool rate_dependent = false;
  static constexpr bool temperature_dependent = false;
  static constexpr bool pressure_dependent = true;

  static constexpr auto parameters() {
    using L = Lundborg;
    using P = Parameter<L>;
    return std::array{P{"shear-modulus", "Pa", &L::shear_modulus, 1, 1e13, "shear modulus"},
                      P{"cohesion", "Pa", &L::cohesion, 0, 1e12, "yield stress without pressure"},
                      P{"friction", "1", &L::friction, 0, 5, "growth with pressure at no pressure"},
                      P{"limit", "Pa", &L::limit, 1, 1e12, "yield stress at very high pressure"}};
  }

  /// What is wrong with the constants together; null: nothing.
  constexpr const char* problem() const { return limit <= cohesion ? "limit must exceed cohesion" : nullptr; }

  constexpr double yield(const YieldState& s) const {
    const double grown = friction * s.pressure, room = limit - cohesion;
    if (grown > 0) return cohesion + grown * room / (room + grown);
    return cohesion + grown > 0 ? cohesion + grown : 0.0;
  }
};

}  // namespace recoil
