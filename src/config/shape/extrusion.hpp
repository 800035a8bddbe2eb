#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/declare/entry.hpp"
#include "config/shape/bounds.hpp"
#include "config/shape/outline.hpp"
#include "config/shape/slabs.hpp"
#include "core/error.hpp"

namespace recoil::config {

/// A polygon in the plane across one of the axes, swept along it. Exact distance outside, and inside. Faces
/// on the edge of the domain are none, as with boxes and polygons.
struct Extrusion {
  std::vector<Corner> vertices;         // m, of the two other coordinates in their order
  std::array<double, 2> x{}, y{}, z{};  // m, the extent along the axis that has one
  int along = 2;                        // that axis

  static constexpr const char* kind = "extrusion";
  static constexpr const char* doc = "A polygon swept along the axis whose extent is given: a prism.";
  static std::vector<Geometry> only_in() { return {Geometry::space}; }
  static Entries<Extrusion> keys();
  void check(const TableReading& reading) const;

  template <int Dim>
  double distance(const Vec<Dim>& at, const Domain& domain) const {
    if constexpr (Dim == 3) return distance_in_space(at, domain);
    require(false, "a shape of a kind that this dimension has");
    return 0;
  }
  /// With those end faces that lie on the edge of the domain pushed far beyond it.
  Extrusion continued(const Domain& domain) const;
  Bounds bounds(const Domain& domain) const;

 private:
  std::array<double, 2>& extent() { return along == 0 ? x : along == 1 ? y : z; }
  const std::array<double, 2>& extent() const { return along == 0 ? x : along == 1 ? y : z; }
  double distance_in_space(const Vec<3>& at, const Domain& domain) const;
  static void read_vertices(Extrusion& shape, const TableReading& reading, const Key& key);
  static std::string write_vertices(const Extrusion& shape, const char* name, const Writing& how);
};

}  // namespace recoil::config
