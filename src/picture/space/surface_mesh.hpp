#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "picture/space/scene.hpp"

namespace recoil {

/// Corners of a triangle [m], anticlockwise seen from outside.
using Triangle = std::array<Vec<3>, 3>;

/// The surface where a signed distance [m] is zero, in cells of a width by marching tetrahedra (A. Doi and
/// A. Koide, IEICE Trans. E74 (1991) 214): closed, since what lies beyond the box counts as outside, and
/// off by about width^2 over eight times the radius of curvature. Boxes of cells without a surface are passed
/// over, which needs |distance| to be at most 1.5 times the true one.
std::vector<Triangle> surface_mesh(const std::function<double(const Vec<3>&)>& distance, const SpaceBox& box,
                                   double width);

/// The triangles as the bytes of a binary STL file, in metres. @param name up to 79 characters for its head.
std::string stl_bytes(const std::vector<Triangle>& triangles, const std::string& name);

}  // namespace recoil
