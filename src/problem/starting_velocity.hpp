#pragma once

#include <functional>

#include "config/case.hpp"
#include "core/vec.hpp"

namespace recoil {

/// Velocity of a body at the start [m/s] in the cell of width dx [m] about a place [m] of the domain: of its
/// motion, of its turning, and away from a point or the axis as at the place; of its formulas the mean over
/// Gauss points inside the body. Where the place lies in an image of the body across periodic edges it is
/// that of the body. The function throws InputError where the velocity is not finite; it is not for several
/// threads at once.
template <int Dim>
std::function<Vec<Dim>(const Vec<Dim>&)> starting_velocity(const config::Body& body,
                                                           const config::Domain& domain, double dx);

}  // namespace recoil
