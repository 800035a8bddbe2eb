#include "config/shape/polygon.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "config/declare/reading.hpp"
#include "config/declare/write.hpp"

namespace recoil::config {

namespace {

/// Whether both ends of an edge lie on or beyond the same edge of the domain.
bool on_edge(const std::array<double, 2>& a, const std::array<double, 2>& b, const Domain& domain) {
  for (std::size_t d = 0; d < 2; ++d) {
    const double near = 1e-9 * (domain.hi[d] - domain.lo[d]);
    if ((a[d] <= domain.lo[d] + near && b[d] <= domain.lo[d] + near) ||
        (a[d] >= domain.hi[d] - near && b[d] >= domain.hi[d] - near))
      return true;
  }
  return false;
}

}  // namespace

double Polygon::distance_in_plane(const Vec<2>& x, const Domain& domain) const {
  const std::vector<std::array<double, 2>>& v = vertices;
  const bool turned = rotation != 0;
  Vec<2> within = x;
  for (int d = 0; d < 2 && !turned; ++d) {
    const double lo = domain.lo[d], hi = domain.hi[d];
    within[d] = std::clamp(x[d], lo + 1e-9 * (hi - lo), hi - 1e-9 * (hi - lo));
  }
  double nearest2 = 1e300;
  bool inside = false;
  for (std::size_t i = 0, j = v.size() - 1; i < v.size(); j = i++) {
    const double ex = v[j][0] - v[i][0], ey = v[j][1] - v[i][1], wx = x[0] - v[i][0], wy = x[1] - v[i][1];
    const double length2 = ex * ex + ey * ey;
    const double t = length2 > 0 ? std::clamp((wx * ex + wy * ey) / length2, 0.0, 1.0) : 0.0;
    const double dx = wx - t * ex, dy = wy - t * ey;
    if (turned || !on_edge(v[i], v[j], domain)) nearest2 = std::min(nearest2, dx * dx + dy * dy);
    if ((v[i][1] > within[1]) != (v[j][1] > within[1]) &&
        within[0] < v[i][0] + ex * (within[1] - v[i][1]) / ey)
      inside = !inside;
  }
  return (inside ? -1 : 1) * std::sqrt(nearest2);
}

void Polygon::read_vertices(Polygon& polygon, const TableReading& reading, const Key& key) {
  const CaseReading& in = reading.in;
  const Node& list = *reading.record.node(key.name);
  if (!list.is_array() || list.children.size() < 3)
    return in.out.error(list.place, fmt::format("'{}' needs a list of at least three corners", key.name),
                        "e.g. " + key.example);
  for (const Node& corner : list.children) {
    if (!corner.is_array() || corner.children.size() != 2) {
      in.out.error(corner.place,
                   "a corner of a polygon is a pair of coordinates, but this is " + describe(corner),
                   "e.g. [\"4 mm\", \"0 mm\"]");
      continue;
    }
    polygon.vertices.push_back({read_quantity(corner.children[0], in.axes[0], "m", in.out, "\"1 mm\""),
                                read_quantity(corner.children[1], in.axes[1], "m", in.out, "\"1 mm\"")});
    if (in.geometry == Geometry::axisymmetric && polygon.vertices.back()[0] < 0)
      in.out.error(corner.place, "a corner of a polygon lies below the axis r = 0");
  }
}

std::string Polygon::write_vertices(const Polygon& polygon, const char* /*name*/, const Writing& /*how*/) {
  std::vector<std::string> corners;
  for (const auto& v : polygon.vertices)
    corners.push_back(fmt::format("[{}, {}]", written_quantity(v[0], "m"), written_quantity(v[1], "m")));
  return fmt::format("[{}]", fmt::join(corners, ", "));
}

}  // namespace recoil::config
