#pragma once

#include <cstdint>
#include <vector>

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

/// The cells of a block whose contents redistribution may read in the stages of this step, there or in blocks
/// around, by place in the layout; empty: none. From the volumes and the mid-step geometry of its start: in
/// the stages only the volumes of cut cells shrink, and lone fragments leave.
template <int Dim>
std::vector<std::uint8_t> mark_around_small(const State<Dim>& state, const Body<Dim>& body, int slot,
                                            Scratch& scratch);

}  // namespace recoil
