#include "state/rigid_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/index.hpp"

namespace recoil {

namespace {

Vec<3> times(const Rotation& r, const Vec<3>& x) { return {{dot(r[0], x), dot(r[1], x), dot(r[2], x)}}; }

Vec<3> times_transposed(const Rotation& r, const Vec<3>& x) {
  return x[0] * r[0] + x[1] * r[1] + x[2] * r[2];
}

template <int Dim>
Vec<3> in_space(const Vec<Dim>& x) {
  Vec<3> y;
  for (int d = 0; d < Dim; ++d) y[d] = x[d];
  return y;
}

template <int Dim>
Vec<Dim> within(const Vec<3>& x) {
  Vec<Dim> y;
  for (int d = 0; d < Dim; ++d) y[d] = x[d];
  return y;
}

/// The rotation `turn` followed by one about `angle` by |angle| (Rodrigues' formula).
Rotation turned(const Rotation& turn, const Vec<3>& angle) {
  const double size = norm(angle);
  if (size == 0) return turn;
  const Vec<3> axis = angle * (1 / size);
  const double c = std::cos(size), s = std::sin(size);
  Rotation out;
  for (int column = 0; column < 3; ++column) {
    const Vec<3> v{{turn[0][column], turn[1][column], turn[2][column]}};
    const Vec<3> w = c * v + s * cross(axis, v) + ((1 - c) * dot(axis, v)) * axis;
    for (std::size_t row = 0; row < 3; ++row) out[row][column] = w[static_cast<int>(row)];
  }
  return out;
}

/// omega of an angular momentum about the centre, and the reverse.
Vec<3> spin_of(const Rotation& turn, const Vec<3>& inertia, const Vec<3>& moment) {
  Vec<3> own = times_transposed(turn, moment);
  for (int d = 0; d < 3; ++d) own[d] = inertia[d] > 0 ? own[d] / inertia[d] : 0;
  return times(turn, own);
}

Vec<3> moment_of(const Rotation& turn, const Vec<3>& inertia, const Vec<3>& spin) {
  Vec<3> own = times_transposed(turn, spin);
  for (int d = 0; d < 3; ++d) own[d] *= inertia[d];
  return times(turn, own);
}

/// Signed distance [m] of x from the body in a pose, without its images.
template <int Dim>
double distance_of_one(const RigidMotion<Dim>& m, const RigidPose<Dim>& pose, const Vec<Dim>& x) {
  return m.distance(m.start_centre + within<Dim>(times_transposed(pose.turn, in_space(x - pose.centre))));
}

template <int Dim>
RigidPose<Dim> pose_now(const RigidMotion<Dim>& m) {
  return {m.centre, m.turn};
}

}  // namespace

template <int Dim>
Vec<Dim> middle_at(const RigidMotion<Dim>& m, const RigidPose<Dim>& pose) {
  return pose.centre + within<Dim>(times(pose.turn, in_space(m.start_middle - m.start_centre)));
}

template <int Dim>
Vec<Dim> nearest_image(const RigidMotion<Dim>& m, const RigidPose<Dim>& pose, const Vec<Dim>& x) {
  if (m.period == Vec<Dim>{}) return x;
  const Vec<Dim> middle = middle_at(m, pose);
  Vec<Dim> image = x;
  for (int d = 0; d < Dim; ++d)
    if (m.period[d] > 0) image[d] -= m.period[d] * std::round((x[d] - middle[d]) / m.period[d]);
  return image;
}

template <int Dim>
Vec<Dim> velocity_at(const RigidMotion<Dim>& m, const Vec<Dim>& x) {
  const Vec<Dim> image = nearest_image(m, pose_now(m), x);
  return m.mean_velocity + within<Dim>(cross(m.mean_spin, in_space(image - m.centre)));
}

template <int Dim>
RigidPose<Dim> pose_after(const RigidMotion<Dim>& m, double ahead) {
  return {m.centre + ahead * m.mean_velocity, turned(m.turn, ahead * m.mean_spin)};
}

template <int Dim>
double distance_at(const RigidMotion<Dim>& m, const RigidPose<Dim>& pose, const Vec<Dim>& x) {
  if (m.period == Vec<Dim>{}) return distance_of_one(m, pose, x);
  const Vec<Dim> nearest = nearest_image(m, pose, x);
  Box<Dim> sides{};  // [periods]
  for (int d = 0; d < Dim; ++d) sides.lo[d] = m.period[d] > 0 ? -1 : 0, sides.hi[d] = 1 - sides.lo[d];
  double least = std::numeric_limits<double>::infinity();
  for_each(sides, [&](const Index<Dim>& side) {
    Vec<Dim> image = nearest;
    for (int d = 0; d < Dim; ++d) image[d] += side[d] * m.period[d];
    least = std::min(least, distance_of_one(m, pose, image));
  });
  return least;
}

template <int Dim>
double kinetic_energy(const RigidMotion<Dim>& m) {
  if (!m.mass) return 0;
  return 0.5 * m.mass->mass * dot(m.velocity, m.velocity) +
         0.5 * dot(m.spin, moment_of(m.turn, m.mass->inertia, m.spin));
}

template <int Dim>
void set_moving(RigidMotion<Dim>& m, const Vec<Dim>& velocity, const Vec<3>& spin) {
  m.velocity = m.mean_velocity = velocity;
  m.spin = m.mean_spin = spin;
}

template <int Dim>
double fastest(const VelocityHistory<Dim>& history) {
  double most = 0;
  for (const Vec<Dim>& u : history.values) most = std::max(most, norm(u));
  return most;
}

template <int Dim>
void follow_history(RigidMotion<Dim>& m, double time, double dt) {
  if (!m.history) return;
  m.mean_velocity = m.history->mean(time, time + dt);
  m.velocity = m.history->at(time + dt);
}

template <int Dim>
void set_free(RigidMotion<Dim>& m, double mass, const Vec<3>& inertia) {
  m.mass = RigidMass<Dim>{mass, inertia, mass * m.velocity, {}, 0, 0};
  for (int d = 0; d < 3; ++d)
    if (!(inertia[d] > 0)) m.spin[d] = m.mean_spin[d] = 0;
  m.mass->start_moment =
      cross(middle_at(m, pose_now(m)), m.mass->start_momentum) + moment_of(m.turn, inertia, m.spin);
  m.mass->start_energy = m.mass->energy = kinetic_energy(m);
}

template <int Dim>
void move_rigid(RigidMotion<Dim>& m, double dt, const Vec<Dim>& impulse, const Vec<3>& moment, double work) {
  if (!m.mass) {
    const RigidPose<Dim> pose = pose_after(m, dt);
    m.centre = pose.centre;
    m.turn = pose.turn;
    return;
  }
  RigidMass<Dim>& own = *m.mass;
  const Vec<Dim> momentum = own.start_momentum + impulse, before = m.velocity;
  m.velocity = momentum * (1 / own.mass);
  m.centre += (0.5 * dt) * (before + m.velocity);
  const Vec<3> about_centre = own.start_moment + moment - cross(m.centre, momentum);
  const Vec<3> spin_before = m.spin;
  m.spin = spin_of(m.turn, own.inertia, about_centre);
  m.turn = turned(m.turn, (0.5 * dt) * (spin_before + m.spin));
  m.mean_velocity = m.velocity + 0.5 * (m.velocity - before);
  m.mean_spin = m.spin + 0.5 * (m.spin - spin_before);
  own.energy = own.start_energy + work;
}

#define RECOIL_INSTANTIATE(Dim)                                                                          \
  template double fastest<Dim>(const VelocityHistory<Dim>&);                                             \
  template void follow_history<Dim>(RigidMotion<Dim>&, double, double);                                  \
  template Vec<Dim> middle_at<Dim>(const RigidMotion<Dim>&, const RigidPose<Dim>&);                      \
  template Vec<Dim> nearest_image<Dim>(const RigidMotion<Dim>&, const RigidPose<Dim>&, const Vec<Dim>&); \
  template Vec<Dim> velocity_at<Dim>(const RigidMotion<Dim>&, const Vec<Dim>&);                          \
  template RigidPose<Dim> pose_after<Dim>(const RigidMotion<Dim>&, double);                              \
  template double distance_at<Dim>(const RigidMotion<Dim>&, const RigidPose<Dim>&, const Vec<Dim>&);     \
  template void set_moving<Dim>(RigidMotion<Dim>&, const Vec<Dim>&, const Vec<3>&);                      \
  template void set_free<Dim>(RigidMotion<Dim>&, double, const Vec<3>&);                                 \
  template void move_rigid<Dim>(RigidMotion<Dim>&, double, const Vec<Dim>&, const Vec<3>&, double);      \
  template double kinetic_energy<Dim>(const RigidMotion<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
