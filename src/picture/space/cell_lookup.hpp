#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/vec.hpp"
#include "format/unstructured_grid.hpp"
#include "picture/space/scene.hpp"

namespace recoil {

/// Finds the cell of a dump of a 3-D run that holds a point. Cells are cubes of several sizes, each a whole
/// multiple of the smallest one, at whole multiples of it.
class CellLookup {
 public:
  /// @throws InputError for a grid without hexahedra.
  explicit CellLookup(const UnstructuredGrid& grid);

  SpaceBox box() const { return box_; }  ///< around all cells [m]
  double finest() const { return dx_; }  ///< width of the smallest cell [m]
  /// Number of the cell; -1: none. A cell holds its lower faces, and the upper ones that the box has.
  int at(const Vec<3>& x) const;
  Vec<3> lower(int cell) const { return lower_[static_cast<std::size_t>(cell)]; }
  double width(int cell) const { return width_[static_cast<std::size_t>(cell)]; }

  /// The eight cells whose middles lie around a point and their weights, for values linear between them.
  struct Corners {
    std::array<int, 8> cell;  ///< -1: none
    std::array<double, 8> weight;
  };
  /// On the lattice of the cell that holds the point (of the smallest cells, where none does). Places beyond
  /// the box take the cells at its faces.
  Corners around(const Vec<3>& x) const;

 private:
  void enter(int cell, const std::array<int, 3>& first, int width);

  SpaceBox box_;
  double dx_ = 0;
  std::array<int, 3> bricks_{};      // along each axis; a brick has 8^3 places of the smallest cells
  std::vector<std::int32_t> brick_;  // -1: empty; below: -2 - cell, which fills it; else number of its places
  std::vector<std::int32_t> place_;  // 512 for each brick that several cells share
  std::vector<Vec<3>> lower_;
  std::vector<double> width_;
};

}  // namespace recoil
