#pragma once

#include <cstdint>

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

/// A bit of BodyBlock::role beside those of Role: the cell lies within `contact_reach` cells of one that
/// touched another body in the last step, and its matter never yields (strength `elastic`).
inline constexpr std::uint8_t beside_contact = 32;
/// So near a surface that every block which holds such a cell is BodyBlock::near_surface.
inline constexpr int contact_reach = 5;

/// Sets that bit in the cells of a block. Other matter has none.
template <int Dim>
void mark_beside_contact(const State<Dim>& state, Body<Dim>& body, int slot, Scratch& scratch);

}  // namespace recoil
