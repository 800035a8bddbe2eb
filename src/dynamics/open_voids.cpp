#include "dynamics/open_voids.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "cutcell/moves_view.hpp"
#include "dynamics/failed_matter.hpp"
#include "dynamics/primitives.hpp"
#include "state/alone.hpp"
#include "state/places.hpp"

namespace recoil {

namespace {

constexpr double whole = 0.98;         // part of a cell from which on it counts as whole
constexpr double least_kept = 0.02;    // of a cell; a lost fragment that holds more keeps a level set ...
constexpr double kept_from = 2;        // [dx] ... where the surface of its body is farther
constexpr double most_in_pore = 0.5;   // of a cell, that a cell of a closed void holds
constexpr double most_squeezed = 0.5;  // of its volume, to which gas is compressed at most in a step ...
constexpr double densest_gas = 0.5;    // ... or to this part of the largest density that it takes

/// Radius [cells] of a ball (disc, layer) of so many cells.
template <int Dim>
double radius_of(double cells) {
  constexpr double pi = std::numbers::pi;
  return Dim == 1 ? 0.5 * cells : Dim == 2 ? std::sqrt(cells / pi) : std::cbrt(0.75 * cells / pi);
}

/// Whether a cell of a body is whole by its volume and by the end-of-step geometry.
template <int Dim>
bool is_whole(const State<Dim>& state, const BodyBlock<Dim>& b, std::size_t k, const Index<Dim>& i) {
  return b.end_geometry.kind[k] == CellKind::full && b.volume[k] >= whole * state.grid().full_volume(i);
}

/// What the other bodies that can be deformed hold in a cell.
template <int Dim>
double volume_of_others(const State<Dim>& state, const Body<Dim>& body, int slot, std::size_t k) {
  double sum = 0;
  for (const Body<Dim>& other : state.bodies)
    if (&other != &body && !other.rigid && other.present(slot)) sum += other.at(slot).volume[k];
  return sum;
}

/// Solid part of a whole cell; 1 where the matter has not failed or is under pressure.
template <int Dim>
double solid_part(const Body<Dim>& body, const BodyBlock<Dim>& b, std::size_t k) {
  using C = Components<Dim>;
  if (!(b.contents[k] > 0) || !has_failed(b, k)) return 1;
  const Contents<Dim> q = contents_of(b, static_cast<int>(k));
  double kinetic = 0;
  for (std::size_t d = 0; d < Dim; ++d) kinetic += 0.5 * q[C::u + d] * q[C::u + d] / q[C::rho];
  const double rho = q[C::rho] / b.volume[k], e = (q[C::energy] - kinetic) / q[C::rho];
  return solid_fraction(body.material.eos, rho, e, q[C::crushed] / q[C::rho]);
}

/// Whether a cell holds a fragment that the geometry has lost, far from the surface of its body. It must stay
/// within reach of a level set, else it could not go on (lost_fragment.hpp).
template <int Dim>
bool is_far_and_lost(const BodyBlock<Dim>& b, std::size_t k, double fill, double dx) {
  return fill > least_kept && b.phi[k] > kept_from * dx && b.end_geometry.kind[k] == CellKind::empty;
}

/// Marks the cells of a block that the geometry shows full, as all that share a face with them, but that hold
/// less than half of a cell of intact matter. @returns null where there are none.
template <int Dim>
const std::uint8_t* find_pores(const State<Dim>& state, const Body<Dim>& body, int slot, Scratch& scratch) {
  const BodyBlock<Dim>& b = body.at(slot);
  std::uint8_t* pore = nullptr;
  CellKind* kind = nullptr;
  const Window<Dim> w(state.mesh, slot, 1, state.mesh.block(slot).cells);
  for_each_place(state, slot, [&](const Index<Dim>& i, std::size_t k) {
    if (b.end_geometry.kind[k] != CellKind::full || !(b.contents[k] > 0) || has_failed(b, k)) return;
    if (!(b.volume[k] < most_in_pore * state.grid().full_volume(i))) return;
    if (!kind) {
      pore = scratch.take_filled<std::uint8_t>(b.volume.size(), 0);
      kind = scratch.take<CellKind>(static_cast<std::size_t>(w.size()));
      w.gather([&](int s) { return body.present(s) ? body.at(s).end_geometry.kind.data() : nullptr; },
               CellKind::empty, Beyond::extend, kind);
    }
    bool inside = true;
    for (int d = 0; d < Dim; ++d)
      for (const int side : {-1, 1}) inside = inside && kind[w.at(i) + side * w.stride(d)] == CellKind::full;
    if (inside) pore[k] = 1;
  });
  return pore;
}

}  // namespace

template <int Dim>
bool mark_open(const State<Dim>& state, Body<Dim>& body, int slot) {
  BodyBlock<Dim>& b = body.at(slot);
  bool any = false;
  for_each_place(state, slot, [&](const Index<Dim>& i, std::size_t k) {
    b.role[k] &= static_cast<std::uint8_t>(~opens);
    if (!(b.contents[k] > 0) || !has_failed(b, k) || !is_whole(state, b, k, i)) return;
    if (solid_part(body, b, k) >= open_solid) return;
    b.role[k] |= opens;
    any = true;
  });
  return any;
}

template <int Dim>
std::int64_t open_voids(const State<Dim>& state, Body<Dim>& body, int slot, Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  const Box<Dim> cells = state.mesh.block(slot).cells;
  const Window<Dim> w(state.mesh, slot, 1, cells);
  auto* role = scratch.take<std::uint8_t>(static_cast<std::size_t>(w.size()));
  w.gather([&](int s) { return body.present(s) ? body.at(s).role.data() : nullptr; }, std::uint8_t{0},
           Beyond::extend, role);
  std::int64_t count = 0;
  for_each_place(state, slot, [&](const Index<Dim>& i, std::size_t k) {
    bool near = false;
    Box<Dim> around{i, i};
    for (int d = 0; d < Dim; ++d) --around.lo[d], around.hi[d] += 2;
    for_each(around, [&](const Index<Dim>& j) { near = near || (role[w.at(j)] & opens) != 0; });
    if (!near || !is_whole(state, b, k, i)) return;
    const double solid = solid_part(body, b, k);
    b.phi_next[k] = std::max(b.phi[k], (open_solid - solid) * state.grid().dx);
    b.updates.push_back({static_cast<int>(k), solid * b.volume[k], contents_of(b, static_cast<int>(k))});
    ++count;
  });
  return count;
}

template <int Dim>
std::int64_t restore_level_set(const State<Dim>& state, Body<Dim>& body, int slot) {
  BodyBlock<Dim>& b = body.at(slot);
  const double dx = state.grid().dx;
  std::int64_t count = 0;
  for_each_place(state, slot, [&](const Index<Dim>& i, std::size_t k) {
    const double fill = b.volume[k] / state.grid().full_volume(i);
    if (!(b.contents[k] > 0)) return;
    double wanted = -0.01 * dx;  // a surface of its own, so that its level set stays
    if (!is_far_and_lost(b, k, fill, dx)) {
      if (fill < 0.5) return;
      const bool makes_room = fill > crowded && b.phi[k] > -radius_of<Dim>(fill) * dx &&
                              is_alone(state, body, slot, static_cast<int>(k));
      if (b.phi[k] < 0.5 * dx && !makes_room) return;
      const double solid = fill * solid_part(body, b, k), part = std::min(solid, 1.0);
      wanted = makes_room && solid > crowded ? -radius_of<Dim>(solid) * dx : (0.5 - part) * dx;
      if (part < 0.5 || wanted >= b.phi[k]) return;
    }
    b.phi[k] = wanted;
    ++count;
  });
  return count;
}

template <int Dim>
void fit_voids(const State<Dim>& state, Body<Dim>& body, int slot, Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  if (!b.near_surface) return;
  const std::uint8_t* pore = find_pores(state, body, slot, scratch);
  const double dx = state.grid().dx, thinnest = thinnest_failed * density(body.material);
  for_each_place(state, slot, [&](const Index<Dim>& i, std::size_t k) {
    const CellKind kind = b.end_geometry.kind[k];
    if (kind == CellKind::empty && b.volume[k] == 0 && b.phi[k] < 0) b.phi[k] = 0.5 * dx;  // it has gone on
    // Deeper than phi is kept there is no way outwards by which a cell could be filled.
    const bool failed = has_failed(b, k), deep = b.phi[k] <= -far_cells * dx;
    const bool trapped = pore && pore[k] != 0;
    if (!(b.contents[k] > 0) || !(failed || deep || trapped)) return;
    const double others = volume_of_others(state, body, slot, k);
    const double room = state.grid().full_volume(i) - others, v = b.volume[k];
    const bool lacks =
        kind == CellKind::full && v < room && (deep || trapped || b.contents[k] > thinnest * room);
    const bool exceeds = failed && (kind != CellKind::empty || others > 0) && v > room;
    if (lacks)
      b.volume[k] = room;
    else if (exceeds)
      b.volume[k] = std::max(room, v * solid_part(body, b, k));
  });
}

template <int Dim>
void fit_gas(const State<Dim>& state, Body<Dim>& body, int slot) {
  BodyBlock<Dim>& b = body.at(slot);
  if (!b.near_surface) return;
  const double densest = densest_gas * density_range(body.material.eos).most * density(body.material);
  for_each_place(state, slot, [&](const Index<Dim>& i, std::size_t k) {
    const double full = state.grid().full_volume(i), v = b.volume[k];
    if (!(b.contents[k] > 0) || !(v > 0)) return;
    const double others = volume_of_others(state, body, slot, k);
    if (!(others > 0) || v + others <= crowded * full) return;
    b.volume[k] = std::min(v, std::max({full - others, most_squeezed * v, b.contents[k] / densest}));
  });
}

#define RECOIL_INSTANTIATE(Dim)                                                        \
  template bool mark_open<Dim>(const State<Dim>&, Body<Dim>&, int);                    \
  template std::int64_t open_voids<Dim>(const State<Dim>&, Body<Dim>&, int, Scratch&); \
  template std::int64_t restore_level_set<Dim>(const State<Dim>&, Body<Dim>&, int);    \
  template void fit_voids<Dim>(const State<Dim>&, Body<Dim>&, int, Scratch&);          \
  template void fit_gas<Dim>(const State<Dim>&, Body<Dim>&, int);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
