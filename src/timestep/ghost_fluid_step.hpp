#pragma once

#include "timestep/step.hpp"

namespace recoil {

/// As advance(), by the improved ghost fluid (docs/seed-scheme.md): whole cells, ghost values from a
/// Riemann-Signorini problem at each surface point, WENO5-Z and elastic HLLC. Simple, and not conservative at
/// surfaces: summary.json and history.csv report what is made or lost.
template <int Dim>
double advance_ghost_fluid(State<Dim>& state, const Stepping& stepping, double until, Engine& engine);

/// As prepare_start(), and gives every fragment the volume that the level set shows, so that sums at the
/// start are those that later ones are compared with.
template <int Dim>
void prepare_whole_cell_start(State<Dim>& state, Engine& engine);

}  // namespace recoil
