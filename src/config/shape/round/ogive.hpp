#pragma once

#include <vector>

#include "config/shape/round/line.hpp"

namespace recoil::config {

/// A projectile: a cylinder that a tangent ogive ends, an arc of a circle that continues the cylinder's side
/// without an edge. A nose of length n on a radius a belongs to an arc of radius R with (R - a)^2 + n^2 =
/// R^2, and R over the diameter 2 a is the calibre radius head. Exact distance.
struct Ogive : Line {
  double radius = 0;      // m
  double nose = 0;        // m, length
  double nose_ratio = 0;  // calibre radius head; the other way to give `nose`

  static constexpr const char* kind = "ogive";
  static constexpr const char* doc =
      "A projectile with a tangent ogive as its nose and a cylinder behind it; planar its section.";
  static std::vector<Geometry> only_in() { return with_line(); }
  static Entries<Ogive> keys();
  void check(const TableReading& reading);

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& /*domain*/) const {
    return distance_in_half_plane(about_line(x));
  }
  Bounds bounds(const Domain& /*domain*/) const { return bounds_within(radius); }

 private:
  double distance_in_half_plane(const Meridian& at) const;
};

}  // namespace recoil::config
