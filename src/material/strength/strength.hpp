#pragma once

#include <variant>

#include "material/strength/drucker_prager.hpp"
#include "material/strength/elastic.hpp"
#include "material/strength/johnson_cook.hpp"
#include "material/strength/johnson_holmquist.hpp"
#include "material/strength/linear_hardening.hpp"
#include "material/strength/lundborg.hpp"
#include "material/strength/none.hpp"
#include "material/strength/perfectly_plastic.hpp"
#include "material/strength/preston_tonks_wallace.hpp"
#include "material/strength/steinberg_guinan.hpp"
#include "material/strength/yield_state.hpp"
#include "material/strength/zerilli_armstrong.hpp"

namespace recoil {

/// Every strength model, in the order that help and schema show. Adding one: a header beside these,
/// its name here; the generic tests then cover it.
using Strength =
    std::variant<NoStrength, Elastic, PerfectlyPlastic, LinearHardening, JohnsonCook, ZerilliArmstrong,
                 SteinbergGuinan, PrestonTonksWallace, DruckerPrager, Lundborg, JohnsonHolmquist>;

/// Shear modulus [Pa]; 0 where the material is a fluid.
inline double shear_modulus(const Strength& strength) {
  return std::visit([](const auto& model) { return model.shear_modulus; }, strength);
}

/// Whether the shear modulus of a model follows the state.
inline bool modulus_follows(const Strength& strength) {
  return std::visit(
      [](const auto& model) {
        if constexpr (requires { model.modulus_follows; })
          return model.modulus_follows > 0;
        else
          return false;
      },
      strength);
}

/// Shear modulus [Pa] of a state, with its temperature, pressure and compression.
template <class Model>
double modulus_at(const Model& model, const YieldState& state) {
  if constexpr (requires { model.modulus(state); })
    return model.modulus(state);
  else
    return model.shear_modulus;
}
inline double shear_modulus(const Strength& strength, const YieldState& state) {
  return std::visit([&](const auto& model) { return modulus_at(model, state); }, strength);
}

/// Whether shear stress exists at all; where it does not, no shear terms are evaluated.
inline bool has_strength(const Strength& strength) { return shear_modulus(strength) > 0; }

/// Yield stress [Pa]. For single states: loops over cells visit once.
inline double yield(const Strength& strength, const YieldState& state) {
  return std::visit([&](const auto& model) { return model.yield(state); }, strength);
}

/// Whether a model's yield stress depends on temperature: unless it says that it does not.
template <class Model>
constexpr bool temperature_dependent() {
  if constexpr (requires { Model::temperature_dependent; })
    return Model::temperature_dependent;
  else
    return true;
}
inline bool temperature_dependent(const Strength& strength) {
  return std::visit([]<class Model>(const Model&) { return temperature_dependent<Model>(); }, strength);
}

/// Whether a model's yield stress depends on pressure or density.
template <class Model>
constexpr bool pressure_dependent() {
  if constexpr (requires { Model::pressure_dependent; })
    return Model::pressure_dependent;
  else
    return false;
}
inline bool pressure_dependent(const Strength& strength) {
  return std::visit([]<class Model>(const Model&) { return pressure_dependent<Model>(); }, strength);
}

/// Whether a model's yield stress falls with damage: then it knows itself what failed matter bears.
template <class Model>
constexpr bool damage_dependent() {
  if constexpr (requires { Model::damage_dependent; })
    return Model::damage_dependent;
  else
    return false;
}
inline bool damage_dependent(const Strength& strength) {
  return std::visit([]<class Model>(const Model&) { return damage_dependent<Model>(); }, strength);
}

/// Temperature [K] at which a model itself gives up its strength, at density over that at rest; NaN: it does
/// not melt.
inline double melting_temperature(const Strength& strength, double compression) {
  return std::visit(
      [=](const auto& model) {
        if constexpr (requires { model.melting_at(compression); })
          return model.melting_at(compression);
        else if constexpr (requires { model.melting_temperature; })
          return model.melting_temperature;
        else
          return unset;
      },
      strength);
}

}  // namespace recoil
