#pragma once

#include "mesh/grid.hpp"

namespace recoil {

/// The cells between whose centres x lies: f(cell, its weight in the linear interpolation) for each of the
/// 2^Dim with a weight above zero. Cells beyond the edges of the domain are among them.
template <int Dim, class F>
void for_corners(const Grid<Dim>& grid, const Vec<Dim>& x, F&& f) {
  Vec<Dim> half_back = x;
  for (int d = 0; d < Dim; ++d) half_back[d] -= 0.5 * grid.dx;
  const Index<Dim> low = grid.cell_of(half_back);
  const Vec<Dim> part = (x - grid.centre(low)) * (1 / grid.dx);
  for (unsigned corner = 0; corner < 1U << Dim; ++corner) {
    Index<Dim> i = low;
    double weight = 1;
    for (int d = 0; d < Dim; ++d) {
      const bool high = (corner >> d & 1U) != 0;
      i[d] += high ? 1 : 0;
      weight *= high ? part[d] : 1 - part[d];
    }
    if (weight > 0) f(i, weight);
  }
}

}  // namespace recoil
