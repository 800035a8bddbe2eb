#pragma once

#include "core/vec.hpp"

namespace recoil {

/// One side of a contact across its normal e, which points from the first body into the second.
template <int Dim>
struct ShearSide {
  Vec<Dim> sliding;      // velocity across e [m/s]
  Vec<Dim> traction;     // shear traction on a face with normal e [Pa]
  double impedance = 0;  // sqrt(rho G) [Pa s/m]; 0 for fluids
};

/// The outcome across the normal.
template <int Dim>
struct ShearContact {
  Vec<Dim> traction;                         // tau* on the first body [Pa]; the second bears its opposite
  Vec<Dim> first_velocity, second_velocity;  // of each wall [m/s]
  Vec<Dim> work_velocity;                    // the one with which tau* works on both
  bool slips = false;
};

/// The tangential Riemann problem with a limit (Coulomb: mu |sigma*|; infinite: glued). Free velocities
/// v_a = u_a - tau_a/Z_a, v_b = u_b + tau_b/Z_b; what makes both walls stick is
///   tau* = (v_b - v_a) Z_a Z_b/(Z_a + Z_b),
/// cut to `limit` in size, in which case they slip. Both sides work with the one velocity
/// (Z_a u_a + Z_b u_b)/(Z_a + Z_b): what friction takes from the motion lands in the internal energy of both,
/// and energy closes to round-off.
template <int Dim>
ShearContact<Dim> shear_contact(const ShearSide<Dim>& first, const ShearSide<Dim>& second, double limit);

/// The same against a rigid wall that moves across e with `wall_velocity`: all frictional heat goes to the
/// body.
template <int Dim>
ShearContact<Dim> shear_contact_rigid(const ShearSide<Dim>& body, const Vec<Dim>& wall_velocity,
                                      double limit);

}  // namespace recoil
