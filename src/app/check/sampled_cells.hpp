#pragma once

#include <algorithm>
#include <cmath>

#include "mesh/grid.hpp"

namespace recoil::app {

/// f(x, width) for the middles x of cells spread evenly over the domain, at most about 1e5 of them; each
/// stands for a cube of this width [m].
template <int Dim, class F>
void for_each_sampled_cell(const Grid<Dim>& grid, F&& f) {
  constexpr double most = 1e5;
  double total = 1;
  for (int d = 0; d < Dim; ++d) total *= grid.cells[d];
  const int stride = static_cast<int>(std::max(1.0, std::ceil(std::pow(total / most, 1.0 / Dim))));
  Box<Dim> places;
  for (int d = 0; d < Dim; ++d) places.hi[d] = (grid.cells[d] + stride - 1) / stride;
  for_each(places, [&](const Index<Dim>& i) {
    Index<Dim> cell;
    for (int d = 0; d < Dim; ++d) cell[d] = std::min(i[d] * stride + stride / 2, grid.cells[d] - 1);
    f(grid.centre(cell), stride * grid.dx);
  });
}

}  // namespace recoil::app
