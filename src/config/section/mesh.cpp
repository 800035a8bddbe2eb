#include "config/section/mesh.hpp"

#include <fmt/format.h>

#include <cstddef>

#include "config/declare/extents.hpp"
#include "config/declare/read_struct.hpp"
#include "config/declare/reading.hpp"

namespace recoil::config {

Entries<Region> Region::keys() {
  const auto extent = extent_along<Region>;
  using enum Geometry;
  std::vector<Entry<Region>> all{extent("x", "from, to"), extent("y", "from, to"), extent("r", "from, to"),
                                 extent("z", "from, to")};
  all[0].only_in = {line, planar, space};
  all[1].only_in = {planar, space};
  all[2].only_in = {axisymmetric, spherical};
  all[3].only_in = {axisymmetric, space};
  return all;
}

void read_regions(const Node& table, std::vector<Region>& regions, CaseReading& in) {
  for (const Node& node : table.children) {
    if (!check_is_table(node, "refine", in.out) || !check_name(node, "refine", in.out)) continue;
    Region& region = regions.emplace_back();
    region.name = node.key;
    read_struct(node, region, in);
  }
}

void MeshChoice::check(const TableReading& reading) const {
  const CaseReading& in = reading.in;
  if (reading.good("block") && block != 0 && block < least_block)
    reading.wrong("block",
                  fmt::format("blocks of {} cells are too small: at least {} are needed, since each block "
                              "reads so far into those beside it",
                              block, least_block),
                  "leave 'block' out, or write block = 16");
  if (reading.good("block") && levels > 1 && block % 2 != 0)
    reading.wrong("block",
                  fmt::format("blocks of {} cells: a mesh of several levels needs an even number, since "
                              "coarser cells lie in one block each",
                              block),
                  fmt::format("block = {}", block + 1));
  if (!reading.good("finest")) return;
  for (std::size_t d = 0; d < in.axes.size(); ++d) {
    const double extent = in.hi[d] - in.lo[d];
    if (!(extent > 0) || extent >= 3.999 * finest) continue;
    reading.wrong("finest",
                  fmt::format("the domain is {:.3g} cells wide along {}; at least 4 are needed",
                              extent / finest, in.axes[d]),
                  fmt::format("finest = \"{:.4g} mm\" gives 40", 1e3 * extent / 40));
  }
}

}  // namespace recoil::config
