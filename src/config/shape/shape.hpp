#pragma once

#include <algorithm>
#include <cstddef>
#include <variant>
#include <vector>

#include "config/diagnostics.hpp"
#include "config/shape/box.hpp"
#include "config/shape/cylinder.hpp"
#include "config/shape/half_space.hpp"
#include "config/shape/polygon.hpp"
#include "config/shape/several.hpp"
#include "config/shape/sphere.hpp"

namespace recoil::config {

/// Every kind of shape, in the order of help. A kind has `distance`; where it can say, also its smallest
/// extent `thickness` [m], `along_mesh`, its `extent`, and how it is `continued` beyond the edge of the
/// domain.
using ShapeKind = std::variant<Box, Cylinder, Sphere, HalfSpace, Polygon, Union, Difference>;

inline constexpr const char* shape_kind_doc = "the kind of shape";

/// A region of space.
struct Shape {
  ShapeKind form;
  Place place = {};
};

/// Reads a shape from its table { kind = ..., ... }.
Shape read_shape(const Node& node, const CaseReading& in);

/// Signed distance [m], negative inside, of one that does not continue beyond the domain by itself.
template <int Dim>
double distance_to(const Shape& shape, const Vec<Dim>& x, const Domain& domain) {
  return std::visit([&](const auto& s) { return s.distance(x, domain); }, shape.form);
}

template <int Dim>
double Union::distance(const Vec<Dim>& x, const Domain& domain) const {
  double d = 1e300;
  for (const Shape& part : parts) d = std::min(d, distance_to(part, x, domain));
  return d;
}

template <int Dim>
double Difference::distance(const Vec<Dim>& x, const Domain& domain) const {
  double d = distance_to(parts.front(), x, domain);
  for (std::size_t i = 1; i < parts.size(); ++i) d = std::max(d, -distance_to(parts[i], x, domain));
  return d;
}

/// The shape with what reaches the edge of the domain continued beyond it.
Shape continued(const Shape& shape, const Domain& domain);

/// Smallest extent of a plain shape [m]; 1e300 where the shape does not tell.
double thickness(const Shape& shape, const Domain& domain);

/// Whether all of its faces are along the axes.
bool along_mesh(const Shape& shape);

/// Where it reaches along the axes, if it is plain.
Extent extent_of(const Shape& shape, Geometry geometry);

}  // namespace recoil::config
