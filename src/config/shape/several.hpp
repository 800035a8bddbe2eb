#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "config/declare/entry.hpp"
#include "config/shape/bounds.hpp"
#include "core/vec.hpp"

namespace recoil::config {

struct Shape;

void read_only_shape(std::vector<Shape>& shape, const TableReading& reading, const Key& key);
/// Reads a list of at least `fewest` shapes.
void read_shapes(std::vector<Shape>& parts, const TableReading& reading, const Key& key, std::size_t fewest);
std::string write_only_shape(const std::vector<Shape>& shape, const Writing& how);
std::string write_shapes(const std::vector<Shape>& parts, const Writing& how);

/// The key `shape` of a shape that is made of one other, which its vector `shape` holds.
template <class T>
Entry<T> key_of_shape(const char* doc) {
  return {
      .name = "shape",
      .member = Custom<T>{
          Key::Type::table, true,
          [](T& t, const TableReading& reading, const Key& key) { read_only_shape(t.shape, reading, key); },
          [](const T& t, const char*, const Writing& how) { return write_only_shape(t.shape, how); }},
      .required = true,
      .doc = doc,
      .example = R"({ kind = "sphere", radius = "5 mm" })"};
}

/// The key `parts` of a shape that is made of others.
template <class T, std::size_t Fewest>
Entries<T> keys_of_parts(const char* doc) {
  return {{.name = "parts",
           .member = Custom<T>{Key::Type::any, false,
                               [](T& shape, const TableReading& reading, const Key& key) {
                                 read_shapes(shape.parts, reading, key, Fewest);
                               },
                               [](const T& shape, const char*, const Writing& how) {
                                 return write_shapes(shape.parts, how);
                               }},
           .required = true,
           .doc = doc,
           .example = R"([{ kind = "box", ... }, { kind = "disc", ... }])"}};
}

/// Distance: exact outside where its parts are, a bound inside. Parts that only touch leave a surface between
/// them.
struct Union {
  std::vector<Shape> parts;

  static constexpr const char* kind = "union";
  static constexpr const char* doc = "All that lies in one of several shapes.";
  static Entries<Union> keys() { return keys_of_parts<Union, 1>("the shapes that make it up"); }

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& domain) const;  // in shape.cpp, which knows the parts
  Union continued(const Domain& domain) const;
  Bounds bounds(const Domain& domain) const;
};

/// Distance: exact inside where its parts are, a bound outside.
struct Intersection {
  std::vector<Shape> parts;

  static constexpr const char* kind = "intersection";
  static constexpr const char* doc = "All that lies in each of several shapes.";
  static Entries<Intersection> keys() {
    return keys_of_parts<Intersection, 2>("the shapes that have it in common");
  }

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& domain) const;
  Intersection continued(const Domain& domain) const;
  Bounds bounds(const Domain& domain) const;
};

/// Distance: exact inside where its parts are, a bound outside.
struct Difference {
  std::vector<Shape> parts;

  static constexpr const char* kind = "difference";
  static constexpr const char* doc = "The first of several shapes without the others.";
  static Entries<Difference> keys() {
    return keys_of_parts<Difference, 2>("the shape, and what is cut out of it");
  }

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& domain) const;
  Difference continued(const Domain& domain) const;
  Bounds bounds(const Domain& domain) const;
};

}  // namespace recoil::config
