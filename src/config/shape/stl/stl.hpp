#pragma once

#include <memory>
#include <string>
#include <vector>

#include "config/declare/entry.hpp"
#include "config/shape/bounds.hpp"
#include "core/error.hpp"

namespace recoil::config {

class ClosedSurface;

/// What a closed surface of triangles encloses. Exact distance (closed_surface.hpp).
struct Stl {
  std::string file;                              // as the case names it
  double scale = 0;                              // m, length of 1 in the file
  std::string digest;                            // of the file's bytes
  std::shared_ptr<const ClosedSurface> surface;  // scaled

  static constexpr const char* kind = "stl";
  static constexpr const char* doc = "What the closed surface of an STL file encloses, text or binary.";
  static std::vector<Geometry> only_in() { return {Geometry::space}; }
  static Entries<Stl> keys();
  void check(const TableReading& reading);

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& /*domain*/) const {
    if constexpr (Dim == 3) return distance_in_space(x);
    require(false, "a shape of a kind that this dimension has");
    return 0;
  }
  Bounds bounds(const Domain& domain) const;

 private:
  double distance_in_space(const Vec<3>& x) const;
};

}  // namespace recoil::config
