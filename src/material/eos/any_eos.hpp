#pragma once

#include "material/eos/eos.hpp"

namespace recoil {

/// Any equation of state where a type of its own is asked for, chosen anew in every call: for loops that need
/// not be fast, and need not be compiled once for each kind.
template <bool Barotropic>
struct AnyEos {
  const Eos& eos;
  double rho0 = density(eos);  // kg/m3

  static constexpr bool barotropic = Barotropic;

  double pressure(double rho, double e) const { return recoil::pressure(eos, rho, e); }
  double energy(double rho, double p) const { return recoil::energy(eos, rho, p); }
  double sound_speed_squared(double rho, double p) const { return recoil::sound_speed_squared(eos, rho, p); }
};

template <bool Barotropic>
double bulk_sound_speed(const AnyEos<Barotropic>& any) {
  return bulk_sound_speed(any.eos);
}

/// Calls f(any): an AnyEos.
template <class F>
void with_any_eos(const Eos& eos, const F& f) {
  if (barotropic(eos))
    f(AnyEos<true>{eos});
  else
    f(AnyEos<false>{eos});
}

}  // namespace recoil
