#pragma once

#include <algorithm>
#include <cmath>

#include "dynamics/half_step/half_step.hpp"
#include "dynamics/stress_invariants.hpp"
#include "material/strength/partly_molten.hpp"
#include "state/body.hpp"

namespace recoil {

/// Response::loading [1/Pa] of a state that its gradients load on (S:D > 0): 1/|S| where it is at yield, else
/// 0.
template <int Dim>
double loading_of(const Body<Dim>& body, const Primitives<Dim>& w) {
  using C = Components<Dim>;
  const Eos& eos = body.material.eos;
  const double square = equivalent_stress_squared<Dim>(w.data() + C::s, 1);
  if (!(square > 0)) return 0;
  YieldState state{.ep = std::max(w[C::ep], 0.0),
                   .pressure = w[C::p],
                   .compression = w[C::rho] / rest_density(eos, w[C::crushed])};
  Melt melt;
  if (temperature_dependent(body.material.strength) || body.temperature.melts()) {
    double e = energy(eos, w[C::rho], w[C::p], w[C::crushed]);
    if (barotropic(eos)) e += w[C::extra];
    e -= distortion_energy(square, shear_modulus(body.material), w[C::rho]);
    melt = body.temperature.melt(w[C::rho], e, w[C::temperature_rise]);
    state.temperature = melt.temperature;
  }
  const double yielding = yield(body.material.strength, state, 1 - melt.molten, melt.at);
  return square >= at_yield * yielding * yielding ? std::sqrt(1.5 / square) : 0.0;
}

}  // namespace recoil
