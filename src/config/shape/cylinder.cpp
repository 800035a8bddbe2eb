#include "config/shape/cylinder.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace recoil::config {

void Cylinder::check(const TableReading& reading) {
  if (reading.in.geometry != Geometry::space) return;
  const bool ends = reading.has("from") && reading.has("to");
  const bool other = reading.has("centre") || reading.has("axis") || reading.has("along");
  if (!ends && !reading.has("from") && !reading.has("to")) {
    if (!reading.has("along"))
      reading.in.out.error(reading.record.place(),
                           "a cylinder needs the middles of both its faces, 'from' and 'to', "
                           "or its extent 'along' its axis",
                           R"(e.g. along = ["0 mm", "15 mm"])");
    return;
  }
  if (!ends || other)
    return reading.refuse(reading.has("from") ? "from" : "to",
                          "'from' and 'to' go together, and in place of 'centre', 'axis' and 'along'",
                          "remove one of the two ways to say where the cylinder lies");
  if (!reading.good("from") || !reading.good("to")) return;
  if (from == to)
    return reading.wrong("to", "this cylinder has no length: both ends are the same", "move one of them");
  centre = from;
  for (std::size_t d = 0; d < 3; ++d) axis[d] = to[d] - from[d];
  length = {0, std::hypot(axis[0], axis[1], axis[2])};
  axis = normalised(axis);
}

Bounds Cylinder::bounds(const Domain& domain) const {
  if (domain.geometry == Geometry::axisymmetric) return {{-endless, length[0], 0}, {radius, length[1], 0}};
  if (domain.geometry == Geometry::planar) return Bounds::around(centre, radius);
  Vector low = centre, high = centre;
  for (std::size_t d = 0; d < 3; ++d) low[d] += length[0] * axis[d], high[d] += length[1] * axis[d];
  return Bounds::around(low, radius).with(Bounds::around(high, radius));
}

Extent Cylinder::extent(Geometry geometry) const {
  if (geometry == Geometry::axisymmetric) return {true, {0, length[0], 0}, {radius, length[1], 0}};
  if (geometry != Geometry::space) return {};
  const auto main = static_cast<std::size_t>(
      std::max_element(axis.begin(), axis.end(),
                       [](double a, double b) { return std::abs(a) < std::abs(b); }) -
      axis.begin());
  if (std::abs(axis[main]) < 1 - 1e-9) return {};
  Extent e{true, {}, {}};
  for (std::size_t d = 0; d < 3; ++d) e.lo[d] = centre[d] - radius, e.hi[d] = centre[d] + radius;
  const double a = centre[main] + axis[main] * length[0], b = centre[main] + axis[main] * length[1];
  e.lo[main] = std::min(a, b), e.hi[main] = std::max(a, b);
  return e;
}

}  // namespace recoil::config
