#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "core/scratch.hpp"
#include "parallel/team.hpp"
#include "state/body.hpp"

/// How values pass between blocks of different levels (decision 0017).
namespace recoil {

/// A state on another mesh with the bodies, laws and times of this one, and nothing in its blocks.
template <int Dim>
State<Dim> empty_on(Mesh<Dim>&& mesh, const State<Dim>& from);

/// Fills stand-ins of these fields (of contents, volume, phi and stencil) from the blocks that they stand
/// for. Those of other processes' blocks must be up to date.
template <int Dim>
void fill_stand_ins(State<Dim>& state, FieldSet fields, parallel::Team& team);

/// The body in a block made from its 2^Dim finer ones, all of which hold it or none does: sums of contents
/// and volumes, the sign of phi.
/// @param from the old state. @param children its slots by child (Place::finer); -1: beyond the domain.
template <int Dim>
void join_blocks(const State<Dim>& from, const std::array<int, power<Dim>(2)>& children, int body,
                 const Box<Dim>& cells, BodyBlock<Dim>& to);

/// The body in one of the finer blocks that a block is cut into: limited parabolas along each axis, with the
/// cell's sums kept; where a finer cell would not be admissible (contents, volume), all of its cell have the
/// same densities.
/// @param from the old state, its stand-ins filled. @param slot the block there. @param cells of the new one.
/// @returns the number of cells for which the latter holds.
template <int Dim>
std::int64_t cut_block(const State<Dim>& from, int slot, int body, const Box<Dim>& cells, BodyBlock<Dim>& to,
                       const std::function<bool(const Contents<Dim>&, double)>& admissible, Scratch& scratch);

}  // namespace recoil
