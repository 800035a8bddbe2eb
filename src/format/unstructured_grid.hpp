#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace recoil {

/// Numbers of the kind in which they are stored.
using ArrayValues = std::variant<std::vector<float>, std::vector<double>, std::vector<std::int32_t>>;

/// One field on the cells. The name carries the unit, in characters that a file may hold: "pressure_GPa".
struct NamedArray {
  std::string name;
  int components = 1;  ///< 1, 3 for a vector, 6 for a symmetric tensor (xx, yy, zz, xy, yz, xz)
  ArrayValues values;  ///< components per cell side by side
};

/// Kinds of cells as VTK numbers them, with the order of their points.
enum class VtkCell : unsigned char {
  line = 3,        ///< two ends
  quad = 9,        ///< four corners, anticlockwise
  hexahedron = 12  ///< lower four anticlockwise, then the upper four
};

/// A set of cells with their corners. Defaults are an empty but valid grid.
struct UnstructuredGrid {
  std::vector<double> points;              ///< x, y, z per point [m]
  std::vector<std::int64_t> connectivity;  ///< numbers of the points of each cell, one cell after the other
  std::vector<std::int64_t> offsets{0};    ///< where each cell begins in connectivity; cells + 1 entries
  std::vector<unsigned char> types;        ///< a VtkCell per cell
  std::vector<NamedArray> cell_arrays;
  std::vector<NamedArray> whole_arrays;  ///< of no cell, with as many rows as they need; any columns

  std::size_t cells() const { return types.size(); }
};

/// Adds a cell with its own points: a box from `lower` to `upper` in the first `dim` directions.
/// @param dim 1 makes a line, 2 a quadrilateral (z = lower[2]), 3 a hexahedron.
void add_box_cell(UnstructuredGrid& grid, int dim, const double (&lower)[3], const double (&upper)[3]);

/// Joins points that are the same to the bit, as those of neighbouring boxes are: a smaller file and a
/// connected grid. Points keep the order of their first use.
void merge_points(UnstructuredGrid& grid);

/// The array of that name, or the one whose name without the unit it is ("pressure" for "pressure_GPa").
/// @throws InputError naming the arrays that exist.
const NamedArray& find_array(const UnstructuredGrid& grid, std::string_view name);

/// The values as doubles.
std::vector<double> as_doubles(const ArrayValues& values);

/// Checks that the parts fit together. @throws InternalError naming what does not.
void check_grid(const UnstructuredGrid& grid);

}  // namespace recoil
