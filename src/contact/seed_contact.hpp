#pragma once

#include <span>

#include "contact/touch.hpp"

namespace recoil {

/// The contact of the paper "Treatment of contact separation in Eulerian high speed multimaterial dynamic
/// simulations" (docs/seed-scheme.md), with plain numbers. Equation numbers are the paper's.

/// One "colliding node": a cell centre inside a body, beside its surface.
struct CollidingNode {
  double traction = 0;  // T_n there [Pa], positive in tension
  double distance = 0;  // |phi| of its own body [m]
};

/// Whether two level sets l and k count as colliding at a node: |phi_l + phi_k| < kappa dx, eq. (21).
bool colliding(double phi_l, double phi_k, double kappa, double dx);

/// T_n of the interface between two colliding nodes, eqs. (25) and (26): the nearer node weighs more.
double interface_traction(const CollidingNode& first, const CollidingNode& second);

/// Whether material-material conditions hold: compression of the interface (section 4.4.4); and where nothing
/// touched before, also approach, because the traction is then that of two free surfaces.
/// @param closing speed with which the two sides approach [m/s].
bool presses(double traction, double closing, bool was_in_contact);

/// Normal velocity and stress that both sides share: the acoustic Riemann problem of the two, whatever its
/// sign. Unlike touch() it also pulls. `touching` is always true.
Touch join(const ContactSide& first, const ContactSide& second);
/// The same with a rigid body that moves with `wall_velocity` along e.
Touch join_rigid(const ContactSide& body, double wall_velocity);

/// A bilinear field (linear in 1d, trilinear in 3d) through values at places around the origin by least
/// squares, eqs. (22) to (24). @param places `dim` coordinates each. @returns whether there were enough of
/// them to fix it; then `at_origin` is its value there.
bool fit_at_origin(int dim, std::span<const double> places, std::span<const double> values,
                   double& at_origin);

}  // namespace recoil
