#pragma once

#include <algorithm>
#include <vector>

#include "config/shape/round/line.hpp"

namespace recoil::config {

/// Distance to the frustum between the radii a at along = 0 and b at along = length; exact [m].
double frustum_distance(const Meridian& at, double a, double b, double length);

struct Cone : Line {
  double radius = 0;  // m, at `from`

  static constexpr const char* kind = "cone";
  static constexpr const char* doc = "A cone from the middle of its base to its tip; planar a wedge.";
  static std::vector<Geometry> only_in() { return with_line(); }
  static Entries<Cone> keys();
  void check(const TableReading& reading) { check_line(reading); }

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& /*domain*/) const {
    return frustum_distance(about_line(x), radius, 0, size());
  }
  Bounds bounds(const Domain& /*domain*/) const { return bounds_within(radius); }
};

struct Frustum : Line {
  double from_radius = 0, to_radius = 0;  // m

  static constexpr const char* kind = "frustum";
  static constexpr const char* doc = "A cone without its tip: two round faces of different size.";
  static std::vector<Geometry> only_in() { return with_line(); }
  static Entries<Frustum> keys();
  void check(const TableReading& reading);

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& /*domain*/) const {
    return frustum_distance(about_line(x), from_radius, to_radius, size());
  }
  Bounds bounds(const Domain& /*domain*/) const { return bounds_within(std::max(from_radius, to_radius)); }
};

}  // namespace recoil::config
