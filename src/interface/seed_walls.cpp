#include "interface/seed_walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/seed_contact.hpp"
#include "interface/opposite.hpp"
#include "interface/walls.hpp"

namespace recoil {

namespace {

/// Primitives of a real cell of a window, as they appear there.
template <int Dim>
Primitives<Dim> cell_value(const SurfaceView<Dim>& v, int m, const Index<Dim>& i) {
  const auto from = v.window.source(i);
  const std::vector<double>& average = v.body(m).at(from.slot).average;
  const std::size_t n = average.size() / Components<Dim>::primitives;
  Primitives<Dim> w;
  for (std::size_t c = 0; c < w.size(); ++c) {
    w[c] = average[c * n + static_cast<std::size_t>(from.cell)];
    if (from.flips != 0) w[c] *= component_sign<Dim>(static_cast<int>(c), from.flips);
  }
  return w;
}

template <int Dim>
bool is_real(const SurfaceView<Dim>& v, int m, const Index<Dim>& i) {
  const std::uint8_t* role = v.role[static_cast<std::size_t>(m)];
  return role && v.window.box().contains(i) && (role[v.window.at(i)] & regular) != 0;
}

/// A real cell with a neighbour across a face that is not real.
template <int Dim>
bool is_interfacial(const SurfaceView<Dim>& v, int m, const Index<Dim>& i) {
  if (!is_real(v, m, i)) return false;
  for (int d = 0; d < Dim; ++d)
    for (int o = -1; o <= 1; o += 2) {
      Index<Dim> j = i;
      j[d] += o;
      if (v.window.box().contains(j) && !is_real(v, m, j)) return true;
    }
  return false;
}

template <int Dim>
Box<Dim> cells_around(const Index<Dim>& i, int reach) {
  Box<Dim> box{i, i};
  for (int d = 0; d < Dim; ++d) box.lo[d] -= reach, box.hi[d] += reach + 1;
  return box;
}

/// The interfacial node of a body nearest to x, within `reach` cells of i. @returns whether there is one.
template <int Dim>
bool nearest_node(const SurfaceView<Dim>& v, int m, const Vec<Dim>& x, const Index<Dim>& i, int reach,
                  Index<Dim>& node) {
  double nearest = 1e300;
  for_each(cells_around(i, reach), [&](const Index<Dim>& j) {
    const Vec<Dim> r = v.state.grid().centre(j) - x;
    if (dot(r, r) >= nearest || !is_interfacial(v, m, j)) return;
    nearest = dot(r, r);
    node = j;
  });
  return nearest < 1e300;
}

/// n . sigma n at a node by a least-squares field through the real ones of its immediate neighbours; its own
/// value where they are too few.
template <int Dim>
double traction_at(const SurfaceView<Dim>& v, int m, const Index<Dim>& node, const Vec<Dim>& n) {
  constexpr std::size_t most = static_cast<std::size_t>(power<Dim>(3));
  std::array<double, most * Dim> place{};
  std::array<double, most> traction{};
  std::size_t count = 0;
  for_each(cells_around(node, 1), [&](const Index<Dim>& j) {
    if (j == node || !is_real(v, m, j)) return;
    for (std::size_t d = 0; d < Dim; ++d)
      place[count * Dim + d] = j[static_cast<int>(d)] - node[static_cast<int>(d)];
    traction[count++] = resolve<Dim>(cell_value(v, m, j), n).stress;
  });
  double fitted = 0;
  if (fit_at_origin(Dim, {place.data(), count * Dim}, {traction.data(), count}, fitted)) return fitted;
  return resolve<Dim>(cell_value(v, m, node), n).stress;
}

template <int Dim>
double phi_at(const SurfaceView<Dim>& v, int m, const Index<Dim>& i) {
  return v.phi[static_cast<std::size_t>(m)][v.window.at(i)];
}

/// T_n of the interface beside a colliding node of body m. @returns false where the node does not collide.
template <int Dim>
bool colliding_traction(const SurfaceView<Dim>& v, int m, const Opposite<Dim>& o, const Vec<Dim>& x,
                        const Index<Dim>& i, double kappa, const Vec<Dim>& e, double& traction) {
  Index<Dim> node, partner;
  if (!nearest_node(v, m, x, i, 1, node)) return false;
  if (!colliding(phi_at(v, m, node), phi_at(v, o.body, node), kappa, v.dx())) return false;
  const CollidingNode first{traction_at(v, m, node, e), std::abs(phi_at(v, m, node))};
  traction = first.traction;
  if (v.body(o.body).rigid || !nearest_node(v, o.body, v.state.grid().centre(node), i, 2, partner))
    return true;
  traction =
      interface_traction(first, {traction_at(v, o.body, partner, e), std::abs(phi_at(v, o.body, partner))});
  return true;
}

/// Material-material or material-rigid conditions at one surface point, if they hold. @returns whether.
template <int Dim>
bool try_join(const SurfaceView<Dim>& v, int m, const Opposite<Dim>& o, const CutCell<Dim>& cut,
              const Index<Dim>& i, double kappa, double booked, Wall<Dim>& w) {
  const Body<Dim>& other = v.body(o.body);
  const Vec<Dim> e = contact_normal(v, o, w.normal);
  double traction = 0;
  if (!colliding_traction(v, m, o, cut.point, i, kappa, e, traction)) return false;
  const auto s = surface_state(v.body(m).material, w.value, e);
  const ContactSide mine{s.velocity, s.stress, s.impedance};
  ContactSide theirs;
  if (other.rigid) {
    theirs.velocity = dot(other.rigid->velocity, e);
  } else {
    const auto r = surface_state(other.material, o.value, e);
    theirs = {r.velocity, r.stress, r.impedance};
  }
  const bool was = v.was_in_contact(m, o.body, i) || v.was_in_contact(o.body, m, i);
  if (!presses(traction, mine.velocity - theirs.velocity, was)) return false;
  const Touch t = other.rigid ? join_rigid(mine, theirs.velocity) : join(mine, theirs);
  w.traction = t.traction;
  w.velocity = w.face_velocity = t.first_velocity * e + s.sliding - shear_recoil(s);
  w.partners = 1U << o.body;
  record_contact(v, m, o, cut, e, t.traction, t.work_velocity, booked);
  return true;
}

template <int Dim>
void find_wall(const SurfaceView<Dim>& v, int m, const CutCell<Dim>& cut, double kappa, double booked,
               Wall<Dim>& w) {
  const Index<Dim> i = v.state.mesh.block(v.slot).cells.lo + v.state.grid().layout().index(cut.cell);
  w.normal = v.normal(m, i);
  w.partners = 0;
  w.traction = 0;
  const Opposite<Dim> o = w.donors > 0 ? find_opposite(v, m, cut.point, i) : Opposite<Dim>{};
  if (o.faces(w.normal) && try_join(v, m, o, cut, i, kappa, booked, w)) return;
  const auto s = surface_state(v.body(m).material, w.value, w.normal);
  w.velocity = w.face_velocity =
      free_velocity(s.velocity, s.stress, s.impedance) * w.normal + s.sliding - shear_recoil(s);
}

}  // namespace

template <int Dim>
void find_seed_walls(State<Dim>& state, int slot, double kappa, double dt, double share, Scratch& scratch) {
  if (share > 0) clear_records(state, slot);
  const SurfaceView<Dim> v = view_surfaces(state, slot, PhiAt::midstep, scratch);
  for (int m = 0; m < state.count(); ++m) {
    Body<Dim>& body = state.bodies[static_cast<std::size_t>(m)];
    if (body.rigid || !body.present(slot)) continue;
    BodyBlock<Dim>& b = body.at(slot);
    for (std::size_t k = 0; k < b.walls.size(); ++k) {
      find_wall(v, m, b.geometry.cuts[k], kappa, share * dt, b.walls[k]);
      b.walls[k].mean_velocity += share * b.walls[k].velocity;
    }
  }
}

#define RECOIL_INSTANTIATE(Dim) \
  template void find_seed_walls<Dim>(State<Dim>&, int, double, double, double, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
