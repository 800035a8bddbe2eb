#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "config/case.hpp"

/// Cases put together in code, as read_case() would give them.
namespace recoil {

inline config::Vector vector_of(double x, double y = 0, double z = 0) { return {x, y, z}; }

inline config::Domain domain_of(config::Geometry geometry, config::Vector lo, config::Vector hi,
                                config::Boundary edges = config::Boundary::outflow) {
  config::Domain d;
  d.geometry = geometry;
  d.lo = lo;
  d.hi = hi;
  for (auto& ends : d.boundary) ends = {edges, edges};
  if (config::has_radius(geometry)) d.boundary[0][0] = config::Boundary::axis;
  return d;
}

inline config::Shape box_shape(config::Vector lo, config::Vector hi) {
  config::Box box{.lo = lo, .hi = hi};
  for (std::size_t d = 0; d < 3; ++d) box.centre[d] = 0.5 * (lo[d] + hi[d]);
  return {box};
}

inline config::Shape ball_shape(config::Vector centre, double radius) {
  return {config::Sphere{radius, centre}};
}

inline config::Body body_of(std::string name, config::Shape shape, config::Vector velocity = {}) {
  config::Body b;
  b.name = std::move(name);
  b.shape = std::move(shape);
  b.velocity = velocity;
  return b;
}

}  // namespace recoil
