#pragma once

#include <cmath>
#include <functional>

#include "cases.hpp"
#include "core/index.hpp"
#include "core/turn.hpp"
#include "problem/shape.hpp"

/// Domains without anything in them, and how tests measure shapes there.
namespace recoil::measured {

inline const config::Domain line = domain_of(config::Geometry::line, vector_of(-9), vector_of(9));
inline const config::Domain plane = domain_of(config::Geometry::planar, vector_of(-9, -9), vector_of(9, 9));
inline const config::Domain round =
    domain_of(config::Geometry::axisymmetric, vector_of(0, -9), vector_of(9, 9));
inline const config::Domain space =
    domain_of(config::Geometry::space, vector_of(-9, -9, -9), vector_of(9, 9, 9));

template <int Dim>
double at(const config::Shape& s, const config::Domain& domain, const Vec<Dim>& x) {
  return signed_distance<Dim>(s, domain)(x);
}

/// A direction askew to all axes.
inline const config::Vector oblique_axis{2.0 / 7, -3.0 / 7, 6.0 / 7};

/// The place at a distance r from the oblique axis through (0.5, -0.3, 0.2), at z along it.
inline Vec<3> on_oblique(double r, double z, double phase) {
  const Vec<3> a{oblique_axis}, p = unit(cross(a, Vec<3>{{1, 0, 0}})), q = cross(a, p);
  return Vec<3>{{0.5, -0.3, 0.2}} + z * a + r * std::cos(phase) * p + r * std::sin(phase) * q;
}

/// Integral over the inside of 1 or, axisymmetric, r: parts of cells of width dx from `lo`.
template <int Dim>
double volume_of(const config::Shape& s, const config::Domain& domain, const Vec<Dim>& lo, int cells,
                 double dx) {
  const auto distance = signed_distance<Dim>(s, domain);
  const bool axisymmetric = domain.geometry == config::Geometry::axisymmetric;
  Box<Dim> box;
  for (int d = 0; d < Dim; ++d) box.hi[d] = cells;
  double sum = 0, cell = 1;
  for (int d = 0; d < Dim; ++d) cell *= dx;
  for_each(box, [&](const Index<Dim>& i) {
    Vec<Dim> x = lo;
    for (int d = 0; d < Dim; ++d) x[d] += (i[d] + 0.5) * dx;
    sum += inside_part<Dim>(distance, x, dx, axisymmetric) * cell;
  });
  return sum;
}

template <int Dim>
Vec<Dim> gradient(const std::function<double(const Vec<Dim>&)>& f, const Vec<Dim>& x) {
  Vec<Dim> g;
  for (int d = 0; d < Dim; ++d) {
    Vec<Dim> a = x, b = x;
    a[d] -= 1e-5;
    b[d] += 1e-5;
    g[d] = (f(b) - f(a)) / 2e-5;
  }
  return g;
}

}  // namespace recoil::measured
