#include "interface/ghost_walls.hpp"

#include <algorithm>
#include <cmath>

#include "contact/touch.hpp"
#include "cutcell/geometry.hpp"
#include "interface/walls.hpp"

namespace recoil {

namespace {

constexpr double partner_gap = 1;     // surfaces farther apart [dx] do not meet in this step
constexpr double settled_gap = 0.05;  // below this [dx], what was in contact closes no gap first
constexpr double corner_gap = 0.7;    // surfaces nearer than this [dx] do not move into each other
constexpr double closing_gap = 0.3;   // gaps in contact below this [dx] are closed
constexpr double opposed = -0.7;      // n_m . n_k of surfaces that face each other
constexpr int partner_reach = 3;      // cells from a surface point to the wall of its partner

/// Level sets, contact bits and walls around one block.
template <int Dim>
struct View {
  State<Dim>& state;
  int slot;
  Window<Dim> window;
  std::vector<const double*> phi;  // by body; null where absent
  std::vector<const std::uint32_t*> contact;
  std::vector<const int*> wall;  // places in BodyBlock::walls

  double dx() const { return state.grid().dx; }
  const Body<Dim>& body(int m) const { return state.bodies[static_cast<std::size_t>(m)]; }
  double distance(int m, const Vec<Dim>& x) const {
    return interpolate(state.grid(), window.box(), phi[static_cast<std::size_t>(m)], x);
  }
  Vec<Dim> normal(int m, const Index<Dim>& i) const {
    return phi_normal(window.box(), phi[static_cast<std::size_t>(m)], i, dx());
  }
  /// Whether a body touched a partner in the last step in cell i or one around it.
  bool was_in_contact(int m, int partner, const Index<Dim>& i) const {
    const std::uint32_t* bits = contact[static_cast<std::size_t>(m)];
    if (!bits) return false;
    Box<Dim> box{i, i};
    for (int d = 0; d < Dim; ++d) --box.lo[d], box.hi[d] += 2;
    bool found = false;
    for_each(box, [&](const Index<Dim>& j) { found = found || (bits[window.at(j)] >> partner & 1U) != 0; });
    return found;
  }
};

template <int Dim>
View<Dim> look_around(State<Dim>& state, int slot, PhiAt when, Scratch& scratch) {
  View<Dim> v{state, slot, Window<Dim>(state.mesh, slot, partner_reach), {}, {}, {}};
  const auto n = static_cast<std::size_t>(v.window.size());
  const auto take = [&](const Body<Dim>& body, auto missing, Beyond beyond, auto&& of) {
    auto* out = scratch.take<decltype(missing)>(n);
    v.window.gather([&](int s) { return body.present(s) ? of(body.at(s)).data() : nullptr; }, missing, beyond,
                    out);
    return out;
  };
  for (const Body<Dim>& body : state.bodies) {
    v.phi.push_back(nullptr);
    v.contact.push_back(nullptr);
    v.wall.push_back(nullptr);
    if (!body.present(slot)) continue;
    v.phi.back() = take(
        body, far_cells * v.dx(), Beyond::extend, [&](const BodyBlock<Dim>& b) -> const auto& {
          return when == PhiAt::midstep ? b.phi_next : b.phi;
        });
    if (body.rigid) continue;
    v.contact.back() = take(
        body, std::uint32_t{0}, Beyond::extend,
        [](const BodyBlock<Dim>& b) -> const auto& { return b.contact; });
    v.wall.back() = take(
        body, -1, Beyond::mirror, [](const BodyBlock<Dim>& b) -> const auto& { return b.geometry.index; });
  }
  return v;
}

/// The fitted state of a body continued from its nearest wall to x. @returns false where no wall is near.
template <int Dim>
bool state_at(const View<Dim>& v, int m, const Vec<Dim>& x, Primitives<Dim>& value) {
  using C = Components<Dim>;
  const Body<Dim>& body = v.body(m);
  const Index<Dim> centre = v.state.grid().cell_of(x);
  Box<Dim> box;
  for (int d = 0; d < Dim; ++d) {
    box.lo[d] = std::max(centre[d] - partner_reach, v.window.box().lo[d]);
    box.hi[d] = std::min(centre[d] + partner_reach + 1, v.window.box().hi[d]);
  }
  double nearest = 1e300;
  const Wall<Dim>* found = nullptr;
  Vec<Dim> from_wall;
  unsigned flips = 0;
  for_each(box, [&](const Index<Dim>& j) {
    const int at = v.wall[static_cast<std::size_t>(m)][v.window.at(j)];
    if (at < 0) return;
    const auto source = v.window.source(j);
    const BodyBlock<Dim>& home = body.at(source.slot);
    const Wall<Dim>& wall = home.walls[static_cast<std::size_t>(at)];
    if (wall.donors == 0) return;
    const Vec<Dim> r = x - v.window.appear(j, source, home.geometry.cuts[static_cast<std::size_t>(at)].point);
    if (dot(r, r) >= nearest) return;
    nearest = dot(r, r);
    found = &wall;
    from_wall = r;
    flips = source.flips;
  });
  if (!found) return false;
  for (int d = 0; d < Dim; ++d)
    if ((flips >> d & 1U) != 0) from_wall[d] = -from_wall[d];
  value = found->value;
  for (std::size_t c = C::u; c < C::ep; ++c) value[c] += dot(found->gradient[c], from_wall) / v.dx();
  if (flips != 0)
    for (std::size_t c = 0; c < value.size(); ++c)
      value[c] *= component_sign<Dim>(static_cast<int>(c), flips);
  return true;
}

/// What stands opposite to a surface point.
template <int Dim>
struct Opposite {
  int body = -1;
  double gap = 0;           // [m]
  Vec<Dim> normal;          // out of that body
  Primitives<Dim> value{};  // of that body at the point; not of a rigid one
};

template <int Dim>
Opposite<Dim> find_opposite(const View<Dim>& v, int m, const Vec<Dim>& x, const Index<Dim>& i) {
  Opposite<Dim> o;
  for (int q = 0; q < v.state.count(); ++q) {
    if (q == m || !v.phi[static_cast<std::size_t>(q)]) continue;
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

/// Books what a wall in contact gives to its body, once for each pair.
template <int Dim>
void record(const View<Dim>& v, int m, const Opposite<Dim>& o, const CutCell<Dim>& cut, const Vec<Dim>& e,
            const Touch& t, double booked) {
  if (m > o.body && !v.body(o.body).rigid) return;
  const double area = dot(cut.surface, e);
  if (!(area > 0)) return;
  const int low = std::min(m, o.body), high = std::max(m, o.body);
  PairRecord<Dim>& r = v.state.ledger[static_cast<std::size_t>(v.slot)]
                           .pairs[static_cast<std::size_t>(pair_number(low, high, v.state.count()))];
  const double sign = m == low ? 1 : -1;
  const Vec<Dim> force = sign * t.traction * area * e;
  r.exchanged.momentum += booked * force;
  r.exchanged.energy += booked * sign * t.traction * area * t.work_velocity;
  r.area += area;
  r.force += force;
  r.traction += t.traction * area;
  r.velocity += t.work_velocity * area;
  r.gap += o.gap * area;
  r.place += cut.point * area;
  r.widest_gap = std::max(r.widest_gap, o.gap / v.dx());
  r.deepest_overlap = std::min(r.deepest_overlap, o.gap / v.dx());
}

/// Beside a partner that does not face it, a free surface does not move through the gap that is left.
template <int Dim>
void stop_at(const View<Dim>& v, const Opposite<Dim>& o, double dt, Vec<Dim>& velocity) {
  using C = Components<Dim>;
  Vec<Dim> other;
  for (int d = 0; d < Dim; ++d)
    other[d] = v.body(o.body).rigid ? v.body(o.body).rigid->velocity[d]
                                    : o.value[static_cast<std::size_t>(C::u + d)];
  const double least = dot(other, o.normal) - std::max(o.gap, 0.0) / dt, now = dot(velocity, o.normal);
  if (now < least) velocity += (least - now) * o.normal;
}

template <int Dim>
void set_wall(Wall<Dim>& w, const Vec<Dim>& normal, double traction, const Vec<Dim>& velocity) {
  w.normal = normal;
  w.traction = traction;
  w.velocity = w.face_velocity = velocity;
}

/// Contact of one surface point, if there is any. @returns whether.
template <int Dim>
bool try_touch(const View<Dim>& v, int m, const Opposite<Dim>& o, const Vec<Dim>& n, const CutCell<Dim>& cut,
               const Index<Dim>& i, double dt, double booked, Wall<Dim>& w) {
  const Body<Dim>& other = v.body(o.body);
  const Vec<Dim> e = other.rigid ? -o.normal : unit(n - o.normal);
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
  set_wall(w, n, t.traction, t.first_velocity * e + s.sliding - shear_recoil(s));
  w.partners = 1U << o.body;
  record(v, m, o, cut, e, t, booked);
  return true;
}

template <int Dim>
void find_wall(const View<Dim>& v, int m, const CutCell<Dim>& cut, double dt, double booked, Wall<Dim>& w) {
  w.partners = 0;
  const Index<Dim> i = v.state.mesh.block(v.slot).cells.lo + v.state.grid().layout().index(cut.cell);
  const Vec<Dim> n = v.normal(m, i);
  const Opposite<Dim> o = w.donors > 0 ? find_opposite(v, m, cut.point, i) : Opposite<Dim>{};
  const bool facing = o.body >= 0 && dot(n, o.normal) < opposed;
  if (facing && try_touch(v, m, o, n, cut, i, dt, booked, w)) return;
  const auto s = surface_state(v.body(m).material, w.value, n);
  Vec<Dim> velocity = free_velocity(s.velocity, s.stress, s.impedance) * n + s.sliding - shear_recoil(s);
  if (o.body >= 0 && !facing && o.gap < corner_gap * v.dx()) stop_at(v, o, dt, velocity);
  set_wall(w, n, 0, velocity);
}

}  // namespace

template <int Dim>
void find_ghost_walls(State<Dim>& state, int slot, double dt, double share, Scratch& scratch) {
  for (auto& p : state.ledger[static_cast<std::size_t>(slot)].pairs) {
    const Account<Dim> kept = p.exchanged;
    p = {};
    p.exchanged = kept;
  }
  const View<Dim> v = look_around(state, slot, PhiAt::midstep, scratch);
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
  const View<Dim> v = look_around(state, slot, PhiAt::now, scratch);
  for (int m = 0; m < state.count(); ++m) {
    Body<Dim>& body = state.bodies[static_cast<std::size_t>(m)];
    if (body.rigid || !body.present(slot)) continue;
    for (CutCell<Dim>& cut : body.at(slot).settled.cuts) {
      cut.mismatch = 0;
      const Index<Dim> i = state.mesh.block(slot).cells.lo + state.grid().layout().index(cut.cell);
      double least = closing_gap * v.dx();
      for (int q = 0; q < state.count(); ++q) {
        if (q == m || !v.phi[static_cast<std::size_t>(q)]) continue;
        if (!v.was_in_contact(m, q, i) && !v.was_in_contact(q, m, i)) continue;
        const double gap = v.distance(q, cut.point);
        if (gap >= least || gap < -v.dx() || dot(v.normal(m, i), v.normal(q, i)) > opposed) continue;
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
