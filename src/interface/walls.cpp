#include "interface/walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "contact/friction.hpp"
#include "contact/touch.hpp"
#include "interface/contact_direction.hpp"
#include "interface/surface_state.hpp"
#include "interface/surface_view.hpp"
#include "material/eos/isentrope.hpp"
#include "state/contact_sums.hpp"

namespace recoil {

namespace {

constexpr double touching_gap = 0.5;      // surfaces farther apart [dx] do not meet in this step
constexpr double kept_contact_gap = 0.1;  // nearer ones [dx] that were in contact stay so, and close no gap
constexpr double most_fill = 1.05;        // of a cell: matter beyond it pushes surfaces apart that press ...
constexpr double strong_contact = 0.05;   // ... with so much of rho c_L^2 at least ...
constexpr double push_rate = 0.2;         // ... so fast that this part of it would be gone after a step
constexpr double welded_gap = 0.01;       // glued bodies that are this near [dx] hold each other
constexpr double small_face = 0.1;        // of dx^(Dim-1): a smaller surface takes its normal from elsewhere
constexpr double no_direction = 1e-14;    // of dx^(Dim-1): areas that differ by less do not face each other
constexpr double least_shared = 1e-12;    // of a face: a smaller common area is no contact
constexpr double nothing_left = 1e-6;     // of a face: a smaller rest of a surface moves with what touches it
constexpr double rigid_slack = 1.0000001;  // of a rigid surface's area: what can be shared despite rounding

constexpr std::size_t most_pairs = most_bodies * (most_bodies - 1) / 2;

/// What the walls look at: the cells next to the block, rigid bodies exactly.
constexpr Sight wall_sight{1, PhiAt::now, false, false};

/// One body's fragment of the cell at hand.
template <int Dim>
struct Side {
  int body = 0;
  bool rigid = false;
  const CutCell<Dim>* cut = nullptr;
  Wall<Dim>* wall = nullptr;  // null for rigid bodies
  Vec<Dim> rest;              // part of the surface that nothing has touched yet
  double touched = 0;         // area in contact
  Vec<Dim> touched_velocity;  // of that area
};

/// The fragments of all bodies in one cell.
template <int Dim>
struct Cluster {
  std::array<Side<Dim>, most_bodies> side;
  std::size_t count = 0;
  Index<Dim> cell;  // global
  double face = 0;  // dx^(Dim-1), weighted as volumes are
  double fill = 0;  // of the cell, by all bodies that can be deformed

  void add(const Side<Dim>& s) { side[count++] = s; }
};

/// A block in one stage.
template <int Dim>
struct BlockStage {
  SurfaceView<Dim> view;
  double dt, booked, area;  // s; s of them that this stage stands for; dx^(Dim-1)

