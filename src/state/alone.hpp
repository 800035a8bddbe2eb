#pragma once

#include "state/body.hpp"

namespace recoil {

/// Whether the surfaces of all other bodies are farther than `cells` from a cell of a block.
template <int Dim>
bool is_alone(const State<Dim>& state, const Body<Dim>& body, int slot, int cell, double cells) {
  for (const Body<Dim>& other : state.bodies)
    if (&other != &body && other.present(slot) && other.at(slot).phi[cell] < cells * state.grid(slot).dx)
      return false;
  return true;
}

}  // namespace recoil
