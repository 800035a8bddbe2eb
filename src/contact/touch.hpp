#pragma once

namespace recoil {

/// One side of a possible contact, along the normal e that points from the first body into the second.
struct ContactSide {
  double velocity = 0;   // m/s along e
  double stress = 0;     // sigma_ee [Pa], positive in tension
  double impedance = 0;  // rho c_L [Pa s/m]
};

/// The outcome where two surfaces may touch.
struct Touch {
  bool touching = false;
  double traction = 0;                             // sigma* [Pa], <= 0 unless glued
  double first_velocity = 0, second_velocity = 0;  // of each wall along e [m/s]
  double work_velocity = 0;  // the one velocity with which the traction works on both [m/s]
};

/// Velocity of a surface along its outward normal if nothing touched it: u - sigma/Z.
double free_velocity(double velocity, double stress, double impedance);

/// Riemann-Signorini problem of two bodies (physics of contact: traction only in compression, or a gap).
/// Free speeds v_a = u_a - sigma_a/Z_a, v_b = u_b + sigma_b/Z_b; w = v_b - v_a + gap_speed.
///   w >= 0: apart.   w < 0: sigma* = w Z_a Z_b/(Z_a + Z_b), u_a = v_a + sigma*/Z_a, u_b = v_b - sigma*/Z_b,
///   and the work velocity (Z_a u_a + Z_b u_b)/(Z_a + Z_b), which closes the energy of both to round-off.
/// @param gap_speed gap over time step while a gap is still to close [m/s], which makes first touch happen on
///   time, without a stand-off; 0 in contact; below 0: surfaces that overlap part at that speed.
/// @param glued the bodies hold each other: sigma* may pull.
Touch touch(const ContactSide& first, const ContactSide& second, double gap_speed, bool glued = false);

/// The same against a rigid body (infinite impedance) that moves with `wall_velocity` along e.
Touch touch_rigid(const ContactSide& body, double wall_velocity, double gap_speed, bool glued = false);

}  // namespace recoil