  State<Dim>& state() const { return view.state; }
};

/// What a part of the wall with this area vector, velocity and traction force does to a fragment.
template <int Dim>
void act(Side<Dim>& s, const Vec<Dim>& force, double power, const Vec<Dim>& velocity, const Vec<Dim>& area) {
  Wall<Dim>& w = *s.wall;
  w.force += force;
  w.power += power;
  w.volume_rate += dot(velocity, area);
  for (int i = 0; i < Dim; ++i) w.stretching[i] += velocity[i] * area;
}

/// Direction from the first body into the second, and the area that their surfaces share.
template <int Dim>
double shared_area(const BlockStage<Dim>& a, const Side<Dim>& first, const Side<Dim>& second,
                   const Index<Dim>& i, Vec<Dim>& e) {
  if (second.rigid) {
    const Grid<Dim>& grid = a.state().grid();
    e = -rigid_normal(grid, *a.view.body(second.body).rigid, a.view.pose[second.body], first.cut->point);
    const double own = dot(first.rest, e);
    return grid.has_radius() ? own : std::min(own, norm(second.cut->surface) * rigid_slack);
  }
  if (norm(first.rest - second.rest) < no_direction * a.area) return 0;
  e = direction_between(a.view, {first.body, first.rest}, {second.body, second.rest}, i);
  return std::min(dot(first.rest, e), -dot(second.rest, e));
}

/// Where two surfaces of a cell meet, in whatever order they are named: half way between their surface
/// points; of a rigid one that of its partner counts.
template <int Dim>
Vec<Dim> meeting_point(const Side<Dim>& one, const Side<Dim>& other) {
  const Vec<Dim>&a = (one.rigid ? other : one).cut->point, &b = (other.rigid ? one : other).cut->point;
  return 0.5 * (a + b);
}

/// Adds a contact to the list of the block.
template <int Dim>
void note(const BlockStage<Dim>& a, const Side<Dim>& first, const Side<Dim>& second, const Touch& t,
          const ShearContact<Dim>& g, const Vec<Dim>& e, double area, double gap) {
  a.state().contacts[a.view.slot].push_back({.cell = first.cut->cell,
                                             .first = first.body,
                                             .second = second.body,
                                             .one_sided = false,
                                             .direction = e,
                                             .point = meeting_point(first, second),
                                             .area = area,
                                             .traction = t.traction,
                                             .shear = g.traction,
                                             .work_velocity = t.work_velocity,
                                             .shear_velocity = g.work_velocity,
                                             .slip = g.first_velocity - g.second_velocity,
                                             .gap = gap});
}

template <int Dim>
void touch_part(Side<Dim>& s, int partner, const Vec<Dim>& e, double sign, const Vec<Dim>& velocity,
                const Touch& t, const ShearContact<Dim>& g, double area) {
  act(s, (sign * area) * (t.traction * e + g.traction),
      sign * area * (t.traction * t.work_velocity + dot(g.traction, g.work_velocity)), velocity,
      sign * area * e);
  s.rest -= sign * area * e;
  s.touched_velocity = (s.touched_velocity * s.touched + velocity * area) * (1 / (s.touched + area));
  s.touched += area;
  Wall<Dim>& w = *s.wall;
  w.partners |= 1U << partner;
  w.traction = t.traction;
  w.shear = sign * g.traction;
  w.face_velocity = velocity;
  w.normal = sign * e;
}

/// The largest shear traction that a contact carries.
double shear_limit(const ContactLaw& law, const Touch& t) {
  if (law.mode == ContactLaw::Mode::bonded) return std::numeric_limits<double>::infinity();
  return law.coefficient * std::abs(t.traction);
}

/// Without friction nothing is held, and each surface slides as it likes.
template <int Dim>
ShearSide<Dim> shear_side(const SurfaceState<Dim>& s) {
  return {s.sliding, s.shear, s.shear_impedance};
}

/// Speed with which surfaces are to part where their cell holds more than there is room for and they press
/// each other strongly [m/s]; no faster than they would close. A push is a stress itself: at weak contacts it
/// would keep closed what opens.
/// @param modulus rho c_L^2 of the softer side [Pa].
template <int Dim>
double push_apart(const BlockStage<Dim>& a, const Cluster<Dim>& c, const ContactSide& one,
                  const ContactSide& other, double modulus) {
  if (!(c.fill > most_fill)) return 0;
  if (!(-touch(one, other, 0).traction > strong_contact * modulus)) return 0;
  const double closing = free_velocity(one.velocity, one.stress, one.impedance) -
                         free_velocity(other.velocity, -other.stress, other.impedance);
  ++a.state().ledger[a.view.slot].counters.pushed_contacts;
  return std::min(push_rate * (c.fill - most_fill) * a.view.dx() / a.dt, closing);
}

template <int Dim>
void try_pair(const BlockStage<Dim>& a, Side<Dim>& first, Side<Dim>& second, double gap,
              const Cluster<Dim>& c) {
  Vec<Dim> e;
  const double area = shared_area(a, first, second, c.cell, e);
  if (area <= least_shared * c.face) return;
  const Body<Dim>&one = a.view.body(first.body), &other = a.view.body(second.body);
  const bool was = a.view.was_in_contact(first.body, second.body, c.cell);
  const ContactLaw& law = a.state().contact[pair_number(
      std::min(first.body, second.body), std::max(first.body, second.body), a.state().count())];
  const double dx = a.view.dx();
  const bool glued = law.mode == ContactLaw::Mode::bonded && (was || std::abs(gap) < welded_gap * dx);
  const double gap_speed = glued || (was && gap < kept_contact_gap * dx) ? 0 : std::max(gap, 0.0) / a.dt;
  const auto s = surface_state(one.material, first.wall->value, e);
  const ContactSide mine{s.velocity, s.stress, s.impedance};
  if (second.rigid) {
    const Vec<Dim> wall = velocity_at(*other.rigid, first.cut->point);
    const double along = dot(wall, e);
    const Touch t = touch_rigid(mine, along, gap_speed, glued);
    if (!t.touching) return;
    const ShearContact<Dim> g = shear_contact_rigid(shear_side(s), wall - along * e, shear_limit(law, t));
    touch_part(first, second.body, e, 1, t.first_velocity * e + g.first_velocity, t, g, area);
    note(a, first, second, t, g, e, area, gap);
    return;
  }
  const auto r = surface_state(other.material, second.wall->value, e);
  const ContactSide theirs{r.velocity, r.stress, r.impedance};
  const double softer = std::min(s.impedance * s.impedance / first.wall->value[0],
                                 r.impedance * r.impedance / second.wall->value[0]);
  const double push = glued ? 0 : push_apart(a, c, mine, theirs, softer);
  const Touch t = touch(mine, theirs, push > 0 ? -push : gap_speed, glued);
  if (!t.touching) return;
  const ShearContact<Dim> g = shear_contact(shear_side(s), shear_side(r), shear_limit(law, t));
  touch_part(first, second.body, e, 1, t.first_velocity * e + g.first_velocity, t, g, area);
  touch_part(second, first.body, e, -1, t.second_velocity * e + g.second_velocity, t, g, area);
  note(a, first, second, t, g, e, area, gap);
}

/// All pairs that meet in a cell, smallest gap first: each takes what the ones before have left of the
/// surfaces.
template <int Dim>
void touch_all(const BlockStage<Dim>& a, Cluster<Dim>& c) {
  struct Pair {
    double gap;
    std::size_t first, second;
  };
  std::array<Pair, most_pairs> pairs;  // room for all that there can be; the first n are set
  std::size_t n = 0;
  for (std::size_t m = 0; m < c.count; ++m)
    for (std::size_t q = m + 1; q < c.count; ++q) {
      const Side<Dim>&one = c.side[m], &other = c.side[q];
      if (one.rigid && other.rigid) continue;
      const bool swap = one.rigid;
      const Vec<Dim> x = meeting_point(one, other);
      const double gap = a.view.distance(one.body, x) + a.view.distance(other.body, x);
      if (!(gap <= touching_gap * a.view.dx())) continue;
      std::size_t at = n++;  // after those with the same gap
      for (; at > 0 && gap < pairs[at - 1].gap; --at) pairs[at] = pairs[at - 1];
      pairs[at] = {gap, swap ? q : m, swap ? m : q};
    }
  for (std::size_t k = 0; k < n; ++k)
    try_pair(a, c.side[pairs[k].first], c.side[pairs[k].second], pairs[k].gap, c);
}

/// Velocity along its normal of a surface that a pressure from outside acts on: u - (sigma + pressure)/Z;
/// that of a gas by the isentrope to this pressure.
template <int Dim>
double free_normal_velocity(const Material& material, const Primitives<Dim>& value,
                            const SurfaceState<Dim>& s, double pressure) {
  using C = Components<Dim>;
  if (const auto gas = gas_isentrope(material.eos, value[C::rho], value[C::p], pressure))
    return s.velocity + gas->speed;
  return free_velocity(s.velocity, s.stress + pressure, s.impedance);
}

/// The pressure of the loads on what is free of a surface, a mean over the step [Pa].
template <int Dim>
double load_on(const BlockStage<Dim>& a, const Side<Dim>& s, const Vec<Dim>& n) {
  const State<Dim>& state = a.state();
  if (state.loads.empty()) return 0;
  return pressure_of(state.loads, s.body, s.cut->point, n, state.time, state.time + a.dt);
}

/// Adds what a load has done to a body to the record of the block.
template <int Dim>
void book_load(const BlockStage<Dim>& a, const Side<Dim>& s, const Vec<Dim>& force, double power) {
  if (a.state().loads.empty()) return;
  LoadRecord<Dim>& record = a.state().ledger[a.view.slot].loads[s.body];
  record.received.momentum += a.booked * force;
  record.received.energy += a.booked * power;
  record.moment += a.booked * cross(s.cut->point, force);
}

/// What no partner has touched is free: no traction but that of loads, velocity as free_normal_velocity() -
/// tau/Z_s.
template <int Dim>
void free_part(const BlockStage<Dim>& a, Side<Dim>& s, const Cluster<Dim>& c) {
  Wall<Dim>& w = *s.wall;
  const double whole = norm(s.cut->surface), rest = norm(s.rest);
  const bool contact = w.partners != 0, small = rest <= small_face * c.face;
  if (contact && rest < nothing_left * c.face) {
    w.volume_rate += dot(s.touched_velocity, s.rest);
    w.velocity = s.touched_velocity;
    return;
  }
  const Vec<Dim> n = small ? a.view.normal(s.body, c.cell) : s.rest * (1 / rest);
  const double pressure = load_on(a, s, n);
  Vec<Dim> velocity = w.face_velocity;
  if (!(contact && small)) {
    const Material& material = a.view.body(s.body).material;
    const auto state = surface_state(material, w.value, n);
    velocity = free_normal_velocity<Dim>(material, w.value, state, pressure) * n + state.sliding -
               shear_recoil(state);
    if (!contact) {
      w.normal = n;
      w.face_velocity = velocity;
      if (pressure != 0) w.traction = -pressure;
    }
  }
  const Vec<Dim> force = -pressure * s.rest;
  const double power = dot(force, velocity);
  act(s, force, power, velocity, s.rest);
  book_load(a, s, force, power);
  const double touched = std::max(whole - rest, 0.0);
  w.velocity = contact ? (s.touched_velocity * touched + velocity * rest) * (1 / (touched + rest)) : velocity;
}

template <int Dim>
void reset(Wall<Dim>& w) {
  w.traction = 0;
  w.shear = {};
  w.partners = 0;
  w.volume_rate = 0;
  w.force = {};
  w.power = 0;
  w.stretching = {};
}

/// Empties the walls of a block. @returns whether there are any.
template <int Dim>
bool reset_walls(State<Dim>& state, int slot) {
  bool any = false;
  for (Body<Dim>& body : state.bodies) {
    if (body.rigid || !body.present(slot)) continue;
    for (Wall<Dim>& w : body.at(slot).walls) reset(w);
    any = any || !body.at(slot).walls.empty();
  }
  return any;
}

/// Gathers the fragments in the cell of a cut cell of body m. @returns false where a lower-numbered
/// deformable body has done it already.
template <int Dim>
bool gather_sides(State<Dim>& state, int slot, int m, int cell, Cluster<Dim>& c) {
  c.count = 0;
  c.fill = 0;
  for (int q = 0; q < state.count(); ++q) {
    Body<Dim>& body = state.bodies[q];
    if (!body.present(slot)) continue;
    BodyBlock<Dim>& b = body.at(slot);
    const int at = b.geometry.index[cell];
    if (!body.rigid) c.fill += b.volume[cell];
    if (at < 0) continue;
    if (!body.rigid && q < m) return false;
    const CutCell<Dim>& cut = b.geometry.cuts[at];
    c.add({q, body.rigid.has_value(), &cut, body.rigid ? nullptr : &b.walls[at], cut.surface, 0, {}});
  }
  return true;
}

template <int Dim>
void find_all(const BlockStage<Dim>& a) {
  State<Dim>& state = a.state();
  const int slot = a.view.slot;
  Cluster<Dim> c;
  for (int m = 0; m < state.count(); ++m) {
    const Body<Dim>& body = state.bodies[m];
    if (body.rigid || !body.present(slot)) continue;
    for (const CutCell<Dim>& cut : body.at(slot).geometry.cuts) {
      if (!gather_sides(state, slot, m, cut.cell, c)) continue;
      c.cell = a.view.window.index_of(cut.cell);
      c.face = a.area * state.grid().weight(c.cell[0]);
      c.fill /= state.grid().full_volume(c.cell);
      if (c.count > 1) touch_all(a, c);
      for (std::size_t k = 0; k < c.count; ++k)
        if (!c.side[k].rigid) free_part(a, c.side[k], c);
    }
  }
}

}  // namespace

template <int Dim>
void find_walls(State<Dim>& state, int slot, double dt, double weight, Scratch& scratch) {
  state.contacts[slot].clear();
  if (reset_walls(state, slot))
    find_all<Dim>(
        {view_surfaces(state, slot, wall_sight, scratch), dt, weight * dt, state.grid().dx_power(Dim - 1)});
  book_contacts(state, slot, weight * dt);
  for (Body<Dim>& body : state.bodies)
    if (!body.rigid && body.present(slot))
      for (Wall<Dim>& w : body.at(slot).walls) w.mean_velocity += weight * w.velocity;
}

template <int Dim>
void remember_contact(BodyBlock<Dim>& b) {
  std::fill(b.contact.begin(), b.contact.end(), 0U);
  for (std::size_t m = 0; m < b.walls.size(); ++m) b.contact[b.geometry.cuts[m].cell] = b.walls[m].partners;
}

#define RECOIL_INSTANTIATE(Dim)                                              \
  template void find_walls<Dim>(State<Dim>&, int, double, double, Scratch&); \
  template void remember_contact<Dim>(BodyBlock<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
