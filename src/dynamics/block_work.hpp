#pragma once

#include <cstddef>
#include <cstdint>

#include "state/body.hpp"

namespace recoil::detail {

/// The arrays of one block's update. Window arrays hold [component][window cells] and one vector more, so
/// that rows may be read in whole vectors; the others [component][cells].
template <int Dim>
struct Work {
  const Grid<Dim>& grid;
  Window<Dim> window;
  Box<Dim> cells;               // of the block that hold matter
  std::size_t n = 0, wide = 0;  // of those cells, of the window's
  double *primitive = nullptr, *impedance = nullptr, *stress = nullptr;
  std::uint8_t* role = nullptr;  // null where every cell has a value
  bool whole = false;            // cells are whole and real, or not there at all (ghost fluid)
  double* rate = nullptr;        // [contents]
  double* gradient = nullptr;    // [i * Dim + j]: integral of du_i/dx_j
  double* radial = nullptr;      // axisymmetric: mean over the two r-faces of the star velocities u_r, u_z
};

}  // namespace recoil::detail
