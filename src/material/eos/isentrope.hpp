#pragma once

#include <optional>

#include "material/eos/eos.hpp"

namespace recoil {

/// A state on an isentrope.
struct IsentropePoint {
  double rho = 0, p = 0;  // kg/m3, Pa
  double speed = 0;       // m/s, integral of dp/(rho c) from this state back to the one it began at
  bool reached = true;    // whether p is the pressure asked for; else the limit of density came first
};

/// Whether matter is a gas: an ideal one, or the products of a detonation.
bool is_gas(const Eos& eos);

/// The most that the density of a gas may change along an isentrope, as a factor either way.
inline constexpr double most_expansion = 20;

/// The state at pressure `to` [Pa] on the isentrope through (rho [kg/m3], p [Pa]) of an ideal gas, whose
/// pressures are measured from that at rest. An isentropic wave that brings gas of velocity u from p to `to`
/// leaves it with u + speed (running against the normal; Courant & Friedrichs, Supersonic Flow and Shock
/// Waves, 1948).
/// @returns nothing for other matter (a stiffened gas is a liquid), and for a state without pressure.
std::optional<IsentropePoint> gas_isentrope(const Eos& eos, double rho, double p, double to);

/// The most that the density of other matter may change along an isentrope, in logarithms either way.
inline constexpr double most_change = 1;

/// The density [kg/m3] at pressure `to` [Pa] on the isentrope through (rho, p) of any matter, by the midpoint
/// rule for d(ln rho)/dp = 1/(rho c^2) in steps of at most a fiftieth of the density; c^2 is at least that
/// of least_wall_sound_squared(). Without `speed`. Products of a detonation have no state without pressure:
/// where they expand into nothing, to <= 0, the last one is that at the limit of density, and is reached.
/// @param crushed as in eos.hpp.
IsentropePoint follow_isentrope(const Eos& eos, double rho, double p, double crushed, double to);

}  // namespace recoil
