#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "config/geometry.hpp"
#include "core/vec.hpp"

/// What several shapes measure with.
namespace recoil::config {

template <int Dim>
Vec<Dim> first_components(const Vector& v) {
  Vec<Dim> x;
  for (int d = 0; d < Dim; ++d) x[d] = v[d];
  return x;
}

/// From the signed distances to pairs of parallel planes: outside, the distance to the corner or face.
template <std::size_t N>
double from_slabs(const std::array<double, N>& slab) {
  double outside = 0, inside = -1e300;
  for (const double s : slab) {
    inside = std::max(inside, s);
    if (s > 0) outside += s * s;
  }
  return inside > 0 ? std::sqrt(outside) : inside;
}

/// Pushes an end [m] on or beyond the edge of the domain far beyond it.
inline void continue_beyond(double& lo, double& hi, double domain_lo, double domain_hi) {
  constexpr double far = 1e6;  // m
  const double near = 1e-9 * (domain_hi - domain_lo);
  if (lo <= domain_lo + near) lo = domain_lo - far;
  if (hi >= domain_hi - near) hi = domain_hi + far;
}

template <int Dim>
double ball_distance(const Vector& centre, double radius, const Vec<Dim>& x) {
  return norm(x - first_components<Dim>(centre)) - radius;
}

/// x turned back by a rotation [rad, counter-clockwise] about a centre, into the frame in which a shape is
/// given.
template <int Dim>
Vec<Dim> turned_back(double rotation, const Vector& centre, const Vec<Dim>& x) {
  if constexpr (Dim == 1) return x;
  if (rotation == 0) return x;
  const double c = std::cos(rotation), n = std::sin(rotation);
  const double a = x[0] - centre[0], b = x[1] - centre[1];
  Vec<Dim> y = x;
  y[0] = centre[0] + a * c + b * n;
  y[1] = centre[1] - a * n + b * c;
  return y;
}

}  // namespace recoil::config
