#pragma once

#include <string>
#include <vector>

#include "config/shape/several.hpp"
#include "config/shape/slabs.hpp"

namespace recoil::config {

/// A shape turned and then shifted. Its distance is that of the shape.
struct Moved {
  std::vector<Shape> shape;       // one
  Vector axis{0, 0, 1};           // 3d: unit vector
  double angle = 0;               // rad, right-handed about `axis` through `centre`, planar counter-clockwise
  Vector turn_from{}, turn_to{};  // 3d: the other way to give axis and angle, unit vectors
  Vector centre{}, shift{};       // m

  static constexpr const char* kind = "moved";
  static constexpr const char* doc = "Another shape, turned about a centre and then shifted.";
  static Entries<Moved> keys();
  void check(const TableReading& reading);

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& domain) const;
  /// A shape that is only shifted continues beyond the edges of the domain as it does without; a turned one
  /// does not.
  Moved continued(const Domain& domain) const;
  double thickness(const Domain& domain) const;
  Bounds bounds(const Domain& domain) const;

 private:
  /// The domain as the shape sees it before it is moved.
  Domain seen_from_shape(const Domain& domain) const;
  template <int Dim>
  Vec<Dim> moved_back(Vec<Dim> x) const;
  void turn_by_directions(const TableReading& reading);
};

}  // namespace recoil::config
