#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "picture/space/scene.hpp"

namespace recoil {

/// The surface of all bodies of a scene, closed, of faces with four corners.
struct SurfaceNet {
  std::vector<Vec<3>> points;                      ///< m
  std::vector<std::array<std::int32_t, 4>> faces;  ///< numbers of points, anticlockwise seen from outside
};

/// By surface nets without relaxation (S. F. F. Gibson, "Constrained elastic surface nets", MICCAI 1998): one
/// point in each cell of a lattice that the surface passes, at the mean of the places where it crosses the
/// cell's edges; a face round each crossed edge. Planes are exact, a ball of radius R is too small by at most
/// spacing^2 / (2 R), edges are bevelled within a spacing.
/// @param spacing of the lattice [m]. Bodies end at the faces of the scene's box.
SurfaceNet surface_net(const Scene& scene, double spacing);

/// For each point the one at a depth [m] below it, against the mean normal of its faces.
std::vector<Vec<3>> points_below(const SurfaceNet& net, double depth);

}  // namespace recoil
