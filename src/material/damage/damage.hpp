#pragma once

#include <variant>

#include "material/damage/johnson_cook_damage.hpp"
#include "material/damage/johnson_holmquist_damage.hpp"
#include "material/damage/minimum_pressure.hpp"
#include "material/damage/none.hpp"
#include "material/damage/tensile.hpp"
#include "material/damage/void_growth.hpp"

namespace recoil {

/// Every damage model, in the order that help and schema show. Adding one: a header beside these, its name
/// here; the generic tests then cover it.
using Damage = std::variant<NoDamage, TensileDamage, JohnsonCookDamage, VoidGrowth, MinimumPressure,
                            JohnsonHolmquistDamage>;

/// From this damage on matter has failed: it bears no tension.
inline constexpr double failed_damage = 0.999;

/// Whether matter can fail at all.
inline bool can_fail(const Damage& damage) { return !std::holds_alternative<NoDamage>(damage); }

}  // namespace recoil
