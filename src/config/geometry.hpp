#pragma once

#include <array>
#include <string>
#include <vector>

namespace recoil::config {

/// Three components whatever the geometry: 1d uses [0] = x; spherical [0] = r; planar [0] = x, [1] = y;
/// axisymmetric [0] = r, [1] = z; 3d all.
using Vector = std::array<double, 3>;

enum class Geometry { line, spherical, planar, axisymmetric, space };

/// As in a case file, in the order of the enumeration.
inline constexpr std::array geometry_names{"1d", "spherical", "planar", "axisymmetric", "3d"};

/// 1, 2 or 3.
constexpr int dimension(Geometry g) {
  if (g == Geometry::space) return 3;
  return g == Geometry::line || g == Geometry::spherical ? 1 : 2;
}

/// The power of r with which areas grow from the axis (1) or the centre (2) where the first coordinate is a
/// radius, else 0.
constexpr int radial_power(Geometry g) {
  return g == Geometry::spherical ? 2 : g == Geometry::axisymmetric ? 1 : 0;
}
constexpr bool has_radius(Geometry g) { return radial_power(g) > 0; }

/// Whether it has a plane in which shapes can be turned.
constexpr bool flat(Geometry g) { return dimension(g) == 2; }

/// Names of the coordinates: {"r", "z"} for axisymmetric.
std::vector<std::string> axes_of(Geometry geometry);

/// "planar", ... as in a case file.
std::string name_of(Geometry geometry);

/// "planar, 3d"
std::string names_of(const std::vector<Geometry>& geometries);

/// A vector of length 1 in the direction of v, or v where it has none. What is one already, as a resolved
/// case has it, stays as it is, so that it reads back equal.
Vector normalised(Vector v);

/// The unit vector at `angle` from the x axis towards y, raised by `elevation` out of their plane towards z
/// [rad].
Vector pointing(double angle, double elevation = 0);

}  // namespace recoil::config
