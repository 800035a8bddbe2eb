#pragma once

#include <cmath>

#include "mesh/grid.hpp"

namespace recoil {

/// A place, moved by whole periods to where it is nearest to x.
template <int Dim>
Vec<Dim> image_near(const Grid<Dim>& grid, Vec<Dim> place, const Vec<Dim>& x) {
  for (int d = 0; d < Dim; ++d) {
    const double length = grid.cells[d] * grid.dx;
    if (grid.periodic(d)) place[d] -= length * std::round((place[d] - x[d]) / length);
  }
  return place;
}

/// a - b, the shortest way across the edges of periods.
template <int Dim>
Vec<Dim> shortest_way(const Grid<Dim>& grid, const Vec<Dim>& a, const Vec<Dim>& b) {
  return image_near(grid, a, b) - b;
}

/// x, moved by whole periods into the domain.
template <int Dim>
Vec<Dim> into_domain(const Grid<Dim>& grid, Vec<Dim> x) {
  for (int d = 0; d < Dim; ++d) {
    const double length = grid.cells[d] * grid.dx;
    if (grid.periodic(d)) x[d] -= length * std::floor((x[d] - grid.origin[d]) / length);
  }
  return x;
}

}  // namespace recoil
