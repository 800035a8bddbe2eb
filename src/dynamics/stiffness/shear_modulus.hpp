#pragma once

#include <algorithm>

#include "dynamics/stress_invariants.hpp"
#include "state/body.hpp"

namespace recoil {

/// Shear modulus [Pa] of a state, where it follows temperature and pressure (modulus_follows()). The energy
/// of distortion, which the temperature leaves out, is taken with the modulus at rest.
template <int Dim>
double shear_modulus_of(const Body<Dim>& body, const Primitives<Dim>& w) {
  using C = Components<Dim>;
  const Eos& eos = body.material.eos;
  double e = energy(eos, w[C::rho], w[C::p], w[C::crushed]);
  if (barotropic(eos)) e += w[C::extra];
  const double square = equivalent_stress_squared<Dim>(w.data() + C::s, 1);
  e -= distortion_energy(square, shear_modulus(body.material), w[C::rho]);
  return shear_modulus(body.material.strength,
                       {.ep = std::max(w[C::ep], 0.0),
                        .temperature = body.temperature(w[C::rho], e, w[C::temperature_rise]),
                        .pressure = w[C::p],
                        .compression = w[C::rho] / rest_density(eos, w[C::crushed])});
}

}  // namespace recoil
