#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "core/linear_history.hpp"
#include "core/vec.hpp"

namespace recoil {

/// Rows of a matrix that turns directions of the start into those of now.
using Rotation = std::array<Vec<3>, 3>;

/// What a free rigid body keeps. Per m2 in 1d, per m in planar geometry, per radian where axisymmetric.
template <int Dim>
struct RigidMass {
  double mass = 0;  // kg
  Vec<3> inertia;   // principal moments [kg m2] along the axes of the start; 0: no turning about that axis
  Vec<Dim> start_momentum;  // kg m/s
  Vec<3> start_moment;      // angular momentum about the origin [kg m2/s]; see nearest_image()
  double start_energy = 0;  // J
  double energy = 0;        // J: at the start, and what its contacts have given since
};

/// A prescribed velocity over time [m/s]. Its mean over a step is what the body moves, over the time that it
/// takes.
template <int Dim>
using VelocityHistory = LinearHistory<Vec<Dim>>;

/// The largest speed of a history [m/s].
template <int Dim>
double fastest(const VelocityHistory<Dim>& history);

/// A rigid body: a shape that moves as prescribed or, with a mass, as its contacts push it.
template <int Dim>
struct RigidMotion {
  std::function<double(const Vec<Dim>&)> distance;  // signed distance [m] at the start
  Vec<Dim> velocity;                                // of the centre [m/s]
  Vec<3> spin;                                      // rad/s; planar: the third
  Vec<Dim> mean_velocity;  // over the coming step, as far as it is known at its start
  Vec<3> mean_spin;
  Vec<Dim> start_centre, centre;  // the point that it turns about [m]
  Vec<Dim> start_middle;          // the centre of its mass, or of its shape, at the start [m]
  Vec<Dim> period;  // m, after which it is met again; 0 along axes without a period, or that it fills
  Rotation turn{Vec<3>{{1, 0, 0}}, Vec<3>{{0, 1, 0}}, Vec<3>{{0, 0, 1}}};
  std::optional<RigidMass<Dim>> mass;             // none: moves as prescribed
  std::optional<VelocityHistory<Dim>> history{};  // none: keeps its velocity
};

/// Whether nothing will ever move it.
template <int Dim>
bool never_moves(const RigidMotion<Dim>& motion) {
  return !motion.mass && !motion.history && motion.velocity == Vec<Dim>{} && motion.spin == Vec<3>{};
}

/// Where a rigid body is at one time.
template <int Dim>
struct RigidPose {
  Vec<Dim> centre;
  Rotation turn;
};

/// a x b, where planar vectors lie in the plane of the first two axes.
template <int Dim>
Vec<3> cross(const Vec<Dim>& a, const Vec<Dim>& b) {
  Vec<3> p, q;
  for (int d = 0; d < Dim; ++d) p[d] = a[d], q[d] = b[d];
  return {{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]}};
}

/// Where the body's middle, the centre of its mass or of its shape, is in a pose [m].
template <int Dim>
Vec<Dim> middle_at(const RigidMotion<Dim>& motion, const RigidPose<Dim>& pose);

/// x, moved by whole periods to where it is nearest to the body's middle: a body that crosses an edge of a
/// period goes on, while the domain sees its image on the other side.
template <int Dim>
Vec<Dim> nearest_image(const RigidMotion<Dim>& motion, const RigidPose<Dim>& pose, const Vec<Dim>& x);

/// Mean velocity [m/s] over the coming step of the material point at x.
template <int Dim>
Vec<Dim> velocity_at(const RigidMotion<Dim>& motion, const Vec<Dim>& x);

/// Where the body will be `ahead` seconds from now at its mean velocity and spin.
template <int Dim>
RigidPose<Dim> pose_after(const RigidMotion<Dim>& motion, double ahead);

/// Signed distance [m] of x from the body in a pose, the least one of its images a period to either side.
template <int Dim>
double distance_at(const RigidMotion<Dim>& motion, const RigidPose<Dim>& pose, const Vec<Dim>& x);

/// Sets a body in motion; it keeps velocity [m/s] and spin [rad/s] unless it is set free.
template <int Dim>
void set_moving(RigidMotion<Dim>& motion, const Vec<Dim>& velocity, const Vec<3>& spin);

/// The velocity of a body that has a history, for the step from `time` to `time + dt` [s].
template <int Dim>
void follow_history(RigidMotion<Dim>& motion, double time, double dt);

/// Gives a body at rest or in motion a mass: what it keeps starts from its present velocity and spin.
template <int Dim>
void set_free(RigidMotion<Dim>& motion, double mass, const Vec<3>& inertia);

/// Moves a body by one step. A free one takes what its contacts have given it since the start: impulse [N s],
/// moment about the origin [N m s] of what acts at nearest_image() of its place, work [J]; its momentum is
/// exact, its place goes with the mean of the old and the new velocity. The next step expects the same change
/// of velocity again, and works with its mean: second order in the step. The body's energy is what it was
/// given: the difference to its kinetic energy is the error of that (docs/theory.md, rigid bodies).
template <int Dim>
void move_rigid(RigidMotion<Dim>& motion, double dt, const Vec<Dim>& impulse, const Vec<3>& moment,
                double work);

/// Kinetic energy [J] of a free body.
template <int Dim>
double kinetic_energy(const RigidMotion<Dim>& motion);

}  // namespace recoil
