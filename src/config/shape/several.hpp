#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "config/declare/entry.hpp"
#include "config/shape/extent.hpp"
#include "core/vec.hpp"

namespace recoil::config {

struct Shape;

/// Reads a list of at least `fewest` shapes.
void read_shapes(std::vector<Shape>& parts, const TableReading& reading, const Key& key, std::size_t fewest);
std::string write_shapes(const std::vector<Shape>& parts, const Writing& how);

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

struct Union {
  std::vector<Shape> parts;

  static constexpr const char* kind = "union";
  static constexpr const char* doc = "All that lies in one of several shapes.";
  static Entries<Union> keys() { return keys_of_parts<Union, 1>("the shapes that make it up"); }

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& domain) const;  // in shape.hpp, which knows the parts
  Union continued(const Domain& domain) const;
};

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
};

}  // namespace recoil::config
