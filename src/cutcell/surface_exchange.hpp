#pragma once

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

/// Part of the difference of mismatch between neighbours that is exchanged in a step.
inline constexpr double exchange_rate = 0.05;

/// Evens out how far phi lags behind V along a body's own surface: between cut cells whose common face is
/// cut,
///   dV = 0.05 (h_i - h_j) |A_i| |A_j|/(|A_i| + |A_j|), h = (V - V_phi)/|A_I|,
/// in the state of the cell that is fuller. Where that would take too much mass or heat from the other one
/// (docs/decisions/0072), volume leaves it in its own state. Writes BodyBlock::updates and leaves the state
/// as it is. Needs the end-of-step geometry with Surfaces::own.
template <int Dim>
void exchange_along_surface(const State<Dim>& state, Body<Dim>& body, int slot, Scratch& scratch);

}  // namespace recoil
