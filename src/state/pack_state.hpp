#pragma once

#include <vector>

#include "parallel/world.hpp"
#include "state/fields.hpp"

namespace recoil {

/// Appends all that one block of this process goes on from: where the bodies are, the fields that live from
/// step to step (FieldDeclaration::in_checkpoint), the ledger.
template <int Dim>
void pack_block(const State<Dim>& state, int slot, parallel::Bytes& bytes);

/// Where a body is in a block, as pack_block() wrote it.
template <int Dim>
struct PackedPlace {
  bool present = false, near_surface = false;
  Box<Dim> reach{};
};

/// Reads a block back, in a state whose mesh and bodies are the same. Fields found anew in every step are not
/// set. @returns one place for each body. @throws InputError where the bytes are of another mesh or version.
template <int Dim>
std::vector<PackedPlace<Dim>> unpack_block(State<Dim>& state, int slot, parallel::Unpacker& from);

/// The same for what belongs to no block: time, step, rigid bodies.
template <int Dim>
void pack_whole(const State<Dim>& state, parallel::Bytes& bytes);
template <int Dim>
void unpack_whole(State<Dim>& state, parallel::Unpacker& from);

}  // namespace recoil
