#pragma once

#include <cmath>
#include <cstddef>

#include "config/declare/entry.hpp"
#include "config/shape/extent.hpp"
#include "config/shape/slabs.hpp"

namespace recoil::config {

/// Matter where (x - point) . normal < 0.
struct HalfSpace {
  Vector point{};   // m
  Vector normal{};  // unit vector

  static constexpr const char* kind = "half-space";
  static constexpr const char* doc = "All that lies behind a plane.";
  static Entries<HalfSpace> keys() {
    return {{.name = "point",
             .member = &HalfSpace::point,
             .unit = "m",
             .required = true,
             .doc = "a point of its surface",
             .example = R"({ x = "1 mm" })"},
            {.name = "normal",
             .member = &HalfSpace::normal,
             .required = true,
             .rule = Rule::direction,
             .doc = "points out of the matter",
             .example = "{ x = 1 }"}};
  }

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& /*domain*/) const {
    return dot(x - first_components<Dim>(point), first_components<Dim>(normal));
  }

  Extent extent(Geometry /*geometry*/) const {
    Extent e;
    for (std::size_t d = 0; d < 3; ++d) {
      e.lo[d] = -endless, e.hi[d] = endless;
      if (std::abs(normal[d]) < 1 - 1e-9) continue;
      e.plain = true;
      (normal[d] > 0 ? e.hi[d] : e.lo[d]) = point[d];
    }
    return e;
  }
};

}  // namespace recoil::config
