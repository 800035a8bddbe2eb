#pragma once

#include <algorithm>
#include <variant>

#include "material/damage/cockcroft_latham.hpp"
#include "material/damage/johnson_cook_damage.hpp"
#include "material/damage/johnson_holmquist_damage.hpp"
#include "material/damage/minimum_pressure.hpp"
#include "material/damage/none.hpp"
#include "material/damage/tensile.hpp"
#include "material/damage/void_growth.hpp"

namespace recoil {

/// Every damage model, in the order that help and schema show. Adding one: a header beside these, its name
/// here; the generic tests then cover it.
using Damage = std::variant<NoDamage, TensileDamage, JohnsonCookDamage, CockcroftLatham, VoidGrowth,
                            MinimumPressure, JohnsonHolmquistDamage>;

/// From this damage on matter has failed: it bears no tension.
inline constexpr double failed_damage = 0.999;

/// Whether matter can fail at all.
inline bool can_fail(const Damage& damage) { return !std::holds_alternative<NoDamage>(damage); }

/// Part of its yield stress that matter has lost when it fails; 0 for models that do not say.
inline double weakening(const Damage& damage) {
  return std::visit(
      []<class Model>(const Model& model) {
        if constexpr (requires { model.weakening; })
          return model.weakening;
        else
          return 0.0;
      },
      damage);
}

/// Part of its yield stress that matter of damage D bears, 1 - weakening D: damage shrinks the area that
/// bears stress (Lemaitre & Chaboche 1990; Børvik et al., Eur. J. Mech. A 20 (2001) 685). The elastic moduli
/// stay.
inline double strength_left(const Damage& damage, double d) {
  return 1 - weakening(damage) * std::clamp(d, 0.0, 1.0);
}

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
