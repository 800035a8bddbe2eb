#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "config/declare/entry.hpp"
#include "config/declare/reading.hpp"
#include "config/shape/bounds.hpp"
#include "config/shape/slabs.hpp"

namespace recoil::config {

struct Cylinder {
  double radius = 0;               // m
  std::array<double, 2> length{};  // m; 3d: extent along its axis from centre; axisymmetric: z range
  Vector centre{};                 // m; planar, 3d
  Vector axis{0, 0, 1};            // 3d: unit vector
  Vector from{}, to{};             // m, 3d: the other way to say where it lies

  static constexpr const char* kind = "cylinder";
  static constexpr const char* doc =
      "A cylinder: axisymmetric about the axis, 3d anywhere; planar the same as disc.";
  static std::vector<Geometry> only_in() {
    return {Geometry::planar, Geometry::axisymmetric, Geometry::space};
  }
  static std::vector<Alias> aliases() { return {{"disc", "A disc in the plane.", {Geometry::planar}}}; }
  static Entries<Cylinder> keys() {
    return {
        {.name = "radius",
         .member = &Cylinder::radius,
         .unit = "m",
         .positive = true,
         .required = true,
         .doc = "its radius",
         .example = R"("5 mm")"},
        {.name = "z",
         .member = &Cylinder::length,
         .unit = "m",
         .required = true,
         .doc = "extent along the axis (axisymmetric)",
         .example = R"(["0 mm", "15 mm"])",
         .only_in = {Geometry::axisymmetric}},
        {.name = "centre",
         .member = &Cylinder::centre,
         .unit = "m",
         .doc = "its centre; without it the origin",
         .example = R"({ x = "1 mm" })",
         .only_in = {Geometry::planar, Geometry::space}},
        {.name = "axis",
         .member = &Cylinder::axis,
         .rule = Rule::direction,
         .doc = "direction of its axis (3d); without it z",
         .example = "{ x = 1 }",
         .only_in = {Geometry::space}},
        {.name = "along",
         .member = &Cylinder::length,
         .unit = "m",
         .doc = "extent along its axis, from `centre` (3d)",
         .example = R"(["0 mm", "15 mm"])",
         .only_in = {Geometry::space}},
        end("from", &Cylinder::from, "middle of one face, with `to` in place of centre, axis and along (3d)"),
        end("to", &Cylinder::to, "middle of the other face (3d)")};
  }
  void check(const TableReading& reading);

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& domain) const {
    if constexpr (Dim == 2) {
      if (domain.geometry == Geometry::axisymmetric)
        return from_slabs(std::array<double, 2>{x[0] - radius, std::max(length[0] - x[1], x[1] - length[1])});
    }
    if constexpr (Dim == 3) {
      const Vec<3> r = x - first_components<3>(centre), a = first_components<3>(axis);
      const double along = dot(r, a);
      return from_slabs(std::array<double, 2>{norm(r - along * a) - radius,
                                              std::max(length[0] - along, along - length[1])});
    }
    return ball_distance(centre, radius, x);
  }

  double thickness(const Domain& domain) const {
    const bool flat_disc = domain.geometry == Geometry::planar;
    return std::min(flat_disc ? 1e300 : length[1] - length[0], 2 * radius);
  }

  Bounds bounds(const Domain& domain) const;
  Extent extent(Geometry geometry) const;

 private:
  static Entry<Cylinder> end(const char* name, Vector Cylinder::*member, const char* doc) {
    return {.name = name,
            .member = member,
            .unit = "m",
            .doc = doc,
            .example = R"({ x = "1 mm" })",
            .only_in = {Geometry::space},
            .when = [](const Cylinder&) { return false; }};
  }
};

}  // namespace recoil::config
