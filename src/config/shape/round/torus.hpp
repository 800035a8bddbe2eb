#pragma once

#include <cmath>
#include <vector>

#include "config/shape/round/line.hpp"

namespace recoil::config {

/// A ring of round section. Exact distance.
struct Torus {
  double radius = 0, tube = 0;  // m: of the line in its middle, and of its section
  Vector centre{};              // m
  Vector axis{0, 0, 1};         // 3d: unit vector

  static constexpr const char* kind = "torus";
  static constexpr const char* doc = "A ring of round section about an axis, axisymmetric about r = 0.";
  static std::vector<Geometry> only_in() { return {Geometry::axisymmetric, Geometry::space}; }
  static Entries<Torus> keys() {
    Entries<Torus> keys{{.name = "radius",
                         .member = &Torus::radius,
                         .unit = "m",
                         .positive = true,
                         .required = true,
                         .doc = "from the axis to the middle of its section",
                         .example = R"("10 mm")"},
                        {.name = "tube",
                         .member = &Torus::tube,
                         .unit = "m",
                         .positive = true,
                         .required = true,
                         .doc = "radius of its section",
                         .example = R"("2 mm")"}};
    for (auto& key :
         centre_keys<Torus>("its centre; without it the origin", "direction of its axis (3d); without it z"))
      keys.push_back(key);
    return keys;
  }
  void check(const TableReading& reading) const {
    check_on_axis(centre, reading);
    if (reading.good("radius") && reading.good("tube") && tube > radius)
      reading.wrong("tube", "the section of this ring reaches across its axis",
                    "'radius' is that of the ring's middle line, and at least 'tube'");
  }

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& /*domain*/) const {
    const Meridian at = about(x, first_components<Dim>(centre), own_axis<Dim>(axis));
    return std::hypot(at.radius - radius, at.along) - tube;
  }
  double thickness(const Domain& /*domain*/) const { return 2 * tube; }
  Bounds bounds(const Domain& /*domain*/) const { return Bounds::around(centre, radius + tube); }
};

}  // namespace recoil::config
