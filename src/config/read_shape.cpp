#include "config/read_shape.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace recoil::config {

std::vector<std::string> axes_of(Geometry geometry) {
  switch (geometry) {
    case Geometry::line:
      return {"x"};
    case Geometry::planar:
      return {"x", "y"};
    case Geometry::axisymmetric:
      return {"r", "z"};
    case Geometry::space:
      return {"x", "y", "z"};
  }
  throw InternalError("internal error: unknown geometry");
}

Vector normalised(Vector v) {
  const double size = std::hypot(v[0], v[1], v[2]);
  constexpr double round_off = 1e-14;
  if (size > 0 && std::abs(size - 1) > round_off)
    for (double& c : v) c /= size;
  return v;
}

std::string name_of(Geometry geometry) {
  constexpr std::array names{"1d", "planar", "axisymmetric", "3d"};
  return names[static_cast<std::size_t>(geometry)];
}

bool read_extents(const Record& record, const std::string& where, const CaseReading& reading, Vector& lo,
                  Vector& hi) {
  const std::string axes = fmt::format("{}", fmt::join(reading.axes, ", "));
  bool good = true;
  for (const char* name : {"x", "y", "r", "z"}) {
    const auto axis = std::find(reading.axes.begin(), reading.axes.end(), name);
    if (axis == reading.axes.end()) {
      if (!record.has(name)) continue;
      reading.out.error(record.key_place(name),
                        fmt::format("'{}' in [{}] is no coordinate of a case with geometry \"{}\"", name,
                                    where, name_of(reading.geometry)),
                        fmt::format("its coordinates are {}", axes));
      good = false;
      continue;
    }
    if (!record.has(name))
      reading.out.error(record.place(), fmt::format("'{}' is missing in [{}]", name, where),
                        fmt::format("give [low, high], e.g. {} = [\"0 mm\", \"10 mm\"]", name));
    good = good && record.good(name);
    const auto d = static_cast<std::size_t>(axis - reading.axes.begin());
    lo[d] = record.range(name)[0];
    hi[d] = record.range(name)[1];
  }
  return good;
}

namespace {

using Kind = Shape::Kind;

bool flat(Geometry g) { return g == Geometry::planar || g == Geometry::axisymmetric; }

/// Reads one shape; `where` is its path for messages.
struct ShapeReader {
  const Node& node;
  const Record& record;
  const CaseReading& in;
  const std::string& kind;

  void refuse(const std::string& key, const std::string& why, const std::string& help = {}) const {
    in.out.error(record.key_place(key), fmt::format("'{}' in [{}] {}", key, node.path, why), help);
  }

  void needs(const std::string& key, const std::string& example) const {
    if (!record.has(key))
      in.out.error(record.place(), fmt::format("'{}' is missing in [{}]", key, node.path),
                   fmt::format("a {} needs it here, e.g. {} = {}", kind, key, example));
  }

  /// Keys that mean nothing in this geometry.
  void only(const std::string& key, bool allowed) const {
    if (record.has(key) && !allowed)
      refuse(key, fmt::format("means nothing for geometry \"{}\"", name_of(in.geometry)));
  }

  Vector unit_vector(const std::string& key) const {
    const Vector v = record.vector3(key);
    if (v == Vector{} && record.good(key)) refuse(key, "has no direction: all its components are 0");
    return normalised(v);
  }

  void on_axis(const Shape& shape) const {
    if (in.geometry == Geometry::axisymmetric && shape.centre[0] != 0)
      refuse("centre", "must lie on the axis r = 0", "for a ring use a polygon or a box");
  }

  void box(Shape& shape) const {
    shape.kind = Kind::box;
    const bool good = read_extents(record, node.path, in, shape.lo, shape.hi);
    if (good && in.geometry == Geometry::axisymmetric && shape.lo[0] < 0)
      refuse("r", "begins below the axis r = 0");
    only("rotation", flat(in.geometry));
    only("centre", flat(in.geometry));
    shape.rotation = record.number("rotation");
    for (std::size_t d = 0; d < 3; ++d) shape.centre[d] = 0.5 * (shape.lo[d] + shape.hi[d]);
    if (record.has("centre")) shape.centre = record.vector3("centre");
  }

  void cylinder(Shape& shape) const {
    shape.kind = Kind::cylinder;
    shape.radius = record.number("radius");
    shape.centre = record.vector3("centre");
    only("z", in.geometry == Geometry::axisymmetric);
    only("axis", in.geometry == Geometry::space);
    only("along", in.geometry == Geometry::space);
    only("centre", in.geometry != Geometry::axisymmetric);
    if (in.geometry == Geometry::axisymmetric) needs("z", "[\"0 mm\", \"15 mm\"]");
    if (in.geometry == Geometry::space) needs("along", "[\"0 mm\", \"15 mm\"]");
    const auto [lo, hi] = record.range(in.geometry == Geometry::space ? "along" : "z");
    shape.length_lo = lo;
    shape.length_hi = hi;
    shape.axis = record.has("axis") ? unit_vector("axis") : Vector{0, 0, 1};
  }

