#pragma once

#include "state/body.hpp"

namespace recoil {

/// Parts of a body's data in a block, to be brought up to date in the copies that other processes hold.
enum Part : unsigned {
  part_phi = 1,
  part_phi_next = 2,
  part_matter = 4,     // contents and volume
  part_average = 8,    // and role
  part_geometry = 16,  // mid-step, with walls
  part_end_geometry = 32,
  part_contact = 64
};

/// Shares parts (a sum of Part) of all bodies with the other processes, and which blocks they are in.
/// Collective.
template <int Dim>
void share(State<Dim>& state, const parallel::World& world, unsigned parts);

}  // namespace recoil
