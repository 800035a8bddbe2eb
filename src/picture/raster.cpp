#include "picture/raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/error.hpp"

namespace recoil {
namespace {

/// Extent of a cell along the three axes [m].
struct Box {
  std::array<double, 3> lower, upper;
};

Box box_of(const UnstructuredGrid& grid, std::size_t cell) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (auto k = grid.offsets[cell]; k < grid.offsets[cell + 1]; ++k) {
    const auto point = static_cast<std::size_t>(grid.connectivity[k]);
    for (std::size_t d = 0; d < 3; ++d) {
      box.lower[d] = std::min(box.lower[d], grid.points[3 * point + d]);
      box.upper[d] = std::max(box.upper[d], grid.points[3 * point + d]);
    }
  }
  return box;
}

/// The boxes of the cells that count, with their numbers. A cell holds its lower face and not its upper one,
/// so that a cut between two layers shows one of them.
struct PlaneCell {
  Box box;
  std::size_t number;
};

std::vector<PlaneCell> cells_in_plane(const UnstructuredGrid& grid, double cut) {
  std::vector<PlaneCell> cells;
  for (std::size_t n = 0; n < grid.cells(); ++n) {
    const Box box = box_of(grid, n);
    const bool solid = grid.types[n] == static_cast<unsigned char>(VtkCell::hexahedron);
    if (!solid || (cut >= box.lower[2] && cut < box.upper[2])) cells.push_back({box, n});
  }
  return cells;
}

/// Number of places along one axis and their size.
struct Spacing {
  double lower = 0, step = 0;
  int count = 0;
};

Spacing spacing(const std::vector<PlaneCell>& cells, std::size_t axis, int most) {
  double lower = cells.front().box.lower[axis], upper = cells.front().box.upper[axis];
  double step = std::numeric_limits<double>::infinity();
  for (const auto& [box, number] : cells) {
    lower = std::min(lower, box.lower[axis]);
    upper = std::max(upper, box.upper[axis]);
    if (box.upper[axis] > box.lower[axis]) step = std::min(step, box.upper[axis] - box.lower[axis]);
  }
  if (!(upper > lower)) return {lower, 1.0, 1};  // the second axis of a 1-D grid
  const int count = std::clamp(static_cast<int>(std::lround(std::min((upper - lower) / step, 1e6))), 1, most);
  return {lower, (upper - lower) / count, count};
}

/// The places along one axis whose middle lies between two ends: [first, last).
std::array<int, 2> places(const Spacing& s, double from, double to) {
  if (!(to > from)) return {0, 1};
  const auto first = [&s](double x) {
    return std::clamp(static_cast<int>(std::ceil((x - s.lower) / s.step - 0.5 - 1e-6)), 0, s.count);
  };
  return {first(from), first(to)};
}

}  // namespace

PlaneArray rasterise(const UnstructuredGrid& grid, const std::vector<double>& values, double cut, int most) {
  require(values.size() == grid.cells(), "a value per cell");
  const auto cells = cells_in_plane(grid, cut);
  if (cells.empty()) return {};
  const Spacing x = spacing(cells, 0, most), y = spacing(cells, 1, most);
  PlaneArray array{x.count, y.count, x.lower, y.lower, x.step, y.step, {}};
  const auto nx = static_cast<std::size_t>(x.count);
  array.values.assign(nx * static_cast<std::size_t>(y.count), std::numeric_limits<double>::quiet_NaN());
  for (const auto& [box, number] : cells) {
    if (std::isnan(values[number])) continue;
    const auto is = places(x, box.lower[0], box.upper[0]), js = places(y, box.lower[1], box.upper[1]);
    for (int j = js[0]; j < js[1]; ++j)
      for (int i = is[0]; i < is[1]; ++i)
        array.values[static_cast<std::size_t>(i) + nx * static_cast<std::size_t>(j)] = values[number];
  }
  return array;
}

std::vector<Outline> cell_edges(const UnstructuredGrid& grid, double cut, double smallest) {
  std::vector<Outline> edges;
  for (const auto& [box, number] : cells_in_plane(grid, cut)) {
    const auto& [lo, hi] = box;
    if (hi[0] - lo[0] < smallest) continue;
    edges.push_back({{{lo[0], lo[1]}, {hi[0], lo[1]}, {hi[0], hi[1]}, {lo[0], hi[1]}}, true});
  }
  return edges;
}

}  // namespace recoil
