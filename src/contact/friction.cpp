#include "contact/friction.hpp"

namespace recoil {

namespace {

/// Velocity across e of a surface without shear traction. side: +1 for the first body, -1 for the second.
template <int Dim>
Vec<Dim> free_sliding(const ShearSide<Dim>& s, double side) {
  return s.impedance > 0 ? s.sliding - (side / s.impedance) * s.traction : s.sliding;
}

/// Cuts a traction to a size. @returns whether it was longer.
template <int Dim>
bool limit_to(Vec<Dim>& traction, double limit) {
  const double size = norm(traction);
  if (size <= limit) return false;
  traction *= limit / size;
  return true;
}

}  // namespace

template <int Dim>
ShearContact<Dim> shear_contact(const ShearSide<Dim>& first, const ShearSide<Dim>& second, double limit) {
  const double za = first.impedance, zb = second.impedance;
  const Vec<Dim> va = free_sliding(first, 1), vb = free_sliding(second, -1);
  ShearContact<Dim> g{{}, va, vb, va, true};
  if (!(za > 0 && zb > 0)) return g;  // a fluid does not hold
  g.traction = (za * zb / (za + zb)) * (vb - va);
  g.slips = limit_to(g.traction, limit);
  g.first_velocity = va + g.traction * (1 / za);
  g.second_velocity = vb - g.traction * (1 / zb);
  g.work_velocity = (za * g.first_velocity + zb * g.second_velocity) * (1 / (za + zb));
  return g;
}

template <int Dim>
ShearContact<Dim> shear_contact_rigid(const ShearSide<Dim>& body, const Vec<Dim>& wall_velocity,
                                      double limit) {
  const Vec<Dim> v = free_sliding(body, 1);
  ShearContact<Dim> g{{}, v, wall_velocity, wall_velocity, true};
  if (!(body.impedance > 0)) return g;
  g.traction = body.impedance * (wall_velocity - v);
  g.slips = limit_to(g.traction, limit);
  g.first_velocity = v + g.traction * (1 / body.impedance);
  return g;
}

#define RECOIL_INSTANTIATE(Dim)                                                                        \
  template ShearContact<Dim> shear_contact<Dim>(const ShearSide<Dim>&, const ShearSide<Dim>&, double); \
  template ShearContact<Dim> shear_contact_rigid<Dim>(const ShearSide<Dim>&, const Vec<Dim>&, double);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
