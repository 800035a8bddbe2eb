#pragma once

#include <string>

#include "timestep/step.hpp"

namespace recoil {

/// A step of any scheme: advance(), advance_ghost_fluid() or advance_seed().
template <int Dim>
using Advance = double (*)(State<Dim>&, const Stepping&, double until, Engine&);

/// The step of `method.scheme`: conservative, ghost-fluid or seed. Asked for once per run.
/// @throws InternalError for another name.
template <int Dim>
Advance<Dim> step_of(const std::string& scheme);

}  // namespace recoil
