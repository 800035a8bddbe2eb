#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "format/unstructured_grid.hpp"
#include "picture/outline.hpp"

namespace recoil {

/// A plane across one of the axes of a 3-D grid; the other two, in their order, span it.
struct Cut {
  std::size_t axis = 2;
  double place = 0;  ///< m
};

/// How an even array at the size of the smallest cell covers a plane of a grid of boxes: each place has the
/// cell that covers it. Coarser cells fill many places. Of a 3-D grid only the cells that the cut goes
/// through count; of another one all do, in its first two axes, and the array of a 1-D grid has one row.
class Raster {
 public:
  /// @param most limits nx and ny: beyond it the array is coarser than the smallest cell.
  explicit Raster(const UnstructuredGrid& grid, Cut cut = {}, int most = 4096);
  /// @param values one per cell of the grid; NaN counts as no cell, so that several bodies may share a place.
  /// @returns NaN where there is no cell; an empty array for an empty grid.
  /// @throws InternalError where values are not one per cell.
  PlaneArray of(const std::vector<double>& values) const;

 private:
  /// The places that a cell covers: columns and rows, first and end.
  struct Covered {
    std::size_t cell;
    std::array<int, 2> columns, rows;
  };
  PlaneArray empty_;  // without values
  std::vector<Covered> covered_;
  std::size_t cells_;
};

/// The same for one array of values.
inline PlaneArray rasterise(const UnstructuredGrid& grid, const std::vector<double>& values, Cut cut = {},
                            int most = 4096) {
  return Raster(grid, cut, most).of(values);
}

/// The edges of the cells of that plane as one outline per cell, for the mesh in a picture. Cells smaller
/// than `smallest` [m] are left out.
std::vector<Outline> cell_edges(const UnstructuredGrid& grid, Cut cut = {}, double smallest = 0.0);

}  // namespace recoil
