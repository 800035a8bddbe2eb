#pragma once

#include "parallel/world.hpp"
#include "state/fields.hpp"

namespace recoil {

/// Brings the copies of other processes' blocks up to date: these fields of all bodies, and which blocks the
/// bodies are in. Collective.
template <int Dim>
void exchange_fields(State<Dim>& state, const parallel::World& world, FieldSet fields);

}  // namespace recoil
