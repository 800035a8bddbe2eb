#pragma once

#include <array>

#include "material/parameter.hpp"
#include "material/strength/yield_state.hpp"

namespace recoil {

/// Drucker & Prager (Quarterly of Applied Mathematics 10 (1952) 157) in terms of the equivalent stress:
///   Y = cohesion + friction p, not below 0.
/// Plastic flow keeps the volume (the flow rule is not the associated one): nothing dilates.
struct DruckerPrager {
  double shear_modulus = unset;  // Pa
  double cohesion = unset;       // Pa
  double friction = unset;       // 1

  static constexpr const char* kind = "drucker-prager";
  static constexpr const char* doc = "yield stress linear in pressure: soil, powder, broken matter";
  static constexpr bool rate_dependent = false;
  static constexpr bool temperature_dependent = false;
  static constexpr bool pressure_dependent = true;

  static constexpr auto parameters() {
    using D = DruckerPrager;
    using P = Parameter<D>;
    return std::array{P{"shear-modulus", "Pa", &D::shear_modulus, 1, 1e13, "shear modulus"},
                      P{"cohesion", "Pa", &D::cohesion, 0, 1e12, "yield stress without pressure"},
                      P{"friction", "1", &D::friction, 0, 5, "growth of the yield stress with pressure"}};
  }

  constexpr double yield(const YieldState& s) const {
    const double y = cohesion + friction * s.pressure;
    return y > 0 ? y : 0.0;
  }
};

}  // namespace recoil
