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

/// Whether a model has no rate: its matter fails by the state at the end of a step. A stage of a step is no
/// state of the matter: extrapolated, it passes the limit too early, and the mean of the stages heals what
/// has failed in one of them.
template <class Model>
constexpr bool is_at_once() {
  return requires { Model::at_once; };
}
inline bool fails_at_once(const Damage& damage) {
  return std::visit([]<class Model>(const Model&) { return is_at_once<Model>(); }, damage);
}

}  // namespace recoil
