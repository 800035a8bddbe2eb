#include "config/shape/shape.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "config/declare/kinds.hpp"

namespace recoil::config {

Shape read_shape(const Node& node, const CaseReading& in) {
  Shape shape;
  shape.place = node.place;
  read_kind(node, shape.form, "shape", shape_kind_doc, in);
  return shape;
}

void read_shapes(std::vector<Shape>& parts, const TableReading& reading, const Key& key, std::size_t fewest) {
  const Node& list = *reading.record.node(key.name);
  if (!list.is_array() || list.children.size() < fewest)
    return reading.wrong(key.name, fmt::format("'{}' needs a list of at least {} shapes", key.name, fewest),
                         "e.g. [{ kind = \"box\", ... }, { kind = \"disc\", ... }]");
  for (const Node& part : list.children) parts.push_back(read_shape(part, reading.in));
}

void read_only_shape(std::vector<Shape>& shape, const TableReading& reading, const Key& key) {
  shape = {read_shape(*reading.record.node(key.name), reading.in)};
}

std::string write_only_shape(const std::vector<Shape>& shape, const Writing& how) {
  return inline_table(written_kind(shape.front().form, how));
}

std::string write_shapes(const std::vector<Shape>& parts, const Writing& how) {
  std::vector<std::string> texts;
  for (const Shape& part : parts) texts.push_back(inline_table(written_kind(part.form, how)));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

namespace {

std::vector<Shape> all_continued(const std::vector<Shape>& parts, const Domain& domain) {
  std::vector<Shape> all;
  for (const Shape& part : parts) all.push_back(continued(part, domain));
  return all;
}

}  // namespace

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
double Intersection::distance(const Vec<Dim>& x, const Domain& domain) const {
  double d = -1e300;
  for (const Shape& part : parts) d = std::max(d, distance_to(part, x, domain));
  return d;
}

template <int Dim>
double Difference::distance(const Vec<Dim>& x, const Domain& domain) const {
  double d = distance_to(parts.front(), x, domain);
  for (std::size_t i = 1; i < parts.size(); ++i) d = std::max(d, -distance_to(parts[i], x, domain));
  return d;
}

#define RECOIL_INSTANTIATE(Dim)                                                      \
  template double distance_to<Dim>(const Shape&, const Vec<Dim>&, const Domain&);    \
  template double Union::distance<Dim>(const Vec<Dim>&, const Domain&) const;        \
  template double Intersection::distance<Dim>(const Vec<Dim>&, const Domain&) const; \
  template double Difference::distance<Dim>(const Vec<Dim>&, const Domain&) const;
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

Bounds Union::bounds(const Domain& domain) const {
  if (parts.empty()) return {};
  Bounds all = bounds_of(parts.front(), domain);
  for (const Shape& part : parts) all = all.with(bounds_of(part, domain));
  return all;
}

Bounds Intersection::bounds(const Domain& domain) const { return bounds_of(parts.front(), domain); }
Bounds Difference::bounds(const Domain& domain) const { return bounds_of(parts.front(), domain); }

Union Union::continued(const Domain& domain) const { return {all_continued(parts, domain)}; }
Intersection Intersection::continued(const Domain& domain) const { return {all_continued(parts, domain)}; }
Difference Difference::continued(const Domain& domain) const { return {all_continued(parts, domain)}; }

Shape continued(const Shape& shape, const Domain& domain) {
  return std::visit(
      [&](const auto& s) {
        if constexpr (requires { s.continued(domain); }) return Shape{s.continued(domain), shape.place};
        return shape;
      },
      shape.form);
}

double thickness(const Shape& shape, const Domain& domain) {
  return std::visit(
      [&](const auto& s) {
        if constexpr (requires { s.thickness(domain); }) return s.thickness(domain);
        return 1e300;
      },
      shape.form);
}

bool along_mesh(const Shape& shape) {
  return std::visit(
      [&](const auto& s) {
        if constexpr (requires { s.along_mesh(); }) return s.along_mesh();
        return false;
      },
      shape.form);
}

Extent extent_of(const Shape& shape, Geometry geometry) {
  return std::visit(
      [&](const auto& s) {
        if constexpr (requires { s.extent(geometry); }) return s.extent(geometry);
        return Extent{};
      },
      shape.form);
}

Bounds bounds_of(const Shape& shape, const Domain& domain) {
  return std::visit(
      [&](const auto& s) {
        if constexpr (requires { s.bounds(domain); }) return s.bounds(domain);
        return Bounds{};
      },
      shape.form);
}

}  // namespace recoil::config
