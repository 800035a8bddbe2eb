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

std::vector<PlaneCell> cells_in_plane(const UnstructuredGrid& grid, Cut cut) {
  std::vector<PlaneCell> cells;
  for (std::size_t n = 0; n < grid.cells(); ++n) {
    const Box box = box_of(grid, n);
    const bool solid = grid.types[n] == static_cast<unsigned char>(VtkCell::hexahedron);
    if (!solid || (cut.place >= box.lower[cut.axis] && cut.place < box.upper[cut.axis]))
      cells.push_back({box, n});
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

/// The two axes that span a plane.
std::array<std::size_t, 2> axes_of(Cut cut) { return {cut.axis == 0 ? 1U : 0U, cut.axis == 2 ? 1U : 2U}; }

}  // namespace

Raster::Raster(const UnstructuredGrid& grid, Cut cut, int most) : cells_(grid.cells()) {
  const auto cells = cells_in_plane(grid, cut);
  if (cells.empty()) return;
  const auto [across, up] = axes_of(cut);
  const Spacing x = spacing(cells, across, most), y = spacing(cells, up, most);
  empty_ = {x.count, y.count, x.lower, y.lower, x.step, y.step, {}};
  covered_.reserve(cells.size());
  for (const auto& [box, number] : cells)
    covered_.push_back(
        {number, places(x, box.lower[across], box.upper[across]), places(y, box.lower[up], box.upper[up])});
}

PlaneArray Raster::of(const std::vector<double>& values) const {
  require(values.size() == cells_, "a value per cell");
  PlaneArray array = empty_;
  const auto nx = static_cast<std::size_t>(array.nx);
  array.values.assign(nx * static_cast<std::size_t>(array.ny), std::numeric_limits<double>::quiet_NaN());
  for (const auto& [cell, columns, rows] : covered_) {
    if (std::isnan(values[cell])) continue;
    for (int j = rows[0]; j < rows[1]; ++j)
      for (int i = columns[0]; i < columns[1]; ++i)
        array.values[static_cast<std::size_t>(i) + nx * static_cast<std::size_t>(j)] = values[cell];
  }
  return array;
}

std::vector<Outline> cell_edges(const UnstructuredGrid& grid, Cut cut, double smallest) {
  const auto [x, y] = axes_of(cut);
  std::vector<Outline> edges;
  for (const auto& [box, number] : cells_in_plane(grid, cut)) {
    const auto& [lo, hi] = box;
    if (hi[x] - lo[x] < smallest) continue;
    edges.push_back({{{lo[x], lo[y]}, {hi[x], lo[y]}, {hi[x], hi[y]}, {lo[x], hi[y]}}, true});
  }
  return edges;
}

}  // namespace recoil
