#pragma once

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

/// Chooses the donors and weights of one linear least-squares fit at the surface point of every cut cell of a
/// block: fragments with V > 0.3 full whose centroids lie within 2.35 dx of it across the surface and within
/// 4.35 dx along it (2.85 dx in 3-D), weighted with exp(-0.6 n^2 - 0.15 t^2) min(V/full, 1) (0.35 t^2 in
/// 3-D), n and t in dx: weights that separate, so that aligned problems reduce to 1-D; in the mean these
/// times 1 + 0.5 exp(-2 t^2). Along curved surfaces the reach is shorter, from a radius of 10 dx on that
/// across. A wide box where there is no donor. Once a step. Writes BodyBlock::walls and ::donors.
template <int Dim>
void choose_donors(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters, Scratch& scratch);

}  // namespace recoil
