#include "config/shape/simple_outline.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>

namespace recoil::config {

namespace {

/// Twice the area of a triangle: above 0 where it runs counter-clockwise.
double turn(const Corner& a, const Corner& b, const Corner& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool cross(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

/// The numbers, from 1, of the first corners of two edges that cross; 0: there are none.
std::array<std::size_t, 2> crossing_edges(const std::vector<Corner>& corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 1; k < n; ++k)
      if (cross(corners[i], corners[(i + 1) % n], corners[k], corners[(k + 1) % n])) return {i + 1, k + 1};
  return {};
}

double area(const std::vector<Corner>& corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    twice += turn(corners.front(), corners[i], corners[(i + 1) % corners.size()]);
  return 0.5 * twice;
}

}  // namespace

void check_simple_outline(const std::vector<Corner>& corners, const TableReading& reading, const Key& key) {
  if (corners.size() < 3) return;
  if (const auto edges = crossing_edges(corners); edges[0] != 0)
    return reading.wrong(key.name,
                         fmt::format("the edges from corner {} and from corner {} cross", edges[0], edges[1]),
                         "give the corners in the order in which one meets them along the outline");
  if (area(corners) == 0)
    reading.wrong(key.name, "the corners lie on one line", "move one of them, so that there is an area");
}

}  // namespace recoil::config
