#pragma once

#include <vector>

#include "config/case.hpp"
#include "state/surface_load.hpp"

namespace recoil {

/// The loads of a case on the surfaces of its bodies. Their functions throw PhysicsError where a formula has
/// no finite value.
template <int Dim>
std::vector<SurfaceLoad<Dim>> surface_loads(const config::Case& c);

}  // namespace recoil
