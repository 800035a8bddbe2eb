#include "config/geometry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstddef>

#include "core/error.hpp"

namespace recoil::config {

std::vector<std::string> axes_of(Geometry geometry) {
  switch (geometry) {
    case Geometry::line:
      return {"x"};
    case Geometry::spherical:
      return {"r"};
    case Geometry::planar:
      return {"x", "y"};
    case Geometry::axisymmetric:
      return {"r", "z"};
    case Geometry::space:
      return {"x", "y", "z"};
  }
  throw InternalError("internal error: unknown geometry");
}

std::string name_of(Geometry geometry) { return geometry_names[static_cast<std::size_t>(geometry)]; }

std::string names_of(const std::vector<Geometry>& geometries) {
  std::vector<std::string> names;
  for (const Geometry g : geometries) names.push_back(name_of(g));
  return fmt::format("{}", fmt::join(names, ", "));
}

Vector normalised(Vector v) {
  const double size = std::hypot(v[0], v[1], v[2]);
  constexpr double round_off = 1e-14;
  if (size > 0 && std::abs(size - 1) > round_off)
    for (double& c : v) c /= size;
  return v;
}

Vector pointing(double angle, double elevation) {
  const double flat = std::cos(elevation);
  return {flat * std::cos(angle), flat * std::sin(angle), std::sin(elevation)};
}

}  // namespace recoil::config
