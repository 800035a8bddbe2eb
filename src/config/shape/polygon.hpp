#pragma once

#include <string>
#include <vector>

#include "config/declare/entry.hpp"
#include "config/shape/bounds.hpp"
#include "config/shape/outline.hpp"
#include "config/shape/slabs.hpp"
#include "core/error.hpp"

namespace recoil::config {

struct Polygon {
  std::vector<Corner> vertices;  // m, either orientation
  double rotation = 0;           // rad, counter-clockwise about `centre`
  Vector centre{};               // m

  static constexpr const char* kind = "polygon";
  static constexpr const char* doc = "A polygon in the plane.";
  static std::vector<Geometry> only_in() { return {Geometry::planar, Geometry::axisymmetric}; }
  static Entries<Polygon> keys() {
    return {{.name = "vertices",
             .member = Custom<Polygon>{Key::Type::any, false, read_vertices, write_vertices},
             .required = true,
             .doc = "its corners in order, each a pair of coordinates",
             .example = R"([["0 mm", "0 mm"], ["4 mm", "0 mm"], ["0 mm", "3 mm"]])"},
            {.name = "rotation",
             .member = &Polygon::rotation,
             .unit = "rad",
             .doc = "turned by this angle about `centre`, counter-clockwise (planar, axisymmetric)",
             .example = R"("10 deg")"},
            {.name = "centre",
             .member = &Polygon::centre,
             .unit = "m",
             .doc = "centre of rotation; without it the origin",
             .example = R"({ x = "1 mm" })"}};
  }

  /// Edges on the edge of the domain do not count, and points on or beyond it are inside where the domain
  /// next to them is.
  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& domain) const {
    if constexpr (Dim == 2) return distance_in_plane(turned_back(rotation, centre, x), domain);
    require(false, "a shape of a kind that this dimension has");
    return 0;
  }

  Bounds bounds(const Domain& /*domain*/) const { return Bounds::of_corners(vertices, rotation, centre); }

 private:
  static void read_vertices(Polygon& polygon, const TableReading& reading, const Key& key);
  static std::string write_vertices(const Polygon& polygon, const char* name, const Writing& how);
  double distance_in_plane(const Vec<2>& x, const Domain& domain) const;
};

}  // namespace recoil::config
