#include "interface/opposite.hpp"

#include "interface/nearest_wall.hpp"

namespace recoil {

namespace {

constexpr double partner_gap = 1;  // surfaces farther apart [dx] do not meet in this step

/// The fitted state of a body continued from its nearest wall to x. @returns false where no wall is near.
template <int Dim>
bool state_at(const SurfaceView<Dim>& v, int m, const Vec<Dim>& x, Primitives<Dim>& value) {
  const NearWall<Dim> near = nearest_wall(v.state, v.body(m), v.window, v.wall[m], x, opposite_sight.halo);
  if (near.slot < 0) return false;
  value = continued_value(v.body(m).at(near.slot).walls[near.wall], near.from_wall, near.flips, v.dx());
  return true;
}

}  // namespace

template <int Dim>
Opposite<Dim> find_opposite(const SurfaceView<Dim>& v, int m, const Vec<Dim>& x, const Index<Dim>& i) {
  Opposite<Dim> o;
  for (int q = 0; q < v.state.count(); ++q) {
    if (q == m || !v.phi[q]) continue;
    const double gap = v.distance(q, x);
    if (o.body >= 0 ? gap < o.gap : gap < partner_gap * v.dx()) {
      o.body = q;
      o.gap = gap;
    }
  }
  if (o.body < 0) return o;
  o.normal = v.normal(o.body, i);
  if (!v.body(o.body).rigid && !state_at(v, o.body, x, o.value)) o.body = -1;
  return o;
}

template <int Dim>
Vec<Dim> velocity_of(const SurfaceView<Dim>& v, const Opposite<Dim>& o, const Vec<Dim>& x) {
  const Body<Dim>& body = v.body(o.body);
  if (body.rigid) return velocity_at(*body.rigid, x);
  Vec<Dim> u;
  for (int d = 0; d < Dim; ++d) u[d] = o.value[Components<Dim>::u + d];
  return u;
}

#define RECOIL_INSTANTIATE(Dim)                                                            \
  template Opposite<Dim> find_opposite<Dim>(const SurfaceView<Dim>&, int, const Vec<Dim>&, \
                                            const Index<Dim>&);                            \
  template Vec<Dim> velocity_of<Dim>(const SurfaceView<Dim>&, const Opposite<Dim>&, const Vec<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
