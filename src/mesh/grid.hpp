#pragma once

#include <array>
#include <cmath>

#include "core/index.hpp"
#include "core/vec.hpp"

namespace recoil {

/// What lies beyond an edge of the domain. `reflect` is a plane of symmetry, a rigid slip wall or the axis.
enum class Edge : unsigned char { outflow, reflect, periodic };

/// The Cartesian cells of one level of the domain and how they are cut into blocks. Axisymmetry is data:
/// areas and volumes are per radian, weighted with r (axis 0), and the metric functions below know it.
template <int Dim>
struct Grid {
  Vec<Dim> origin;                              // m, low corner of cell 0
  double dx = 0;                                // m
  Index<Dim> cells{};                           // of the domain
  Index<Dim> block{};                           // cells of a whole block; the last one may be cut short
  std::array<std::array<Edge, 2>, Dim> edge{};  // [axis][low, high]
  bool axisymmetric = false;

  /// The cells of a level: 2^level times as wide. @pre the domain holds whole ones.
  Grid at_level(int level) const {
    Grid g = *this;
    g.dx *= 1 << level;
    for (int d = 0; d < Dim; ++d) g.cells[d] >>= level;
    return g;
  }

  Box<Dim> domain() const { return {{}, cells}; }
  /// The layout of every block's arrays, cut short or not.
  Box<Dim> layout() const { return {{}, block}; }

  /// The cells of the block at a place of the lattice; none beyond the domain.
  Box<Dim> cells_of(const Index<Dim>& at) const {
    Box<Dim> b;
    for (int d = 0; d < Dim; ++d) {
      b.lo[d] = at[d] * block[d];
      b.hi[d] = b.lo[d] + block[d] < cells[d] ? b.lo[d] + block[d] : cells[d];
    }
    return b;
  }

  Index<Dim> blocks() const {
    Index<Dim> n;
    for (int d = 0; d < Dim; ++d) n[d] = (cells[d] + block[d] - 1) / block[d];
    return n;
  }
  bool periodic(int d) const { return edge[d][0] == Edge::periodic; }

  Vec<Dim> centre(const Index<Dim>& i) const {
    Vec<Dim> x;
    for (int d = 0; d < Dim; ++d) x[d] = origin[d] + (i[d] + 0.5) * dx;
    return x;
  }
  /// The cell that holds x; may lie outside the domain.
  Index<Dim> cell_of(const Vec<Dim>& x) const {
    Index<Dim> i;
    for (int d = 0; d < Dim; ++d) i[d] = static_cast<int>(std::floor((x[d] - origin[d]) / dx));
    return i;
  }
  double dx_power(int n) const {
    double p = 1;
    for (int d = 0; d < n; ++d) p *= dx;
    return p;
  }
  /// |r| at the centre of a cell of column i (1 where not axisymmetric); at least dx / 2.
  double radius(int i) const {
    if (!axisymmetric) return 1;
    const double r = std::abs(origin[0] + (i + 0.5) * dx);
    return r > 0.5 * dx ? r : 0.5 * dx;
  }
  /// |r| at the low face of column i (1 where not axisymmetric).
  double face_radius(int i) const { return axisymmetric ? std::abs(origin[0] + i * dx) : 1; }
  /// Volume of a whole cell [m^Dim, axisymmetric m^3 per radian].
  double full_volume(const Index<Dim>& i) const { return radius(i[0]) * dx_power(Dim); }
  /// Area of the whole low face of cell i across axis d [m^(Dim-1), axisymmetric m^2 per radian].
  double full_area(const Index<Dim>& i, int d) const {
    return (d == 0 ? face_radius(i[0]) : radius(i[0])) * dx_power(Dim - 1);
  }
};

}  // namespace recoil