  void round(Shape& shape) const {
    shape.kind = kind == "sphere" ? Kind::sphere : Kind::cylinder;
    shape.radius = record.number("radius");
    shape.centre = record.vector3("centre");
    if (kind == "sphere") on_axis(shape);
  }

  void half_space(Shape& shape) const {
    shape.kind = Kind::half_space;
    shape.point = record.vector3("point");
    shape.normal = unit_vector("normal");
  }

  void polygon(Shape& shape) const {
    shape.kind = Kind::polygon;
    shape.rotation = record.number("rotation");
    shape.centre = record.vector3("centre");
    const Node* list = record.node("vertices");
    if (!list) return;
    if (!list->is_array() || list->children.size() < 3)
      return in.out.error(list->place, "'vertices' needs a list of at least three corners",
                          "e.g. [[\"0 mm\", \"0 mm\"], [\"4 mm\", \"0 mm\"], [\"0 mm\", \"3 mm\"]]");
    for (const Node& corner : list->children) {
      if (!corner.is_array() || corner.children.size() != 2) {
        in.out.error(corner.place,
                     "a corner of a polygon is a pair of coordinates, but this is " + describe(corner),
                     "e.g. [\"4 mm\", \"0 mm\"]");
        continue;
      }
      shape.vertices.push_back({read_quantity(corner.children[0], in.axes[0], "m", in.out, "\"1 mm\""),
                                read_quantity(corner.children[1], in.axes[1], "m", in.out, "\"1 mm\"")});
      if (in.geometry == Geometry::axisymmetric && shape.vertices.back()[0] < 0)
        in.out.error(corner.place, "a corner of a polygon lies below the axis r = 0");
    }
  }

  void several(Shape& shape) const {
    shape.kind = kind == "union" ? Kind::combined : Kind::difference;
    const Node* list = record.node("parts");
    if (!list) return;
    const std::size_t fewest = kind == "union" ? 1 : 2;
    if (!list->is_array() || list->children.size() < fewest)
      return in.out.error(list->place, fmt::format("'parts' needs a list of at least {} shapes", fewest));
    for (const Node& part : list->children) shape.parts.push_back(read_shape(part, in));
  }

  Shape read() const {
    Shape shape;
    shape.place = node.place;
    if (kind == "box" || kind == "rectangle") box(shape);
    if (kind == "cylinder") cylinder(shape);
    if (kind == "disc" || kind == "sphere") round(shape);
    if (kind == "half-space") half_space(shape);
    if (kind == "polygon") polygon(shape);
    if (kind == "union" || kind == "difference") several(shape);
    return shape;
  }
};

/// The geometries that a kind of shape exists in; empty: in all.
std::vector<Geometry> geometries_of(const std::string& kind) {
  using enum Geometry;
  if (kind == "rectangle" || kind == "polygon") return {planar, axisymmetric};
  if (kind == "disc") return {planar};
  if (kind == "cylinder") return {planar, axisymmetric, space};
  if (kind == "sphere") return {axisymmetric, space};
  return {};
}

}  // namespace

Shape read_shape(const Node& node, const CaseReading& in) {
  const Node* kind_node = node.find("kind");
  if (!node.is_table() || !kind_node) {
    in.out.error(node.place, fmt::format("a shape needs its kind, but [{}] has none", node.path),
                 R"(e.g. { kind = "box", x = ["0 mm", "2 mm"] })");
    return {};
  }
  // The kind alone first: it says which other keys there may be.
  const std::string section = "body.*.shape";
  const Key& kind_key = keys_of(section, "box").front();
  const bool known =
      std::find(kind_key.choices.begin(), kind_key.choices.end(), kind_node->text) != kind_key.choices.end();
  if (!kind_node->is_text() || !known) {
    Node only_kind = node;
    only_kind.children = {*kind_node};
    read_record(only_kind, {&kind_key, 1}, in.out);
    return {};
  }
  const std::string& kind = kind_node->text;
  const std::vector<Geometry> where = geometries_of(kind);
  if (!where.empty() && std::find(where.begin(), where.end(), in.geometry) == where.end()) {
    std::vector<std::string> names;
    for (const Geometry g : where) names.push_back(name_of(g));
    in.out.error(kind_node->place,
                 fmt::format("a {} does not exist in geometry \"{}\"", kind, name_of(in.geometry)),
                 fmt::format("it does in: {}", fmt::join(names, ", ")));
    return {};
  }
  const Record record = read_record(node, keys_of(section, kind), in.out, in.axes);
  return ShapeReader{node, record, in, kind}.read();
}

}  // namespace recoil::config
