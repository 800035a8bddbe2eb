#pragma once

#include <array>
#include <cstddef>

#include "core/index.hpp"
#include "core/vec.hpp"

namespace recoil {

/// The part of a unit cell or face where a function given at its corners is negative.
template <int Dim>
struct Clip {
  double fraction = 0;  // of the whole, [0, 1]
  Vec<Dim> centroid;    // in [0, 1]^Dim
  Vec<Dim> middle;      // mean of the points where the surface crosses edges
  int crossings = 0;
};

/// Corner c of a unit cell lies at bit d of c along axis d.
template <int Dim>
using Corners = std::array<double, static_cast<std::size_t>(1 << Dim)>;

/// The open parts of the faces of a unit cell, by axis and side: clip_face() of each.
template <int Dim>
using FaceClips = std::array<std::array<Clip<Dim>, 2>, Dim>;

/// Clips a unit cell. Crossings are linear along edges. Points and segments (Dim 1) and polygons (Dim 2) are
/// exact; of a polyhedron (Dim 3) the volume and centroid come from its faces by the divergence theorem, with
/// the surface taken as flat, which is exact for a plane.
template <int Dim>
Clip<Dim> clip(const Corners<Dim>& value, const FaceClips<Dim>& faces);

/// The part of face `side` (0 low, 1 high) across axis d that is open, as a Clip of the face placed in the
/// cell.
template <int Dim>
Clip<Dim> clip_face(const Corners<Dim>& value, int d, int side);

/// clip_face() of all faces.
template <int Dim>
FaceClips<Dim> clip_faces(const Corners<Dim>& value) {
  FaceClips<Dim> faces;
  for (int d = 0; d < Dim; ++d)
    for (int side = 0; side < 2; ++side) faces[d][side] = clip_face<Dim>(value, d, side);
  return faces;
}

/// Clips a unit cell whose faces are not known yet.
template <int Dim>
Clip<Dim> clip(const Corners<Dim>& value) {
  return clip<Dim>(value, clip_faces<Dim>(value));
}

template <>
Clip<1> clip<1>(const Corners<1>&, const FaceClips<1>&);
template <>
Clip<2> clip<2>(const Corners<2>&, const FaceClips<2>&);
template <>
Clip<3> clip<3>(const Corners<3>&, const FaceClips<3>&);
template <>
Clip<1> clip_face<1>(const Corners<1>&, int, int);
template <>
Clip<2> clip_face<2>(const Corners<2>&, int, int);
template <>
Clip<3> clip_face<3>(const Corners<3>&, int, int);

}  // namespace recoil
