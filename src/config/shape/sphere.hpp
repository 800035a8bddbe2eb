#pragma once

#include <vector>

#include "config/declare/entry.hpp"
#include "config/declare/reading.hpp"
#include "config/shape/bounds.hpp"
#include "config/shape/slabs.hpp"

namespace recoil::config {

struct Sphere {
  double radius = 0;  // m
  Vector centre{};    // m

  static constexpr const char* kind = "sphere";
  static constexpr const char* doc = "A ball.";
  static std::vector<Geometry> only_in() {
    return {Geometry::spherical, Geometry::axisymmetric, Geometry::space};
  }
  static Entries<Sphere> keys() {
    return {{.name = "radius",
             .member = &Sphere::radius,
             .unit = "m",
             .positive = true,
             .required = true,
             .doc = "its radius",
             .example = R"("5 mm")"},
            {.name = "centre",
             .member = &Sphere::centre,
             .unit = "m",
             .doc = "its centre; without it the origin",
             .example = R"({ x = "1 mm" })"}};
  }
  void check(const TableReading& reading) const {
    if (reading.in.geometry == Geometry::axisymmetric && centre[0] != 0)
      reading.refuse("centre", "'centre' must lie on the axis r = 0", "for a ring use a polygon or a box");
    if (reading.in.geometry == Geometry::spherical && centre[0] != 0)
      reading.refuse("centre", "'centre' must be r = 0, the centre of symmetry", "for a shell use a box");
  }

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& /*domain*/) const {
    return ball_distance(centre, radius, x);
  }
  double thickness(const Domain& /*domain*/) const { return 2 * radius; }
  Bounds bounds(const Domain& /*domain*/) const { return Bounds::around(centre, radius); }
};

}  // namespace recoil::config
