#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "picture/space/scene.hpp"

namespace recoil {

/// A closed surface of faces with four corners.
struct SurfaceNet {
  std::vector<Vec<3>> points;                      ///< m
  std::vector<std::array<std::int32_t, 4>> faces;  ///< numbers of points, anticlockwise seen from outside
};

/// Where a signed distance [m] is zero, by surface nets without relaxation (S. F. F. Gibson, "Constrained
/// elastic surface nets", MICCAI 1998): one point in each cell of a lattice that the surface passes, at the
/// mean of the places where it crosses the cell's edges; a face round each crossed edge. Planes are exact, a
/// ball of radius R is too small by at most spacing^2 / (2 R), edges are bevelled within a spacing.
/// @param distance its size at most 1.5 times the true distance. @param spacing of the lattice [m]. What is
/// inside ends at the faces of the box.
SurfaceNet surface_net(const std::function<double(const Vec<3>&)>& distance, const SpaceBox& box,
                       double spacing);

/// Of all bodies of a scene.
inline SurfaceNet surface_net(const Scene& scene, double spacing) {
  return surface_net([&](const Vec<3>& x) { return scene.distance(x); }, scene.box(), spacing);
}

/// The bytes of a binary STL file, in metres, of two triangles for each face. @param name up to 79 characters
/// for its head.
std::string stl_bytes(const SurfaceNet& net, const std::string& name);

/// For each point the one at a depth [m] below it, against the mean normal of its faces.
std::vector<Vec<3>> points_below(const SurfaceNet& net, double depth);

}  // namespace recoil
