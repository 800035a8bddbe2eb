#pragma once

#include <cstdint>

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

/// A bit of BodyBlock::role beside those of Role: the cell lies within `contact_reach` cells of one that
/// touched another body without friction in the last step, and its matter never yields (strength `elastic`).
/// Beside a contact with shear bodies that stay together would gain energy (docs/decisions/0076).
inline constexpr std::uint8_t beside_contact = 32;
/// So near a surface that every block which holds such a cell is BodyBlock::near_surface.
inline constexpr int contact_reach = 5;

/// The bodies along which a body slides without friction, as bits.
template <int Dim>
std::uint32_t sliding_partners(const State<Dim>& state, const Body<Dim>& body);

/// Sets that bit in the cells of a block. Other matter has none.
template <int Dim>
void mark_beside_contact(const State<Dim>& state, Body<Dim>& body, int slot, Scratch& scratch);

}  // namespace recoil
