#pragma once

#include "state/body.hpp"

namespace recoil {

/// Turns averages into the values that reconstructions read in this stage, in the same memory
/// (BodyBlock::average is empty afterwards, ::stencil holds them; Role::valued marks them): regular uncut
/// cells keep their average; regular cut cells their average moved from the centroid to the cell's centre
/// with a limited slope along the normal; ghost cells the state of their wall, extrapolated along the normal.
template <int Dim>
void fill_stencil_values(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters);

}  // namespace recoil
