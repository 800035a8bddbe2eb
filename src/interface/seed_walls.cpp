#include "interface/seed_walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "contact/seed_contact.hpp"
#include "interface/each_ghost_wall.hpp"

namespace recoil {

namespace {

/// Primitives of a real cell of a window, as they appear there.
template <int Dim>
Primitives<Dim> cell_value(const SurfaceView<Dim>& v, int m, const Index<Dim>& i) {
  const auto from = v.window.source(i);
  const FieldArray<double>& average = v.body(m).at(from.slot).average;
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
  const std::uint8_t* role = v.role[m];
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
  return v.phi[m][v.window.at(i)];
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
              const Index<Dim>& i, double kappa, Wall<Dim>& w) {
  const GhostContact<Dim> c(v, m, o, cut, i, w);
  double traction = 0;
  if (!colliding_traction(v, m, o, cut.point, i, kappa, c.direction, traction)) return false;
  if (!presses(traction, c.mine.velocity - c.theirs.velocity, c.was)) return false;
  const Touch t = c.rigid ? join_rigid(c.mine, c.theirs.velocity) : join(c.mine, c.theirs);
  c.apply(v, m, o, cut, t, w);
  return true;
}

}  // namespace

template <int Dim>
void find_seed_walls(State<Dim>& state, int slot, double kappa, double dt, double weight, Scratch& scratch) {
  for_each_ghost_wall(state, slot, dt, weight, scratch,
                      [&](const SurfaceView<Dim>& v, int m, const Opposite<Dim>& o, const CutCell<Dim>& cut,
                          const Index<Dim>& i, Wall<Dim>& w) {
                        if (!o.faces(w.normal) || !try_join(v, m, o, cut, i, kappa, w))
                          release(v.body(m).material, w);
                      });
}

#define RECOIL_INSTANTIATE(Dim) \
  template void find_seed_walls<Dim>(State<Dim>&, int, double, double, double, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
