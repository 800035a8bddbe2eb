#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "config/shape/extent.hpp"
#include "config/shape/slabs.hpp"

namespace recoil::config {

/// A box along the axes that holds a shape; endless where the shape is, or does not tell.
struct Bounds {
  Vector lo{-endless, -endless, -endless}, hi{endless, endless, endless};  // m

  /// Around a ball.
  static Bounds around(const Vector& centre, double radius) {
    Bounds b;
    for (std::size_t d = 0; d < 3; ++d) b.lo[d] = centre[d] - radius, b.hi[d] = centre[d] + radius;
    return b;
  }
  /// Around points of the plane that are turned about a centre [rad, counter-clockwise].
  static Bounds of_corners(const std::vector<std::array<double, 2>>& corners, double rotation,
                           const Vector& centre) {
    Bounds b;
    for (std::size_t d = 0; d < 2; ++d) std::swap(b.lo[d], b.hi[d]);
    for (const auto& corner : corners) {
      const Vec<2> x = turned_back(-rotation, centre, Vec<2>{corner});
      for (std::size_t d = 0; d < 2; ++d) {
        b.lo[d] = std::min(b.lo[d], x.c[d]);
        b.hi[d] = std::max(b.hi[d], x.c[d]);
      }
    }
    return b;
  }
  /// The box that holds both.
  Bounds with(const Bounds& other) const {
    Bounds b;
    for (std::size_t d = 0; d < 3; ++d) {
      b.lo[d] = std::min(lo[d], other.lo[d]);
      b.hi[d] = std::max(hi[d], other.hi[d]);
    }
    return b;
  }
  Bounds moved(const Vector& by) const {
    Bounds b = *this;
    for (std::size_t d = 0; d < 3; ++d) b.lo[d] += by[d], b.hi[d] += by[d];
    return b;
  }
  /// Distance to the box [m], 0 inside.
  template <int Dim>
  double distance(const Vec<Dim>& x) const {
    double sum = 0;
    for (int d = 0; d < Dim; ++d) {
      const double out = std::max({lo[d] - x[d], x[d] - hi[d], 0.0});
      sum += out * out;
    }
    return std::sqrt(sum);
  }
};

}  // namespace recoil::config
