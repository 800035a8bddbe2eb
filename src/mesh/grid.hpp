#pragma once

#include <array>
#include <cmath>

#include "core/index.hpp"
#include "core/vec.hpp"

namespace recoil {

/// What lies beyond an edge of the domain. `reflect` is a plane of symmetry, a rigid slip wall or the axis.
enum class Edge : unsigned char { outflow, reflect, periodic };

/// The Cartesian cells of one level of the domain and how they are cut into blocks. Symmetry about an axis or
/// a centre is data: areas and volumes are per radian or per steradian, weighted with r (axis 0) or its
/// square, and the metric functions below know it.
template <int Dim>
struct Grid {
  Vec<Dim> origin;                              // m, low corner of cell 0
  double dx = 0;                                // m
  Index<Dim> cells{};                           // of the domain
  Index<Dim> block{};                           // cells of a whole block; the last one may be cut short
  std::array<std::array<Edge, 2>, Dim> edge{};  // [axis][low, high]
  int radial_power = 0;  // of r in areas: 1 axisymmetric (2-D), 2 spherical (1-D), else 0

  /// Whether axis 0 is a radius, from an axis or a centre at 0.
  bool has_radius() const { return radial_power > 0; }

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
  /// Mean of |r|^radial_power over a cell of column i; axisymmetric at least dx / 2.
  double weight(int i) const {
    if (radial_power == 0) return 1;
    const double r = std::abs(origin[0] + (i + 0.5) * dx);
    if (radial_power == 2) return r * r + dx * dx / 12;
    return r > 0.5 * dx ? r : 0.5 * dx;
  }
  /// |r|^radial_power at the low face of column i.
  double face_weight(int i) const { return weight_at(origin[0] + i * dx); }
  /// |r|^radial_power.
  double weight_at(double r) const {
    if (radial_power == 0) return 1;
    return radial_power == 2 ? r * r : std::abs(r);
  }
  /// Integral of radial_power r^(radial_power - 1) over a cell: what hoop stresses act on, twice in a sphere.
  double hoop_area(int i) const {
    if (radial_power == 0) return 0;
    return radial_power == 2 ? 2 * std::abs(origin[0] + (i + 0.5) * dx) * dx : dx * dx;
  }
  /// Part that the velocity at the low face has in the mean over hoop_area, if the velocity is linear between
  /// faces.
  double low_face_part(int i) const {
    return radial_power == 2 ? 0.5 - dx / (12 * std::abs(origin[0] + (i + 0.5) * dx)) : 0.5;
  }
  /// Volume of a whole cell [m^Dim; m^3 per radian where axisymmetric, per steradian where spherical].
  double full_volume(const Index<Dim>& i) const { return weight(i[0]) * dx_power(Dim); }
  /// Area of the whole low face of cell i across axis d [m^(Dim-1); m^2 per radian or steradian].
  double full_area(const Index<Dim>& i, int d) const {
    return (d == 0 ? face_weight(i[0]) : weight(i[0])) * dx_power(Dim - 1);
  }
};

}  // namespace recoil
