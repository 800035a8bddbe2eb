#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "config/declare/entry.hpp"
#include "core/vec.hpp"

/// Closed outlines in a plane: what polygons, extrusions and shapes of revolution are made of.
namespace recoil::config {

using Corner = std::array<double, 2>;  // m

/// Square of the distance from x to the straight edge from a to b [m2].
inline double edge_distance2(const Corner& a, const Corner& b, const Vec<2>& x) {
  const double ex = b[0] - a[0], ey = b[1] - a[1], wx = x[0] - a[0], wy = x[1] - a[1];
  const double length2 = ex * ex + ey * ey;
  const double t = length2 > 0 ? std::clamp((wx * ex + wy * ey) / length2, 0.0, 1.0) : 0.0;
  const double dx = wx - t * ex, dy = wy - t * ey;
  return dx * dx + dy * dy;
}

/// Signed distance to the polygon with these corners, of either orientation, negative inside [m]: exact.
/// @param x where; @param within where it is decided whether x lies inside: x, or a point beside it.
/// @param skip edges (a, b) for which it is true are no surface.
template <class Skip>
double outline_distance(std::span<const Corner> corners, const Vec<2>& x, const Vec<2>& within,
                        const Skip& skip) {
  double nearest2 = 1e300;
  bool inside = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Corner &a = corners[i], &b = corners[j];
    if (!skip(a, b)) nearest2 = std::min(nearest2, edge_distance2(a, b, x));
    if ((a[1] > within[1]) != (b[1] > within[1]) &&
        within[0] < a[0] + (b[0] - a[0]) * (within[1] - a[1]) / (b[1] - a[1]))
      inside = !inside;
  }
  return (inside ? -1 : 1) * std::sqrt(nearest2);
}

/// A rectangle of the plane; the domain as an outline meets it.
struct Frame {
  Corner lo{}, hi{};  // m

  /// Whether both ends of an edge lie on or beyond the same side.
  bool holds_edge(const Corner& a, const Corner& b) const {
    for (std::size_t d = 0; d < 2; ++d) {
      const double near = 1e-9 * (hi[d] - lo[d]);
      if ((a[d] <= lo[d] + near && b[d] <= lo[d] + near) || (a[d] >= hi[d] - near && b[d] >= hi[d] - near))
        return true;
    }
    return false;
  }
  /// x, or the point just within the nearest side.
  Vec<2> inner(Vec<2> x) const {
    for (int d = 0; d < 2; ++d)
      x[d] = std::clamp(x[d], lo[d] + 1e-9 * (hi[d] - lo[d]), hi[d] - 1e-9 * (hi[d] - lo[d]));
    return x;
  }
};

/// The area that a polygon encloses [m2]; 0 where it encloses none.
double area_of(std::span<const Corner> corners);

/// Reads a list of at least `fewest` pairs of coordinates; what is wrong with it is reported.
/// @param names what messages call the two coordinates.
std::vector<Corner> read_corners(const TableReading& reading, const Key& key, std::size_t fewest,
                                 const std::array<std::string, 2>& names);
std::string write_corners(const std::vector<Corner>& corners);

/// Reports corners below the axis, r < 0.
void check_radii(const std::vector<Corner>& corners, const TableReading& reading, const char* key);

}  // namespace recoil::config
