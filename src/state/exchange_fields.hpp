#pragma once

#include "parallel/world.hpp"
#include "state/fields.hpp"

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
/// bodies are in. A process gets the cells that lie within min(reach, reach_of(field)) of its own blocks; the
/// others of the copy keep what they hold, in debug builds no numbers. Collective.
template <int Dim>
void exchange_fields(State<Dim>& state, const parallel::World& world, FieldSet fields,
                     int reach = widest_halo);

}  // namespace recoil
