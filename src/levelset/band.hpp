#pragma once

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

/// Which blocks a body needs next: those that hold its matter or cells within 7.5 dx of its surface; and
/// which of them lie near the surface. `enter` and `near` are decided from the state of all blocks, then
/// applied at once.
template <int Dim>
struct BandChoice {
  bool present = false, near_surface = false;
  Box<Dim> reach{};  // BodyBlock::reach
};

/// @param slot a block of this process, whether the body is there or not.
template <int Dim>
BandChoice<Dim> choose_band(const State<Dim>& state, const Body<Dim>& body, int slot, Scratch& scratch);

/// Enters or leaves the block, and sets the kinds of cells where no surface is near.
template <int Dim>
void apply_band(const State<Dim>& state, Body<Dim>& body, int slot, const BandChoice<Dim>& choice);

}  // namespace recoil
