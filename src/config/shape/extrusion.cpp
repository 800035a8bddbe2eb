#include "config/shape/extrusion.hpp"

#include <algorithm>
#include <cstddef>

#include "config/declare/reading.hpp"
#include "config/shape/simple_outline.hpp"

namespace recoil::config {

namespace {

constexpr const char* names[] = {"x", "y", "z"};

/// The two axes across `along`, in their order.
std::array<int, 2> across(int along) { return {along == 0 ? 1 : 0, along == 2 ? 1 : 2}; }

}  // namespace

Entries<Extrusion> Extrusion::keys() {
  const auto side = [](const char* name, std::array<double, 2> Extrusion::*member,
                       bool (*when)(const Extrusion&)) {
    return Entry<Extrusion>{.name = name,
                            .member = member,
                            .unit = "m",
                            .doc = "extent along it, if that is the axis of the sweep: one of x, y, z",
                            .example = R"(["0 mm", "10 mm"])",
                            .when = when};
  };
  return {side("x", &Extrusion::x, [](const Extrusion& e) { return e.along == 0; }),
          side("y", &Extrusion::y, [](const Extrusion& e) { return e.along == 1; }),
          side("z", &Extrusion::z, [](const Extrusion& e) { return e.along == 2; }),
          {.name = "vertices",
           .member = Custom<Extrusion>{Key::Type::any, false, read_vertices, write_vertices},
           .required = true,
           .doc = "corners of the polygon in order, each a pair of the two other coordinates",
           .example = R"([["0 mm", "0 mm"], ["4 mm", "0 mm"], ["0 mm", "3 mm"]])"}};
}

void Extrusion::read_vertices(Extrusion& shape, const TableReading& reading, const Key& key) {
  for (int d = 0; d < 3; ++d)
    if (reading.has(names[d])) shape.along = d;
  const auto [first, second] = across(shape.along);
  shape.vertices = read_corners(reading, key, 3, {names[first], names[second]});
  check_simple_outline(shape.vertices, reading, key);
}

std::string Extrusion::write_vertices(const Extrusion& shape, const char* /*name*/, const Writing& /*how*/) {
  return write_corners(shape.vertices);
}

void Extrusion::check(const TableReading& reading) const {
  const auto given =
      std::count_if(std::begin(names), std::end(names), [&](const char* n) { return reading.has(n); });
  if (given != 1)
    reading.in.out.error(
        reading.record.place(),
        "an extrusion needs the extent along one axis, 'x', 'y' or 'z'; its polygon lies in the "
        "plane of the two others",
        "e.g. z = [\"0 mm\", \"5 mm\"]");
}

double Extrusion::distance_in_space(const Vec<3>& at, const Domain& domain) const {
  const auto [first, second] = across(along);
  const auto a = static_cast<std::size_t>(first), b = static_cast<std::size_t>(second);
  const Frame frame{{domain.lo[a], domain.lo[b]}, {domain.hi[a], domain.hi[b]}};
  const Vec<2> p{{at[first], at[second]}};
  const double within = outline_distance(
      vertices, p, frame.inner(p), [&](const Corner& c, const Corner& d) { return frame.holds_edge(c, d); });
  const auto& [lo, hi] = extent();
  return from_slabs(std::array<double, 2>{within, std::max(lo - at[along], at[along] - hi)});
}

Extrusion Extrusion::continued(const Domain& domain) const {
  Extrusion s = *this;
  const auto d = static_cast<std::size_t>(along);
  continue_beyond(s.extent()[0], s.extent()[1], domain.lo[d], domain.hi[d]);
  return s;
}

Bounds Extrusion::bounds(const Domain& /*domain*/) const {
  const auto [first, second] = across(along);
  const Bounds outline = Bounds::of_corners(vertices, 0, {});
  Bounds b;
  const auto set = [&](int axis, double lo, double hi) {
    b.lo[static_cast<std::size_t>(axis)] = lo;
    b.hi[static_cast<std::size_t>(axis)] = hi;
  };
  set(first, outline.lo[0], outline.hi[0]);
  set(second, outline.lo[1], outline.hi[1]);
  set(along, extent()[0], extent()[1]);
  return b;
}

}  // namespace recoil::config
