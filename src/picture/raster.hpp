#pragma once

#include <vector>

#include "format/unstructured_grid.hpp"
#include "picture/outline.hpp"

namespace recoil {

/// The first two axes of a grid of boxes as an even array at the size of its smallest cell, for pictures:
/// each place has the value of the cell that covers it, NaN where there is none. Coarser cells fill many
/// places. Of a 3-D grid only the cells that hold z = `cut` count; of a 1-D one the array has one row.
/// @param values one per cell; NaN counts as no cell, so that several bodies may share a place.
/// @param most limits nx and ny: beyond it the array is coarser than the smallest cell.
/// @throws InternalError where values are not one per cell; an empty grid gives an empty array.
PlaneArray rasterise(const UnstructuredGrid& grid, const std::vector<double>& values, double cut = 0.0,
                     int most = 4096);

/// The edges of the cells of that plane as one outline per cell, for the mesh in a picture. Cells smaller
/// than `smallest` [m] are left out.
std::vector<Outline> cell_edges(const UnstructuredGrid& grid, double cut = 0.0, double smallest = 0.0);

}  // namespace recoil
