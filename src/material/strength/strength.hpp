#pragma once

#include <variant>

#include "material/strength/elastic.hpp"
#include "material/strength/johnson_cook.hpp"
#include "material/strength/linear_hardening.hpp"
#include "material/strength/none.hpp"
#include "material/strength/perfectly_plastic.hpp"

namespace recoil {

/// Every strength model, in the order that help and schema show. Adding one: a header beside these,
/// its name here; the generic tests then cover it.
using Strength = std::variant<NoStrength, Elastic, PerfectlyPlastic, LinearHardening, JohnsonCook>;

/// Shear modulus [Pa]; 0 where the material is a fluid.
inline double shear_modulus(const Strength& strength) {
  return std::visit([](const auto& model) { return model.shear_modulus; }, strength);
}

/// Whether shear stress exists at all; where it does not, no shear terms are evaluated.
inline bool has_strength(const Strength& strength) { return shear_modulus(strength) > 0; }

}  // namespace recoil
