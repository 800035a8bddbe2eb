#include "interface/nearest_wall.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace recoil {

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
  for_each(box, [&](const Index<Dim>& j) {
    const int at = index[w.at(j)];
    if (at < 0) return;
    const auto from = w.source(j);
    const BodyBlock<Dim>& home = body.at(from.slot);
    if (home.walls[at].donors == 0) return;
    const Vec<Dim> r = x - w.appear(j, from, home.geometry.cuts[at].point);
    const double r2 = dot(r, r);
    if (r2 >= nearest) return;
    nearest = r2;
    found = {from.slot, at, from.flips, flipped(r, from.flips)};
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
