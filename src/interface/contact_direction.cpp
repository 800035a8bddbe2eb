#include "interface/contact_direction.hpp"

#include <algorithm>

#include "interface/nearest_wall.hpp"

namespace recoil {

namespace {

constexpr double unlike_flat = 0.15;   // surfaces that face each other, by unlike()
constexpr double unlike_corner = 0.5;  // surfaces of which one has a corner
constexpr double least_around = 0.1;   // of dx^(Dim-1): a smaller facing area around tells no direction

/// By which part of their size two area vectors are not opposite.
template <int Dim>
double unlike(const Vec<Dim>& one, const Vec<Dim>& other) {
  return norm(one + other) / norm(one - other);
}

/// Difference of the area vectors of two bodies in the cells around cell i, of those that face each other.
template <int Dim>
Vec<Dim> facing_around(const SurfaceView<Dim>& view, const Body<Dim>& one, const Body<Dim>& other,
                       const Index<Dim>& i) {
  Box<Dim> around{i, i};
  for (int d = 0; d < Dim; ++d) --around.lo[d], around.hi[d] += 2;
  Vec<Dim> sum;
  for_each(around, [&](const Index<Dim>& j) {
    const auto from = view.window.source(j);
    if (j == i || from.slot < 0 || !one.present(from.slot) || !other.present(from.slot)) return;
    const Geometry<Dim>&g = one.at(from.slot).geometry, &h = other.at(from.slot).geometry;
    if (g.index[from.cell] < 0 || h.index[from.cell] < 0) return;
    const Vec<Dim>&s = g.cuts[g.index[from.cell]].surface, &t = h.cuts[h.index[from.cell]].surface;
    const double weight = 1 - unlike(s, t) / unlike_corner;
    if (weight > 0) sum += weight * flipped(s - t, from.flips);
  });
  return sum;
}

}  // namespace

template <int Dim>
Vec<Dim> direction_between(const SurfaceView<Dim>& view, const BodySurface<Dim>& first,
                           const BodySurface<Dim>& second, const Index<Dim>& i) {
  const Vec<Dim> own = first.area - second.area;
  const double corner =
      std::clamp((unlike(first.area, second.area) - unlike_flat) / (unlike_corner - unlike_flat), 0.0, 1.0);
  if (corner == 0) return unit(own);
  const Vec<Dim> around = facing_around(view, view.body(first.body), view.body(second.body), i);
  const double length = norm(around);
  if (!(length > least_around * view.state.grid().dx_power(Dim - 1))) return unit(own);
  return unit((1 - corner) * own + (corner * norm(own) / length) * around);
}

#define RECOIL_INSTANTIATE(Dim)                                                              \
  template Vec<Dim> direction_between<Dim>(const SurfaceView<Dim>&, const BodySurface<Dim>&, \
                                           const BodySurface<Dim>&, const Index<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
