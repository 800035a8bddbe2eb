#include "interface/ghost_walls.hpp"

#include <algorithm>
#include <cmath>

#include "interface/each_ghost_wall.hpp"

namespace recoil {

namespace {

constexpr double kept_contact_gap = 0.05;  // below this [dx], what was in contact closes no gap first
constexpr double corner_gap = 0.7;         // surfaces nearer than this [dx] do not move into each other
constexpr double closing_gap = 0.3;        // gaps in contact below this [dx] are closed

/// Beside a partner that does not face it, a free surface does not move through the gap that is left.
template <int Dim>
void stop_at(const SurfaceView<Dim>& v, const Opposite<Dim>& o, const Vec<Dim>& x, double dt,
             Vec<Dim>& velocity) {
  const double least = dot(velocity_of(v, o, x), o.normal) - std::max(o.gap, 0.0) / dt,
               now = dot(velocity, o.normal);
  if (now < least) velocity += (least - now) * o.normal;
}

/// Contact of one surface point, if there is any. @returns whether.
template <int Dim>
bool try_touch(const SurfaceView<Dim>& v, int m, const Opposite<Dim>& o, const CutCell<Dim>& cut,
               const Index<Dim>& i, double dt, Wall<Dim>& w) {
  const GhostContact<Dim> c(v, m, o, cut, i, w);
  const double gap_speed = c.was && o.gap < kept_contact_gap * v.dx() ? 0 : std::max(o.gap, 0.0) / dt;
  const Touch t =
      c.rigid ? touch_rigid(c.mine, c.theirs.velocity, gap_speed) : touch(c.mine, c.theirs, gap_speed);
  if (t.touching) c.apply(v, m, o, cut, t, w);
  return t.touching;
}

}  // namespace

template <int Dim>
void find_ghost_walls(State<Dim>& state, int slot, double dt, double weight, Scratch& scratch) {
  for_each_ghost_wall(state, slot, dt, weight, scratch,
                      [&](const SurfaceView<Dim>& v, int m, const Opposite<Dim>& o, const CutCell<Dim>& cut,
                          const Index<Dim>& i, Wall<Dim>& w) {
                        const bool faces = o.faces(w.normal);
                        if (faces && try_touch(v, m, o, cut, i, dt, w)) return;
                        release(v.body(m).material, w);
                        if (o.body < 0 || faces || o.gap >= corner_gap * v.dx()) return;
                        stop_at(v, o, cut.point, dt, w.velocity);
                        w.face_velocity = w.velocity;
                      });
}

template <int Dim>
void measure_gaps(State<Dim>& state, int slot, Scratch& scratch) {
  const SurfaceView<Dim> v = view_surfaces(state, slot, {1, PhiAt::now, true, false}, scratch);
  for (int m = 0; m < state.count(); ++m) {
    Body<Dim>& body = state.bodies[m];
    if (body.rigid || !body.present(slot)) continue;
    for (CutCell<Dim>& cut : body.at(slot).end_geometry.cuts) {
      cut.mismatch = 0;
      const Index<Dim> i = state.mesh.block(slot).cells.lo + state.grid().layout().index(cut.cell);
      double least = closing_gap * v.dx();
      for (int q = 0; q < state.count(); ++q) {
        if (q == m || !v.phi[q]) continue;
        const double gap = v.distance(q, cut.point);
        if (gap >= least || gap < -v.dx() || (gap > 0 && !v.touched(m, q, i) && !v.touched(q, m, i)))
          continue;
        least = gap;
        cut.mismatch = v.body(q).rigid ? gap : 0.5 * gap;
      }
    }
  }
}

#define RECOIL_INSTANTIATE(Dim)                                                    \
  template void find_ghost_walls<Dim>(State<Dim>&, int, double, double, Scratch&); \
  template void measure_gaps<Dim>(State<Dim>&, int, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
