#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "picture/canvas.hpp"

namespace recoil {

/// A curve in the plane [m]; a closed one does not repeat its first point.
struct Outline {
  Polyline points;
  bool closed = false;
};

/// A rectangular array of numbers in the plane, value (i, j) at [i + nx * j].
struct PlaneArray {
  int nx = 0, ny = 0;
  double x0 = 0, y0 = 0;  ///< lower left corner of the cells [m]
  double dx = 0, dy = 0;  ///< size of a cell [m]
  std::vector<double> values{};

  double at(int i, int j) const {
    return values[static_cast<std::size_t>(i) + static_cast<std::size_t>(nx) * static_cast<std::size_t>(j)];
  }
};

/// The curves where cell-centred values cross zero: marching squares (W. E. Lorensen, H. E. Cline, 1987, in
/// two dimensions) between the centres. A square with all four edges cut is decided by its mean value.
/// The negative side lies to the left of each curve. Curves reach the edge of the array (the outermost
/// values hold out to it), as an axis of symmetry needs; squares with a NaN corner have none.
/// @throws InternalError where the array is not nx * ny.
std::vector<Outline> zero_outlines(const PlaneArray& phi);

/// The same for values at nodes: value (i, j) at (x0 + i dx, y0 + j dy).
std::vector<Outline> zero_outlines_of_nodes(const PlaneArray& phi);

/// Length of a curve [m].
double length(const Outline& outline);

/// Area inside a closed curve [m^2], positive where it runs anticlockwise; 0 for an open one.
double signed_area(const Outline& outline);

}  // namespace recoil
