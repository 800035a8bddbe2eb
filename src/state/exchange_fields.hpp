#pragma once

#include "parallel/world.hpp"
#include "state/fields.hpp"
#include "state/sent_cells.hpp"

namespace recoil {

/// The widest window through which a kernel reads a field of the blocks around its own [cells].
constexpr int reach_of(Field field) {
  switch (field) {
    case Field::stencil:
    case Field::phi_next:
      return 3;
    case Field::extension_velocity:
      return 4;
    case Field::contact:
      return 5;
    case Field::average:
      return 7;
    default:
      return widest_halo;
  }
}

/// Brings the copies of other processes' blocks up to date: these fields of all bodies, and which blocks the
/// bodies are in. A process gets the cells that lie within min(read.cells, reach_of(field)) of its own
/// blocks; what is not sent is 0, or stays as it was, in debug builds no number. Collective.
template <int Dim>
void exchange_fields(State<Dim>& state, const parallel::World& world, FieldSet fields,
                     const ReadAround& read = {});

/// The two halves of it, for one other process: the message to it, and what is done with that from it.
template <int Dim>
parallel::Bytes pack_fields(const State<Dim>& state, const typename Mesh<Dim>::Peer& peer, FieldSet fields,
                            const ReadAround& read);
template <int Dim>
void unpack_fields(State<Dim>& state, const typename Mesh<Dim>::Peer& peer, int own_rank, FieldSet fields,
                   const ReadAround& read, const parallel::Bytes& bytes);

}  // namespace recoil
