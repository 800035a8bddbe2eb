#pragma once

#include "interface/surface_view.hpp"

namespace recoil {

/// The surface of a deformable body in a cell, by its area vector out of the body [m^(Dim-1)].
template <int Dim>
struct BodySurface {
  int body;
  Vec<Dim> area;
};

/// Direction from one deformable body into another, of the area that their surfaces in cell i share: between
/// the surfaces. Where one of them has a corner, whose surface belongs to a free side as well, it is that of
/// the cells around in which the two face each other.
template <int Dim>
Vec<Dim> direction_between(const SurfaceView<Dim>& view, const BodySurface<Dim>& first,
                           const BodySurface<Dim>& second, const Index<Dim>& i);

}  // namespace recoil
