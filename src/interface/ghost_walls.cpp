#include "interface/ghost_walls.hpp"

#include <algorithm>
#include <cmath>

#include "contact/touch.hpp"
#include "interface/opposite.hpp"
#include "interface/walls.hpp"

namespace recoil {

namespace {

constexpr double settled_gap = 0.05;  // below this [dx], what was in contact closes no gap first
constexpr double corner_gap = 0.7;    // surfaces nearer than this [dx] do not move into each other
constexpr double closing_gap = 0.3;   // gaps in contact below this [dx] are closed

/// Beside a partner that does not face it, a free surface does not move through the gap that is left.
template <int Dim>
void stop_at(const SurfaceView<Dim>& v, const Opposite<Dim>& o, double dt, Vec<Dim>& velocity) {
  using C = Components<Dim>;
  Vec<Dim> other;
  for (int d = 0; d < Dim; ++d)
    other[d] = v.body(o.body).rigid ? v.body(o.body).rigid->velocity[d]
                                    : o.value[static_cast<std::size_t>(C::u + d)];
  const double least = dot(other, o.normal) - std::max(o.gap, 0.0) / dt, now = dot(velocity, o.normal);
  if (now < least) velocity += (least - now) * o.normal;
}

/// Contact of one surface point, if there is any. @returns whether.
template <int Dim>
bool try_touch(const SurfaceView<Dim>& v, int m, const Opposite<Dim>& o, const CutCell<Dim>& cut,
               const Index<Dim>& i, double dt, double booked, Wall<Dim>& w) {
  const Body<Dim>& other = v.body(o.body);
  const Vec<Dim> e = contact_normal(v, o, w.normal);
  const bool was = v.was_in_contact(m, o.body, i) || v.was_in_contact(o.body, m, i);
  const double gap_speed = was && o.gap < settled_gap * v.dx() ? 0 : std::max(o.gap, 0.0) / dt;
  const auto s = surface_state(v.body(m).material, w.value, e);
  const ContactSide mine{s.velocity, s.stress, s.impedance};
  Touch t;
  if (other.rigid) {
    t = touch_rigid(mine, dot(other.rigid->velocity, e), gap_speed);
  } else {
    const auto r = surface_state(other.material, o.value, e);
    t = touch(mine, {r.velocity, r.stress, r.impedance}, gap_speed);
  }
  if (!t.touching) return false;
  w.traction = t.traction;
  w.velocity = w.face_velocity = t.first_velocity * e + s.sliding - shear_recoil(s);
  w.partners = 1U << o.body;
  record_contact(v, m, o, cut, e, t.traction, t.work_velocity, booked);
  return true;
}

template <int Dim>
void find_wall(const SurfaceView<Dim>& v, int m, const CutCell<Dim>& cut, double dt, double booked,
               Wall<Dim>& w) {
  const Index<Dim> i = v.state.mesh.block(v.slot).cells.lo + v.state.grid().layout().index(cut.cell);
  w.normal = v.normal(m, i);
  w.partners = 0;
  w.traction = 0;
  const Opposite<Dim> o = w.donors > 0 ? find_opposite(v, m, cut.point, i) : Opposite<Dim>{};
  const bool faces = o.faces(w.normal);
  if (faces && try_touch(v, m, o, cut, i, dt, booked, w)) return;
  const auto s = surface_state(v.body(m).material, w.value, w.normal);
  w.velocity = free_velocity(s.velocity, s.stress, s.impedance) * w.normal + s.sliding - shear_recoil(s);
  if (o.body >= 0 && !faces && o.gap < corner_gap * v.dx()) stop_at(v, o, dt, w.velocity);
  w.face_velocity = w.velocity;
}

}  // namespace

template <int Dim>
void find_ghost_walls(State<Dim>& state, int slot, double dt, double share, Scratch& scratch) {
  if (share > 0) clear_records(state, slot);
  const SurfaceView<Dim> v = view_surfaces(state, slot, PhiAt::midstep, scratch);
  for (int m = 0; m < state.count(); ++m) {
    Body<Dim>& body = state.bodies[static_cast<std::size_t>(m)];
    if (body.rigid || !body.present(slot)) continue;
    BodyBlock<Dim>& b = body.at(slot);
    for (std::size_t k = 0; k < b.walls.size(); ++k) {
      find_wall(v, m, b.geometry.cuts[k], dt, share * dt, b.walls[k]);
      b.walls[k].mean_velocity += share * b.walls[k].velocity;
    }
  }
}

template <int Dim>
void measure_gaps(State<Dim>& state, int slot, Scratch& scratch) {
  const SurfaceView<Dim> v = view_surfaces(state, slot, PhiAt::now, scratch);
  for (int m = 0; m < state.count(); ++m) {
    Body<Dim>& body = state.bodies[static_cast<std::size_t>(m)];
    if (body.rigid || !body.present(slot)) continue;
    for (CutCell<Dim>& cut : body.at(slot).settled.cuts) {
      cut.mismatch = 0;
      const Index<Dim> i = state.mesh.block(slot).cells.lo + state.grid().layout().index(cut.cell);
      double least = closing_gap * v.dx();
      for (int q = 0; q < state.count(); ++q) {
        if (q == m || !v.phi[static_cast<std::size_t>(q)]) continue;
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
