#include "config/shape/shape.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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
    return reading.wrong(key.name, fmt::format("'{}' needs a list of at least {} shapes", key.name, fewest));
  for (const Node& part : list.children) parts.push_back(read_shape(part, reading.in));
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

Union Union::continued(const Domain& domain) const { return {all_continued(parts, domain)}; }
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

}  // namespace recoil::config
