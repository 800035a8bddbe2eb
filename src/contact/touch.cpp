#include "contact/touch.hpp"

namespace recoil {

double free_velocity(double velocity, double stress, double impedance) {
  return velocity - stress / impedance;
}

Touch touch(const ContactSide& first, const ContactSide& second, double gap_speed, bool glued) {
  const double za = first.impedance, zb = second.impedance;
  const double va = free_velocity(first.velocity, first.stress, za);
  const double vb = free_velocity(second.velocity, -second.stress, zb);
  const double w = vb - va + gap_speed;
  if (!(w < 0) && !glued) return {};
  Touch t;
  t.touching = true;
  t.traction = w * za * zb / (za + zb);
  t.first_velocity = va + t.traction / za;
  t.second_velocity = vb - t.traction / zb;
  t.work_velocity = (za * t.first_velocity + zb * t.second_velocity) / (za + zb);
  return t;
}

Touch touch_rigid(const ContactSide& body, double wall_velocity, double gap_speed, bool glued) {
  const double va = free_velocity(body.velocity, body.stress, body.impedance);
  const double w = wall_velocity - va + gap_speed;
  if (!(w < 0) && !glued) return {};
  Touch t;
  t.touching = true;
  t.traction = w * body.impedance;
  t.first_velocity = gap_speed > 0 ? va + t.traction / body.impedance : wall_velocity;
  t.second_velocity = wall_velocity;
  t.work_velocity = wall_velocity;
  return t;
}

}  // namespace recoil
