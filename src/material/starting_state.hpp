#pragma once

#include <optional>
#include <string>

#include "material/material.hpp"

namespace recoil {

/// What the matter of a body starts with, without its motion.
struct StartingState {
  double density = 0;  // kg/m3
  double energy = 0;   // J/kg, internal
  double heat = 0;     // K, temperature rise by plastic work
};

/// The state without shear of pressure p [Pa] (none: 0) and temperature T [K] (none: the material's initial
/// one); without both the state at rest, to the bit. Where the temperature follows from plastic work alone it
/// leaves density and energy as they are.
/// @param body its name, for messages
/// @throws InputError where the equation of state has no such state.
StartingState state_at_start(const Material& material, std::optional<double> pressure,
                             std::optional<double> temperature, const std::string& body);

/// Temperature of a state at the start over that of the isentrope through the state at rest, at its density;
/// where only plastic work heats, over the material's initial one. With a constant heat capacity and a
/// Grueneisen coefficient of density alone the ratio stays the same along any isentrope.
double over_isentrope(const TemperatureLaw& law, const StartingState& start);

}  // namespace recoil
