#include "interface/surface_state.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/constants.hpp"
#include "dynamics/primitives.hpp"

namespace recoil {

template <int Dim>
SurfaceState<Dim> resolve(const Primitives<Dim>& value, const Vec<Dim>& e) {
  using C = Components<Dim>;
  SurfaceState<Dim> s;
  Vec<Dim> u, t;
  for_each_axis<Dim>([&](auto i) RECOIL_INLINE {
    u[i] = value[C::u + i];
    for_each_axis<Dim>([&](auto j) RECOIL_INLINE {
      constexpr int c = C::stress(i, j);
      double sij;
      if constexpr (c >= 0)
        sij = value[C::s + c];
      else
        sij = -(value[C::s] + value[C::s + 1]);
      t[i] += sij * e[j];
    });
  });
  s.velocity = dot(u, e);
  s.sliding = u - s.velocity * e;
  s.deviator = dot(t, e);
  s.stress = s.deviator - value[C::p];
  s.shear = t - s.deviator * e;
  return s;
}

template <int Dim>
SurfaceState<Dim> surface_state(const Material& material, const Primitives<Dim>& value, const Vec<Dim>& e) {
  using C = Components<Dim>;
  SurfaceState<Dim> s = resolve<Dim>(value, e);
  const double rho = value[C::rho], g = shear_modulus(material);
  const double c2 = std::visit(
      [&](const auto& eos) {
        const auto& matter = frozen(eos, value[C::crushed]);
        return std::max(matter.sound_speed_squared(rho, value[C::p]), least_wall_sound_squared(matter));
      },
      material.eos);
  // A fit across a shock that arrives may bear more tension than its sound can answer for: the surface of
  // such a state would run off at many times the speed of any release. In matter rho c^2 is above its stress.
  s.impedance = rho * std::sqrt(std::max(c2 + 4 * g / (3 * rho), std::abs(s.stress) / rho));
  s.shear_impedance = std::sqrt(rho * g);
  return s;
}

#define RECOIL_INSTANTIATE(Dim)                                                     \
  template SurfaceState<Dim> resolve<Dim>(const Primitives<Dim>&, const Vec<Dim>&); \
  template SurfaceState<Dim> surface_state<Dim>(const Material&, const Primitives<Dim>&, const Vec<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
