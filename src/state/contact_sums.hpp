#pragma once

#include "state/body.hpp"

namespace recoil {

/// Force [N per m^(3-Dim) or radian] of a contact on the lower-numbered one of its bodies.
template <int Dim>
Vec<Dim> force_on_lower(const Contact<Dim>& c) {
  const double sign = c.first < c.second ? 1 : -1;
  return (sign * c.area) * (c.traction * c.direction + c.shear);
}

/// Power that it gives to the lower-numbered one.
template <int Dim>
double power_to_lower(const Contact<Dim>& c) {
  const double sign = c.first < c.second ? 1 : -1;
  return sign * c.area * (c.traction * c.work_velocity + dot(c.shear, c.shear_velocity));
}

/// Whether a contact stands for its pair in sums. Of two one-sided ones that of the lower-numbered body does,
/// or that of the deformable one.
template <int Dim>
bool counts(const State<Dim>& state, const Contact<Dim>& c) {
  return c.area > 0 && (!c.one_sided || c.first < c.second || state.bodies[c.second].rigid);
}

/// Sums the contacts of a block into the records of the pairs: those of this stage anew, and on top of what
/// was exchanged before their momentum, moment and energy in `booked` [s], the time that the stage stands
/// for.
template <int Dim>
void book_contacts(State<Dim>& state, int slot, double booked);

}  // namespace recoil
