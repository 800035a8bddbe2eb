#pragma once

#include <vector>

#include "config/declare/entry.hpp"
#include "config/declare/reading.hpp"
#include "config/shape/bounds.hpp"
#include "config/shape/slabs.hpp"

namespace recoil::config {

/// Where a place lies about an axis: its distance from it, and how far along it is [m].
struct Meridian {
  double radius = 0, along = 0;
};

/// @param foot the place of the axis at which `along` is 0; @param axis its direction, of length 1.
template <int Dim>
Meridian about(const Vec<Dim>& x, const Vec<Dim>& foot, const Vec<Dim>& axis) {
  const Vec<Dim> r = x - foot;
  const double along = dot(r, axis);
  return {norm(r - along * axis), along};
}

/// The axis of a shape that has one direction in 3d, and axisymmetric that of the domain.
template <int Dim>
Vec<Dim> own_axis(const Vector& axis) {
  if constexpr (Dim == 3) return first_components<3>(axis);
  Vec<Dim> z;
  z[Dim - 1] = 1;
  return z;
}

/// The keys `centre` and `axis` of such a shape.
template <class T>
Entries<T> centre_keys(const char* centre, const char* axis) {
  return {
      {.name = "centre", .member = &T::centre, .unit = "m", .doc = centre, .example = R"({ x = "1 mm" })"},
      {.name = "axis",
       .member = &T::axis,
       .rule = Rule::direction,
       .doc = axis,
       .example = "{ x = 1 }",
       .only_in = {Geometry::space}}};
}

/// Reports a centre off the axis of an axisymmetric domain.
void check_on_axis(const Vector& centre, const TableReading& reading);

/// The axis of a shape with two ends. Axisymmetric it lies on the domain's axis, planar the shape is its own
/// mirror image beyond it.
struct Line {
  Vector from{}, to{};  // m
  Vector axis{};        // the other way to give one of the ends: direction, and
  double length = 0;    // m

  /// Completes the ends, and reports what is wrong with them.
  void check_line(const TableReading& reading);

  double size() const;  // m

  template <int Dim>
  Meridian about_line(const Vec<Dim>& x) const {
    const Vec<Dim> a = first_components<Dim>(from);
    return about(x, a, unit(first_components<Dim>(to) - a));
  }
  /// Of a shape that reaches `radius` from its axis.
  Bounds bounds_within(double radius) const {
    return Bounds::around(from, radius).with(Bounds::around(to, radius));
  }
};

/// The keys of a Line that a shape is made of.
template <class T>
Entries<T> line_keys(const char* from, const char* to) {
  const auto given_otherwise = [](const T&) { return false; };
  return {{.name = "from",
           .member = static_cast<Vector T::*>(&Line::from),
           .unit = "m",
           .doc = from,
           .example = R"({ x = "1 mm" })"},
          {.name = "to",
           .member = static_cast<Vector T::*>(&Line::to),
           .unit = "m",
           .doc = to,
           .example = R"({ x = "9 mm" })"},
          {.name = "axis",
           .member = static_cast<Vector T::*>(&Line::axis),
           .rule = Rule::direction,
           .doc = "direction from one end to the other, with `length` in place of one of the ends",
           .example = "{ x = 1 }",
           .when = given_otherwise},
          {.name = "length",
           .member = static_cast<double T::*>(&Line::length),
           .unit = "m",
           .positive = true,
           .optional = true,
           .doc = "from one end to the other, with `axis`",
           .example = R"("8 mm")",
           .when = given_otherwise}};
}

/// Where shapes of revolution exist with a section of their own in the plane.
inline std::vector<Geometry> with_line() {
  return {Geometry::planar, Geometry::axisymmetric, Geometry::space};
}

}  // namespace recoil::config
