#pragma once

#include <variant>

#include "material/eos/linear.hpp"
#include "material/eos/mie_gruneisen.hpp"

namespace recoil {

/// Every equation of state, in the order that help and schema show. Adding one: a header beside
/// these, its name here; the generic tests then cover it.
using Eos = std::variant<MieGruneisen, LinearEos>;

/// Density at rest [kg/m3].
inline double density(const Eos& eos) {
  return std::visit([](const auto& model) { return model.rho0; }, eos);
}

/// Bulk sound speed at rest [m/s].
inline double bulk_sound_speed(const Eos& eos) {
  return std::visit([](const auto& model) { return bulk_sound_speed(model); }, eos);
}

}  // namespace recoil
