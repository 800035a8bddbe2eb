#include "interface/nearest_wall.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace recoil {

namespace {

/// How far a point is beyond cell j along an axis [m], if the cell is widened by a hundredth: its wall lies
/// in it.
template <int Dim>
double beyond_cell(const Grid<Dim>& grid, int j, const Vec<Dim>& x, int d) {
  const double r = x[d] - (grid.origin[d] + (j + 0.5) * grid.dx);
  return std::max(std::abs(r) - 0.51 * grid.dx, 0.0);
}

}  // namespace

template <int Dim>
NearWall<Dim> nearest_wall(const State<Dim>& state, const Body<Dim>& body, const Window<Dim>& w,
                           const int* index, const Vec<Dim>& x, int reach) {
  const Index<Dim> centre = state.grid().cell_of(x);
  Box<Dim> box;
  for (int d = 0; d < Dim; ++d) {
    box.lo[d] = std::max(centre[d] - reach, w.box().lo[d]);
    box.hi[d] = std::min(centre[d] + reach + 1, w.box().hi[d]);
  }
  double nearest = std::numeric_limits<double>::infinity();
  NearWall<Dim> found;
  const auto look_at = [&](const Index<Dim>& j, int at) {
    const auto from = w.source(j);
    const BodyBlock<Dim>& home = body.at(from.slot);
    if (home.walls[at].donors == 0) return;
    const Vec<Dim> r = x - w.appear(j, from, home.geometry.cuts[at].point);
    const double r2 = dot(r, r);
    if (r2 >= nearest) return;
    nearest = r2;
    found = {from.slot, at, from.flips, flipped(r, from.flips)};
  };
  // The middle cell is looked at first: most others are farther than its wall, and are left out. It is looked
  // at again in its turn, because of equally near walls the first in the box counts.
  if (box.contains(centre) && index[w.at(centre)] >= 0) look_at(centre, index[w.at(centre)]);
  nearest = std::nextafter(nearest, std::numeric_limits<double>::infinity());
  const Grid<Dim>& grid = state.grid();
  const int width = box.extent(0);
  Box<Dim> rows = box;
  rows.hi[0] = std::min(rows.hi[0], rows.lo[0] + 1);
  for_each(rows, [&](Index<Dim> j) {
    double row2 = 0;
    for (int d = 1; d < Dim; ++d) row2 += beyond_cell(grid, j[d], x, d) * beyond_cell(grid, j[d], x, d);
    if (row2 > nearest) return;
    const int* places = index + w.at(j);
    for (int c = 0; c < width; ++c, ++j[0]) {
      if (places[c] < 0) continue;
      const double along = beyond_cell(grid, j[0], x, 0);
      if (row2 + along * along <= nearest) look_at(j, places[c]);
    }
  });
  return found;
}

template <int Dim>
Primitives<Dim> continued_value(const Wall<Dim>& wall, const Vec<Dim>& from_wall, unsigned flips, double dx) {
  using C = Components<Dim>;
  Primitives<Dim> v = wall.value;
  for (std::size_t c = C::u; c < C::ep; ++c) v[c] += dot(wall.gradient[c], from_wall) / dx;
  if (flips != 0)
    for (std::size_t c = 0; c < v.size(); ++c) v[c] *= component_sign<Dim>(static_cast<int>(c), flips);
  return v;
}

#define RECOIL_INSTANTIATE(Dim)                                                                     \
  template NearWall<Dim> nearest_wall<Dim>(const State<Dim>&, const Body<Dim>&, const Window<Dim>&, \
                                           const int*, const Vec<Dim>&, int);                       \
  template Primitives<Dim> continued_value<Dim>(const Wall<Dim>&, const Vec<Dim>&, unsigned, double);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
