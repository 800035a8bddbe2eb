#pragma once

#include "state/body.hpp"

namespace recoil {

/// Distances from the surfaces of other bodies to the centre of a cell from which on matter in that cell is a
/// fragment on its own [cells]. A rigid body does not give way to what makes room for itself.
inline constexpr double free_distance = 0.5, free_distance_rigid = 2.5;

/// Cells of matter in one cell from which on it is crowded: its level set makes room, and a fragment that the
/// geometry has lost spreads.
inline constexpr double crowded = 1.1;

/// Whether the surfaces of all other bodies are farther than that from a cell of a block.
template <int Dim>
bool is_alone(const State<Dim>& state, const Body<Dim>& body, int slot, int cell) {
  for (const Body<Dim>& other : state.bodies)
    if (&other != &body && other.present(slot) &&
        other.at(slot).phi[cell] < (other.rigid ? free_distance_rigid : free_distance) * state.grid(slot).dx)
      return false;
  return true;
}

}  // namespace recoil
