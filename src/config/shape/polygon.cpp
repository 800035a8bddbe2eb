#include "config/shape/polygon.hpp"

#include "config/declare/reading.hpp"
#include "config/shape/simple_outline.hpp"

namespace recoil::config {

double Polygon::distance_in_plane(const Vec<2>& x, const Domain& domain) const {
  if (rotation != 0)
    return outline_distance(vertices, x, x, [](const Corner&, const Corner&) { return false; });
  const Frame frame{{domain.lo[0], domain.lo[1]}, {domain.hi[0], domain.hi[1]}};
  return outline_distance(vertices, x, frame.inner(x),
                          [&](const Corner& a, const Corner& b) { return frame.holds_edge(a, b); });
}

void Polygon::read_vertices(Polygon& polygon, const TableReading& reading, const Key& key) {
  const CaseReading& in = reading.in;
  polygon.vertices = read_corners(reading, key, 3, {in.axes[0], in.axes[1]});
  check_simple_outline(polygon.vertices, reading, key);
  if (in.geometry == Geometry::axisymmetric) check_radii(polygon.vertices, reading, key.name.c_str());
}

std::string Polygon::write_vertices(const Polygon& polygon, const char* /*name*/, const Writing& /*how*/) {
  return write_corners(polygon.vertices);
}

}  // namespace recoil::config
