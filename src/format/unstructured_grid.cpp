#include "format/unstructured_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <unordered_map>
#include <utility>

#include "core/error.hpp"

namespace recoil {

void check_grid(const UnstructuredGrid& grid) {
  require(grid.points.size() % 3 == 0, "points have three coordinates");
  require(grid.offsets.size() == grid.cells() + 1, "a grid has one offset more than cells");
  require(grid.offsets.front() == 0 && std::ranges::is_sorted(grid.offsets) &&
              grid.offsets.back() == static_cast<std::int64_t>(grid.connectivity.size()),
          "offsets lead through the connectivity");
  const auto points = static_cast<std::int64_t>(grid.points.size() / 3);
  require(std::ranges::all_of(grid.connectivity, [points](std::int64_t p) { return p >= 0 && p < points; }),
          "cells use points that exist");
  for (const auto& array : grid.cell_arrays) {
    const std::size_t size = std::visit([](const auto& v) { return v.size(); }, array.values);
    require(array.components > 0 && size == grid.cells() * static_cast<std::size_t>(array.components),
            "an array has its components for each cell");
    require(!array.name.empty() && array.name.find('/') == std::string::npos, "an array has a plain name");
  }
}

void add_box_cell(UnstructuredGrid& grid, int dim, const double (&lower)[3], const double (&upper)[3]) {
  require(dim >= 1 && dim <= 3, "a cell has one to three dimensions");
  // Corners in VTK's order: bit 0 the end along x, bit 1 along y, bit 2 along z.
  constexpr std::array<unsigned, 8> order{0, 1, 3, 2, 4, 5, 7, 6};
  constexpr std::array<VtkCell, 3> kinds{VtkCell::line, VtkCell::quad, VtkCell::hexahedron};
  for (std::size_t k = 0; k < (std::size_t{1} << dim); ++k) {
    grid.connectivity.push_back(static_cast<std::int64_t>(grid.points.size() / 3));
    for (unsigned d = 0; d < 3; ++d) grid.points.push_back((order[k] >> d & 1u) != 0 ? upper[d] : lower[d]);
  }
  grid.offsets.push_back(static_cast<std::int64_t>(grid.connectivity.size()));
  grid.types.push_back(static_cast<unsigned char>(kinds[dim - 1]));
}

void merge_points(UnstructuredGrid& grid) {
  using Key = std::array<std::uint64_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& k) const {
      std::uint64_t h = 0x9e3779b97f4a7c15u;
      for (const auto part : k) h = (h ^ part ^ (part >> 31)) * 0xff51afd7ed558ccdu;
      return static_cast<std::size_t>(h ^ (h >> 33));
    }
  };
  std::unordered_map<Key, std::int64_t, Hash> seen;
  seen.reserve(grid.cells() * 2);
  std::vector<double> points;
  for (auto& id : grid.connectivity) {
    const double* p = &grid.points[3 * static_cast<std::size_t>(id)];
    const auto bits = [](double v) {
      return std::bit_cast<std::uint64_t>(v + 0.0);
    };  // -0 and 0 are one place
    const auto [place, fresh] =
        seen.try_emplace({bits(p[0]), bits(p[1]), bits(p[2])}, static_cast<std::int64_t>(points.size() / 3));
    if (fresh) points.insert(points.end(), p, p + 3);
    id = place->second;
  }
  grid.points = std::move(points);
}

const NamedArray& find_array(const UnstructuredGrid& grid, std::string_view name) {
  for (const auto& array : grid.cell_arrays)
    if (array.name == name) return array;
  for (const auto& array : grid.cell_arrays)
    if (std::string_view(array.name).substr(0, array.name.rfind('_')) == name) return array;
  std::string names;
  for (const auto& array : grid.cell_arrays) names += (names.empty() ? "" : ", ") + array.name;
  throw InputError(fmt::format("error: no field '{}'\n   = help: there are {}", name, names));
}

std::vector<double> as_doubles(const ArrayValues& values) {
  return std::visit([](const auto& v) { return std::vector<double>(v.begin(), v.end()); }, values);
}

}  // namespace recoil
