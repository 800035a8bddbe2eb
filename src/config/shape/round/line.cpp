#include "config/shape/round/line.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace recoil::config {

namespace {

/// Whether the keys that are there say where both ends are.
bool ends_are_given(const TableReading& reading) {
  const bool from = reading.has("from"), to = reading.has("to");
  const bool axis = reading.has("axis"), length = reading.has("length");
  if (from && to && (axis || length)) {
    reading.refuse(axis ? "axis" : "length", "'from' and 'to' say already where the axis lies",
                   "remove 'axis' and 'length', or one of the ends");
    return false;
  }
  if ((from && to) || ((from || to) && axis && length)) return true;
  reading.in.out.error(
      reading.record.place(),
      fmt::format("{} needs both ends of its axis, 'from' and 'to', or one of them with 'axis' and 'length'",
                  reading.owner.what),
      fmt::format("e.g. from = {{ {0} = \"0 mm\" }}, to = {{ {0} = \"30 mm\" }}", reading.in.axes.back()));
  return false;
}

}  // namespace

void check_on_axis(const Vector& centre, const TableReading& reading) {
  if (reading.in.geometry == Geometry::axisymmetric && centre[0] != 0)
    reading.refuse("centre", "'centre' must lie on the axis r = 0", "give its z only");
}

double Line::size() const { return std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]); }

void Line::check_line(const TableReading& reading) {
  if (!ends_are_given(reading)) return;
  for (const char* key : {"from", "to", "axis", "length"})
    if (reading.has(key) && !reading.good(key)) return;
  for (std::size_t d = 0; d < 3; ++d) {
    if (!reading.has("to")) to[d] = from[d] + length * axis[d];
    if (!reading.has("from")) from[d] = to[d] - length * axis[d];
  }
  const char* key = reading.has("to") ? "to" : "from";
  if (from == to) reading.wrong(key, "its axis has no length: both ends are the same", "move one of them");
  if (reading.in.geometry == Geometry::axisymmetric && (from[0] != 0 || to[0] != 0))
    reading.wrong(key, "its axis must be the axis r = 0", "give r = 0 or leave it out");
}

}  // namespace recoil::config
