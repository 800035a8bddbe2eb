#pragma once

#include <vector>

#include "config/shape/several.hpp"

namespace recoil::config {

/// Copies of a shape at equal distances along the axes. Distance: that of a union of them.
struct Lattice {
  std::vector<Shape> shape;      // one
  Vector count{1, 1, 1};         // copies along each axis, whole numbers
  Vector pitch{};                // m
  std::vector<Shape> copies;     // all of them
  std::vector<Bounds> around{};  // around each

  static constexpr const char* kind = "lattice";
  static constexpr const char* doc =
      "Copies of another shape at equal distances along the axes, the first where it is given.";
  static Entries<Lattice> keys();
  void check(const TableReading& reading);
  /// Fills `copies` and `around` from the rest.
  void make_copies();

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& domain) const;
  Lattice continued(const Domain& domain) const;
  double thickness(const Domain& domain) const;
  Bounds bounds(const Domain& domain) const;
};

}  // namespace recoil::config
