#pragma once

#include <functional>

#include "core/vec.hpp"

namespace recoil {

/// The centroid [m] of what of a body lies in the box from `lo` to `hi`, by halving the box near the surface
/// down to 2^-16 of the body's extent in 1d, 2^-9 in two dimensions and 2^-7 in three; exact for a box along
/// the axes that fills the given one. The middle of the box where nothing of the body lies in it.
/// @param distance signed [m], negative inside; or a bound of it. @param radial_power weighted with this
/// power of |r|: 1 that of the whole ring, on the axis; 2 the mean radius of a shell.
template <int Dim>
Vec<Dim> centroid(const std::function<double(const Vec<Dim>&)>& distance, const Vec<Dim>& lo,
                  const Vec<Dim>& hi, int radial_power);

}  // namespace recoil
