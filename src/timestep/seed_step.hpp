#pragma once

#include "timestep/step.hpp"

namespace recoil {

/// As advance(), by the scheme of the paper "Treatment of contact separation in Eulerian high speed
/// multimaterial dynamic simulations", as its text gives it (docs/seed-scheme.md): convex ENO3 with local
/// Lax-Friedrichs fluxes, the classical fourth-order Runge-Kutta rule, least-squares extrapolation
/// into ghost cells, contact from |phi_l + phi_k| < kappa dx on while T_n < 0. For comparison: it is
/// neither conservative at surfaces nor free of a stand-off.
template <int Dim>
double advance_seed(State<Dim>& state, const Stepping& stepping, double until, Engine& engine);

}  // namespace recoil
