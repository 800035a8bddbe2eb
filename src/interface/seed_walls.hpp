#pragma once

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

/// The walls of the seed scheme (docs/seed-scheme.md; sections 4.4 and 4.5 of the paper). For each surface
/// point: the colliding node is the nearest real cell beside the surface, its partner the nearest one of the
/// body opposite. If their level sets are closer than kappa dx (eq. 21), T_n of the interface is found from
/// least-squares fields around both nodes (eqs. 22-26); compression makes the normal velocity and stress of
/// both sides common, tension or distance leaves them free. Shear is free on both sides either way.
/// Reads and writes as find_ghost_walls().
template <int Dim>
void find_seed_walls(State<Dim>& state, int slot, double kappa, double dt, double weight, Scratch& scratch);

}  // namespace recoil
