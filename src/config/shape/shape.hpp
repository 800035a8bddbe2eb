#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "config/diagnostics.hpp"
#include "config/shape/box.hpp"
#include "config/shape/cylinder.hpp"
#include "config/shape/extrusion.hpp"
#include "config/shape/half_space.hpp"
#include "config/shape/lattice.hpp"
#include "config/shape/moved.hpp"
#include "config/shape/polygon.hpp"
#include "config/shape/round/cone.hpp"
#include "config/shape/round/ogive.hpp"
#include "config/shape/round/revolution.hpp"
#include "config/shape/round/torus.hpp"
#include "config/shape/several.hpp"
#include "config/shape/sphere.hpp"
#include "config/shape/stl/stl.hpp"

namespace recoil::config {

/// Every kind of shape, in the order of help. A kind has `distance`; where it can say, also its smallest
/// extent `thickness` [m], `along_mesh`, its `extent`, its `bounds`, and how it is `continued` beyond the
/// edge of the domain.
using ShapeKind = std::variant<Box, Cylinder, Sphere, HalfSpace, Cone, Frustum, Ogive, Torus, Revolution,
                               Polygon, Extrusion, Stl, Union, Intersection, Difference, Moved, Lattice>;

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
double distance_to(const Shape& shape, const Vec<Dim>& x, const Domain& domain);

/// The shape with what reaches the edge of the domain continued beyond it.
Shape continued(const Shape& shape, const Domain& domain);

/// Smallest extent of a plain shape [m]; 1e300 where the shape does not tell.
double thickness(const Shape& shape, const Domain& domain);

/// Whether all of its faces are along the axes.
bool along_mesh(const Shape& shape);

/// Where it reaches along the axes, if it is plain.
Extent extent_of(const Shape& shape, Geometry geometry);

/// A box along the axes that holds it.
Bounds bounds_of(const Shape& shape, const Domain& domain);

}  // namespace recoil::config
