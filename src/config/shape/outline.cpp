#include "config/shape/outline.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "config/declare/reading.hpp"
#include "config/declare/write.hpp"

namespace recoil::config {

double area_of(std::span<const Corner> corners) {
  double twice = 0;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++)
    twice += corners[j][0] * corners[i][1] - corners[i][0] * corners[j][1];
  return 0.5 * std::abs(twice);
}

std::vector<Corner> read_corners(const TableReading& reading, const Key& key, std::size_t fewest,
                                 const std::array<std::string, 2>& names) {
  const CaseReading& in = reading.in;
  const Node& list = *reading.record.node(key.name);
  std::vector<Corner> corners;
  if (!list.is_array() || list.children.size() < fewest) {
    in.out.error(list.place, fmt::format("'{}' needs a list of at least {} corners", key.name, fewest),
                 "e.g. " + key.example);
    return corners;
  }
  for (const Node& corner : list.children) {
    if (!corner.is_array() || corner.children.size() != 2) {
      in.out.error(corner.place,
                   fmt::format("a corner of '{}' is a pair of coordinates, but this is {}", key.name,
                               describe(corner)),
                   "e.g. [\"4 mm\", \"0 mm\"]");
      continue;
    }
    corners.push_back({read_quantity(corner.children[0], names[0], "m", in.out, "\"1 mm\""),
                       read_quantity(corner.children[1], names[1], "m", in.out, "\"1 mm\"")});
  }
  return corners;
}

std::string write_corners(const std::vector<Corner>& corners) {
  std::vector<std::string> texts;
  for (const Corner& c : corners)
    texts.push_back(fmt::format("[{}, {}]", written_quantity(c[0], "m"), written_quantity(c[1], "m")));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

void check_radii(const std::vector<Corner>& corners, const TableReading& reading, const char* key) {
  const Node* list = reading.record.node(key);
  if (!list || corners.size() != list->children.size()) return;  // reported already
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (corners[i][0] < 0)
      reading.in.out.error(list->children[i].place,
                           fmt::format("a corner of '{}' lies below the axis r = 0", key),
                           "radii are from 0 on: the other half is the same by symmetry");
}

}  // namespace recoil::config
