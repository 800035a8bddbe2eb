#pragma once

#include <cstddef>

#include "run.hpp"

namespace recoil {

/// Plates of a material, "flyer" and "target": 1 mm at 400 m/s on 2 mm along one axis, between planes of
/// symmetry: the target spalls.
template <int Dim>
config::Case plates(int axis, double dx, int block = 32) {
  using config::Boundary, config::Geometry;
  constexpr double mm = 1e-3;
  const auto e = static_cast<std::size_t>(axis);
  config::Vector lo{}, hi{}, u{};
  for (std::size_t d = 0; d < Dim; ++d) hi[d] = 3 * dx;
  lo[e] = -2 * mm, hi[e] = 3.6 * mm, u[e] = 400;
  const Geometry geometry = Dim == 1 ? Geometry::line : Dim == 2 ? Geometry::planar : Geometry::space;
  auto domain = domain_of(geometry, lo, hi, Boundary::symmetry);
  domain.boundary[e] = {Boundary::outflow, Boundary::outflow};
  auto low = lo, high = hi;
  low[e] = -1 * mm, high[e] = 0;
  auto c = case_of(domain, dx, {body_of("flyer", box_shape(low, high), u)});
  low[e] = 0, high[e] = 2 * mm;
  c.bodies.push_back(body_of("target", box_shape(low, high)));
  c.mesh.offset = 0.37;
  c.mesh.block = block;
  return c;
}

/// Mass [kg/m^(3 - Dim)] of body m that has failed.
template <int Dim>
double failed_mass(const TestRun<Dim>& run, int m) {
  using C = Components<Dim>;
  double sum = 0;
  for (const auto& b : run.state.bodies[m].blocks)
    for (std::size_t k = 0; k < b.volume.size(); ++k)
      if (b.contents[C::damage * b.volume.size() + k] >= failed_damage * b.contents[k]) sum += b.contents[k];
  return sum;
}

}  // namespace recoil
