#include "interface/walls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/friction.hpp"
#include "contact/touch.hpp"
#include "cutcell/geometry.hpp"
#include "dynamics/primitives.hpp"

namespace recoil {

namespace {

constexpr double touching_gap = 0.5;  // surfaces farther apart [dx] do not meet in this step
constexpr double kept_contact_gap =
    0.1;  // below this [dx], what was in contact stays so without closing a gap first
constexpr double welded_gap = 0.01;  // glued bodies that are this near [dx] hold each other
constexpr double small_face =
    0.1;  // of dx^(Dim-1): a smaller part of a surface takes its normal from elsewhere

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

template <int Dim>
struct Around {
  State<Dim>& state;
  int slot;
  Window<Dim> window;
  double dt, booked, area;         // dx^(Dim-1)
  std::vector<const double*> phi;  // by body, in the window; null where absent
  std::vector<const std::uint32_t*> contact;
  std::vector<RigidPose<Dim>> pose;  // by body, of rigid ones

  /// phi of a body at x: exact of a rigid one, whose other side may be near.
  double distance(int m, const Vec<Dim>& x) const {
    const auto k = static_cast<std::size_t>(m);
    const Body<Dim>& body = state.bodies[k];
    return body.rigid ? distance_at(*body.rigid, pose[k], x)
                      : interpolate(state.grid(), window.box(), phi[k], x);
  }
  double dx() const { return state.grid().dx; }
};

template <int Dim>
Around<Dim> look_around(State<Dim>& state, int slot, double dt, double weight, Scratch& scratch) {
  Around<Dim> a{state, slot,        Window<Dim>(state.mesh, slot, 1),
                dt,    weight * dt, state.grid().dx_power(Dim - 1),
                {},    {},          {}};
  const auto n = static_cast<std::size_t>(a.window.size());
  for (const Body<Dim>& body : state.bodies) {
    a.phi.push_back(nullptr);
    a.contact.push_back(nullptr);
    a.pose.push_back(body.rigid ? pose_after(*body.rigid, 0) : RigidPose<Dim>{});
    if (!body.present(slot) || body.rigid) continue;
    double* phi = scratch.take<double>(n);
    a.window.gather([&](int s) { return body.present(s) ? body.at(s).phi.data() : nullptr; },
                    far_cells * a.dx(), Beyond::extend, phi);
    a.phi.back() = phi;
    auto* contact = scratch.take<std::uint32_t>(n);
    a.window.gather([&](int s) { return body.present(s) ? body.at(s).contact.data() : nullptr; },
                    std::uint32_t{0}, Beyond::extend, contact);
    a.contact.back() = contact;
  }
  return a;
}

/// Whether a body touched a partner in the last step in this cell or one around it.
template <int Dim>
bool was_in_contact(const Around<Dim>& a, int body, int partner, const Index<Dim>& i) {
  const std::uint32_t* bits = a.contact[body];
  if (!bits) return false;
  Box<Dim> box{i, i};
  for (int d = 0; d < Dim; ++d) --box.lo[d], box.hi[d] += 2;
  bool found = false;
  for_each(box, [&](const Index<Dim>& j) { found = found || (bits[a.window.at(j)] >> partner & 1U) != 0; });
  return found;
}

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
double shared_area(const Around<Dim>& a, const Side<Dim>& first, const Side<Dim>& second, Vec<Dim>& e) {
  if (second.rigid) {
    const auto k = static_cast<std::size_t>(second.body);
    e = -rigid_normal(a.state.grid(), *a.state.bodies[k].rigid, a.pose[k], first.cut->point);
    const double own = dot(first.rest, e);
    return a.state.grid().axisymmetric ? own : std::min(own, norm(second.cut->surface) * 1.0000001);
  }
  const Vec<Dim> difference = first.rest - second.rest;
  if (norm(difference) < 1e-14 * a.area) return 0;
  e = unit(difference);
  return std::min(dot(first.rest, e), -dot(second.rest, e));
}

template <int Dim>
void record(const Around<Dim>& a, const Side<Dim>& first, const Side<Dim>& second, const Touch& t,
            const ShearContact<Dim>& g, const Vec<Dim>& e, double area, double gap) {
  auto& ledger = a.state.ledger[a.slot];
  const bool in_order = first.body < second.body;
  PairRecord<Dim>& r = ledger.pairs[pair_number(std::min(first.body, second.body),
                                                std::max(first.body, second.body), a.state.count())];
  const double sign = in_order ? 1.0 : -1.0;
  const Vec<Dim> force = (sign * area) * (t.traction * e + g.traction);
  const double power = sign * area * (t.traction * t.work_velocity + dot(g.traction, g.work_velocity));
  r.exchanged.momentum += a.booked * force;
  r.moment += a.booked * cross(first.cut->point, force);
  r.exchanged.energy += a.booked * power;
  r.area += area;
  r.force += force;
  r.traction += t.traction * area;
  r.velocity += t.work_velocity * area;
  r.gap += gap * area;
  r.place += first.cut->point * area;
  r.widest_gap = std::max(r.widest_gap, gap / a.dx());
  r.deepest_overlap = std::min(r.deepest_overlap, gap / a.dx());
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

template <int Dim>
void try_pair(const Around<Dim>& a, Side<Dim>& first, Side<Dim>& second, double gap, const Index<Dim>& i,
              double face) {
  Vec<Dim> e;
  const double area = shared_area(a, first, second, e);
  if (area <= 1e-12 * face) return;
  const auto& bodies = a.state.bodies;
  const Body<Dim>&one = bodies[first.body], &other = bodies[second.body];
  const bool was =
      was_in_contact(a, first.body, second.body, i) || was_in_contact(a, second.body, first.body, i);
  const ContactLaw& law = a.state.contact[pair_number(std::min(first.body, second.body),
                                                      std::max(first.body, second.body), a.state.count())];
  const bool glued = law.mode == ContactLaw::Mode::bonded && (was || std::abs(gap) < welded_gap * a.dx());
  const double gap_speed = glued || (was && gap < kept_contact_gap * a.dx()) ? 0 : std::max(gap, 0.0) / a.dt;
  const auto s = surface_state(one.material, first.wall->value, e);
  const ContactSide mine{s.velocity, s.stress, s.impedance};
  if (second.rigid) {
    const Vec<Dim> wall = velocity_at(*other.rigid, first.cut->point);
    const double along = dot(wall, e);
    const Touch t = touch_rigid(mine, along, gap_speed, glued);
    if (!t.touching) return;
    const ShearContact<Dim> g = shear_contact_rigid(shear_side(s), wall - along * e, shear_limit(law, t));
    touch_part(first, second.body, e, 1, t.first_velocity * e + g.first_velocity, t, g, area);
    record(a, first, second, t, g, e, area, gap);
    return;
  }
  const auto r = surface_state(other.material, second.wall->value, e);
  const Touch t = touch(mine, {r.velocity, r.stress, r.impedance}, gap_speed, glued);
  if (!t.touching) return;
  const ShearContact<Dim> g = shear_contact(shear_side(s), shear_side(r), shear_limit(law, t));
  touch_part(first, second.body, e, 1, t.first_velocity * e + g.first_velocity, t, g, area);
  touch_part(second, first.body, e, -1, t.second_velocity * e + g.second_velocity, t, g, area);
  record(a, first, second, t, g, e, area, gap);
}

/// All pairs that meet in a cell, smallest gap first: each takes what the ones before have left of the
/// surfaces.
template <int Dim>
void touch_all(const Around<Dim>& a, std::vector<Side<Dim>>& sides, const Index<Dim>& i, double face) {
  struct Pair {
    double gap;
    std::size_t first, second;
  };
  std::array<Pair, 16> pairs{};
  std::size_t n = 0;
  for (std::size_t m = 0; m < sides.size(); ++m)
    for (std::size_t q = m + 1; q < sides.size(); ++q) {
      if (sides[m].rigid && sides[q].rigid) continue;
      const bool swap = sides[m].rigid;
      const Side<Dim>& first = sides[swap ? q : m];
      const double gap =
          a.distance(sides[m].body, first.cut->point) + a.distance(sides[q].body, first.cut->point);
      if (gap <= touching_gap * a.dx() && n < pairs.size()) pairs[n++] = {gap, swap ? q : m, swap ? m : q};
    }
  std::stable_sort(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(n),
                   [](const Pair& x, const Pair& y) { return x.gap < y.gap; });
  for (std::size_t k = 0; k < n; ++k)
    try_pair(a, sides[pairs[k].first], sides[pairs[k].second], pairs[k].gap, i, face);
}

/// What no partner has touched is free: no traction, velocity u - sigma/Z n - tau/Z_s.
template <int Dim>
void free_part(const Around<Dim>& a, Side<Dim>& s, const Index<Dim>& i, double face) {
  Wall<Dim>& w = *s.wall;
  const double whole = norm(s.cut->surface), rest = norm(s.rest);
  const bool contact = w.partners != 0;
  if (contact && rest < 1e-6 * face) {
    w.volume_rate += dot(s.touched_velocity, s.rest);
    w.velocity = s.touched_velocity;
    return;
  }
  Vec<Dim> velocity;
  if (contact && rest <= small_face * face) {
    velocity = w.face_velocity;
  } else {
    Vec<Dim> n =
        rest > small_face * face ? s.rest * (1 / rest) : phi_normal(a.window.box(), a.phi[s.body], i, a.dx());
    const Material& material = a.state.bodies[s.body].material;
    const auto state = surface_state(material, w.value, n);
    velocity = free_velocity(state.velocity, state.stress, state.impedance) * n + state.sliding -
               shear_recoil(state);
    if (!contact) {
      w.normal = n;
      w.face_velocity = velocity;
    }
  }
  act(s, {}, 0, velocity, s.rest);
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

}  // namespace

template <int Dim>
SurfaceState<Dim> resolve(const Primitives<Dim>& value, const Vec<Dim>& e) {
  using C = Components<Dim>;
  SurfaceState<Dim> s;
  Vec<Dim> u, t;
  for (int i = 0; i < Dim; ++i) {
    u[i] = value[C::u + i];
    for (int j = 0; j < Dim; ++j) {
      const int c = C::stress(i, j);
      const double sij = c >= 0 ? value[C::s + c] : -(value[C::s] + value[C::s + 1]);
      t[i] += sij * e[j];
    }
  }
  s.velocity = dot(u, e);
  s.sliding = u - s.velocity * e;
  s.deviator = dot(t, e);
  s.stress = s.deviator - value[C::p];
  s.shear = t - s.deviator * e;
  return s;
}

template <int Dim>
SurfaceState<Dim> surface_state(const Material& material, const Primitives<Dim>& value, const Vec<Dim>& e) {
  using C = Components<Dim>;
  SurfaceState<Dim> s = resolve<Dim>(value, e);
  const double rho = value[C::rho], g = shear_modulus(material);
  const double c2 = std::visit(
      [&](const auto& eos) {
        const double c0 = bulk_sound_speed(eos);
        return std::max(eos.sound_speed_squared(rho, value[C::p]), least_sound * c0 * c0);
      },
      material.eos);
  s.impedance = rho * std::sqrt(c2 + 4 * g / (3 * rho));
  s.shear_impedance = std::sqrt(rho * g);
  return s;
}

template <int Dim>
void find_walls(State<Dim>& state, int slot, double dt, double weight, Scratch& scratch) {
  auto& ledger = state.ledger[slot];
  for (auto& p : ledger.pairs) {
    const Account<Dim> kept = p.exchanged;
    const Vec<3> moment = p.moment;
    p = {};
    p.exchanged = kept;
    p.moment = moment;
  }
  bool any = false;
  for (Body<Dim>& body : state.bodies) {
    if (body.rigid || !body.present(slot)) continue;
    for (Wall<Dim>& w : body.at(slot).walls) reset(w);
    any = any || !body.at(slot).walls.empty();
  }
  if (!any) return;
  const Around<Dim> a = look_around(state, slot, dt, weight, scratch);
  const Box<Dim> layout = state.grid().layout();
  std::vector<Side<Dim>> sides;
  for (int m = 0; m < state.count(); ++m) {
    Body<Dim>& body = state.bodies[m];
    if (body.rigid || !body.present(slot)) continue;
    for (const CutCell<Dim>& cut : body.at(slot).geometry.cuts) {
      const auto cell = static_cast<std::size_t>(cut.cell);
      sides.clear();
      bool mine = true;  // a cell is done with its lowest deformable body
      for (int q = 0; q < state.count() && mine; ++q) {
        Body<Dim>& other = state.bodies[q];
        if (!other.present(slot)) continue;
        BodyBlock<Dim>& b = other.at(slot);
        const int at = b.geometry.index[cell];
        if (at < 0) continue;
        if (!other.rigid && q < m) mine = false;
        const CutCell<Dim>& c = b.geometry.cuts[at];
        sides.push_back(
            {q, other.rigid.has_value(), &c, other.rigid ? nullptr : &b.walls[at], c.surface, 0, {}});
      }
      if (!mine) continue;
      const Index<Dim> i = state.mesh.block(slot).cells.lo + layout.index(cut.cell);
      const double face = a.area * state.grid().radius(i[0]);
      if (sides.size() > 1) touch_all(a, sides, i, face);
      for (Side<Dim>& s : sides)
        if (!s.rigid) free_part(a, s, i, face);
    }
  }
  for (Body<Dim>& body : state.bodies)
    if (!body.rigid && body.present(slot))
      for (Wall<Dim>& w : body.at(slot).walls) w.mean_velocity += weight * w.velocity;
}

template <int Dim>
void remember_contact(BodyBlock<Dim>& b) {
  std::fill(b.contact.begin(), b.contact.end(), 0U);
  for (std::size_t m = 0; m < b.walls.size(); ++m) b.contact[b.geometry.cuts[m].cell] = b.walls[m].partners;
}

#define RECOIL_INSTANTIATE(Dim)                                                                            \
  template SurfaceState<Dim> resolve<Dim>(const Primitives<Dim>&, const Vec<Dim>&);                        \
  template SurfaceState<Dim> surface_state<Dim>(const Material&, const Primitives<Dim>&, const Vec<Dim>&); \
  template void find_walls<Dim>(State<Dim>&, int, double, double, Scratch&);                               \
  template void remember_contact<Dim>(BodyBlock<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
