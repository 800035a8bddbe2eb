#pragma once

#include "material/material.hpp"

namespace recoil {

/// The state behind the shock that a face makes when it is pushed into matter at rest, in uniaxial
/// strain and without the rate term of the strength. Stresses are compressive traction, positive.
struct ShockState {
  double velocity = 0;        // m/s, of the matter, along the shock's way
  double stress = 0;          // Pa, -sigma_nn
  double pressure = 0;        // Pa
  double density = 0;         // kg/m3
  double energy = 0;          // J/kg, internal
  double temperature = 0;     // K
  double molten = 0;          // 1
  double plastic_strain = 0;  // 1
  double yield = 0;           // Pa, at this state
  double shock_speed = 0;     // m/s, of the last (plastic) front, seen from the matter at rest
  double release_speed = 0;   // m/s, of longitudinal waves in this state, against the matter
  double bulk_speed = 0;      // m/s, of bulk waves in this state, against the matter

  /// The elastic wave ahead; zero where there is none (no strength, or the shock overtakes it).
  bool has_precursor = false;
  double precursor_speed = 0;     // m/s
  double precursor_velocity = 0;  // m/s, of the matter; a free surface moves at twice that
  double precursor_stress = 0;    // Pa, the Hugoniot elastic limit
};

/// The state behind a face pushed at `velocity` >= 0 [m/s] into this material at rest.
/// Without strength: the principal Hugoniot. With strength: one elastic shock to the elastic limit and
/// one plastic shock, each by the jump conditions, with S_nn = -(4/3) G ln(rho/rho0) while elastic
/// (the hypoelastic law integrated) and -(2/3) Y after it. Porous matter has the state of its crush curve,
/// and a first front to where its pores begin to crush or it yields, whichever comes first.
/// @throws PhysicsError where no admissible density reaches that velocity.
ShockState shock_at_velocity(const Material& material, double velocity);

/// The largest velocity [m/s] that shock_at_velocity() reaches: at the end of the equation of state's range
/// (MieGruneisen::guard), or where no shock is strong enough.
double largest_velocity(const Material& material);

/// What two plates do that meet face to face at speed `closing`.
struct Impact {
  double velocity = 0;  // m/s, of the interface, in the frame in which the target was at rest
  double stress = 0;    // Pa, compressive
  ShockState flyer, target;
};

/// Matches stress and velocity at the interface of a flyer moving at `closing` > 0 [m/s] and a target at
/// rest. @throws PhysicsError as shock_at_velocity.
Impact match_impact(const Material& flyer, const Material& target, double closing);

/// Whether the plates part when the release from the flyer's rear comes back: its impedance for shocks
/// of this impact is the smaller one.
bool flyer_leaves(const Impact& impact, const Material& flyer, const Material& target);

/// About when [s after impact] the release from a rear face `thickness` [m] away unloads the interface:
/// the shock out, and the tail of the release back, whose speed in the matter's own coordinate is c0.
/// A few per cent off, since the elastic part of the release comes earlier.
double unloading_time(const ShockState& state, const Material& material, double thickness);

}  // namespace recoil
