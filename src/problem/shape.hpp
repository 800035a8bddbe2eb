#pragma once

#include <functional>

#include "config/case.hpp"
#include "core/vec.hpp"

namespace recoil {

/// Signed distance [m] to a shape, negative inside: exact for single shapes; of a union exact outside and a
/// bound inside, of an intersection or difference a bound outside, which the level set's redistancing makes a
/// distance. Next to the surface it is exact but in edges where parts meet. A box, polygon or extrusion that
/// reaches the edge of the domain continues beyond it: it has no surface there. Across periodic edges that is
/// so of those that reach both of them, or are longer than the period; others end where they end, and are met
/// again after each period. Planar and axisymmetric shapes use the first two components of the case's
/// vectors, 1-d the first.
template <int Dim>
std::function<double(const Vec<Dim>&)> signed_distance(const config::Shape& shape,
                                                       const config::Domain& domain);

/// The domain with the ends of periods [m] pushed far away and open: what reaches one of them ends there.
template <int Dim>
config::Domain without_ends(config::Domain domain, const Vec<Dim>& period);

/// How a body lies across the periodic edges of a domain.
template <int Dim>
struct Periods {
  Vec<Dim>
      length;  // m, after which it is met again; 0: the axis is not periodic, or the body is as it is drawn
  Vec<Dim> middle;  // m, of what it lies within, where it is met again
};
template <int Dim>
Periods<Dim> periods_of(const config::Shape& shape, const config::Domain& domain);

/// The function that moves a place in an image of the shape across periodic edges by the period, to where the
/// shape itself is; other places stay.
template <int Dim>
std::function<Vec<Dim>(const Vec<Dim>&)> within_shape(const config::Shape& shape,
                                                      const config::Domain& domain);

/// Part of a cell of width dx about `centre` that lies inside, weighted with |r|^radial_power: integral over
/// the inside, divided by dx^Dim [m^radial_power]. Fine sub-sampling near the surface.
template <int Dim>
double inside_part(const std::function<double(const Vec<Dim>&)>& distance, const Vec<Dim>& centre, double dx,
                   int radial_power);

}  // namespace recoil
