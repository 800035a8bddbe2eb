#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "dynamics/half_step/half_step.hpp"
#include "dynamics/stress_invariants.hpp"
#include "material/strength/partly_molten.hpp"
#include "state/body.hpp"

namespace recoil {

/// Response::loading of matter without any strength, such as a melt, whose S is zero [1/Pa].
inline constexpr double loading_of_melt = 1e100;

/// Response::loading [1/Pa] of a state that its gradients load on (S:D > 0, or S = 0): 1/|S| where it is at
/// yield, else 0.
template <int Dim>
double loading_of(const Body<Dim>& body, const Primitives<Dim>& w) {
  using C = Components<Dim>;
  const Eos& eos = body.material.eos;
  const double square = equivalent_stress_squared<Dim>(w.data() + C::s, 1);
  YieldState state{.ep = std::max(w[C::ep], 0.0),
                   .pressure = w[C::p],
                   .compression = w[C::rho] / rest_density(eos, w[C::crushed]),
                   .damage = w[C::damage]};
  Melt melt;
  if (temperature_dependent(body.material.strength) || body.temperature.melts()) {
    double e = energy(eos, w[C::rho], w[C::p], w[C::crushed]);
    if (barotropic(eos)) e += w[C::extra];
    e -= distortion_energy(square, shear_modulus(body.material), w[C::rho]);
    melt = body.temperature.melt(w[C::rho], e, w[C::temperature_rise]);
    state.temperature = melt.temperature;
  }
  const double yielding = strength_left(body.material.damage, w[C::damage]) *
                          yield(body.material.strength, state, 1 - melt.molten, melt.at);
  if (!(square >= at_yield * yielding * yielding)) return 0;
  return square > 0 ? std::sqrt(1.5 / square) : loading_of_melt;
}

/// Scales a deviator that half a step of yielding has moved back to the size of the larger of two that were
/// there before. The tangent takes away what grows along S, not what turns it: where the yield stress is
/// small beside G D dt that would be most of the stress.
template <int Dim>
void keep_at_yield(const Primitives<Dim>& before, const Primitives<Dim>& mean, Primitives<Dim>& moved) {
  using C = Components<Dim>;
  const double after = equivalent_stress_squared<Dim>(moved.data() + C::s, 1),
               most = std::max(equivalent_stress_squared<Dim>(before.data() + C::s, 1),
                               equivalent_stress_squared<Dim>(mean.data() + C::s, 1));
  if (after <= most) return;
  const double part = std::sqrt(most / after);
  for (int c = C::s; c < C::ep; ++c) moved[static_cast<std::size_t>(c)] *= part;
}

}  // namespace recoil
