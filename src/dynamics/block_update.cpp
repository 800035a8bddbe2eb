#include "dynamics/block_update.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <variant>

#include "core/multiversion.hpp"
#include "cutcell/whole_cells.hpp"
#include "dynamics/block_sources.hpp"
#include "dynamics/face_sweep.hpp"
#include "dynamics/half_step/block_half_step.hpp"
#include "dynamics/stiffness/shear_modulus.hpp"
#include "material/eos/any_eos.hpp"
#include "state/beside_contact.hpp"

namespace recoil {

namespace {

using detail::EnoLlf;
using detail::WenoHllc;
using detail::Work;

/// Sets what cells without a value show.
RECOIL_MULTIVERSION void keep_valued(std::size_t n, const std::uint8_t* role, double missing, double* value) {
#pragma GCC ivdep
  for (std::size_t k = 0; k < n; ++k) value[k] = (role[k] & valued) != 0 ? value[k] : missing;
}

/// Whether cells that a block reads may lack a value: those of blocks near a surface, and of other processes'
/// blocks, which do not say. Both blocks at a face have to leave the same cells out.
template <int Dim>
bool may_lack_values(const Mesh<Dim>& mesh, const Body<Dim>& body, int slot) {
  if (body.at(slot).near_surface) return true;
  if (mesh.block(slot).level > 0) return false;  // no surface is there
  return std::ranges::any_of(mesh.block(slot).neighbour, [&](int s) {
    return s >= 0 && body.present(s) && (s >= mesh.local() || body.at(s).near_surface);
  });
}

/// What the cells of the window are good for, into Work::role; nothing where all are regular, far from a
/// surface.
template <int Dim>
void gather_roles(const State<Dim>& state, const Body<Dim>& body, int slot, Work<Dim>& w, Scratch& scratch) {
  if (!may_lack_values(state.mesh, body, slot)) return;
  w.role = scratch.take<std::uint8_t>(w.wide);
  w.window.gather([&](int s) { return body.present(s) ? body.at(s).role.data() : nullptr; }, std::uint8_t{0},
                  Beyond::extend, w.role);
  const bool all = std::all_of(w.role, w.role + w.wide,
                               [](std::uint8_t r) { return (r & (regular | valued)) == (regular | valued); });
  if (all && !body.at(slot).near_surface) w.role = nullptr;
}

/// The first `count` primitives of the window's cells; the others are zero.
template <std::size_t count, int Dim>
void gather_primitives(const Body<Dim>& body, double rho0, Work<Dim>& w, Scratch& scratch) {
  using C = Components<Dim>;
  w.held = count;
  w.primitive = scratch.take<double>(w.wide * C::primitives + vector_length);
  std::fill_n(w.primitive + w.wide * count, w.wide * (C::primitives - count) + vector_length, 0.0);
  std::array<typename Window<Dim>::template Component<double>, count> components;
  for (std::size_t c = 0; c < count; ++c) {
    components[c].missing = c == C::rho ? rho0 : 0.0;
    for (int d = 0; d < Dim; ++d)
      if (component_sign<Dim>(static_cast<int>(c), 1U << d) < 0) components[c].odd_axes |= 1U << d;
  }
  w.window.gather([&](int s) { return body.present(s) ? body.at(s).stencil.data() : nullptr; }, components,
                  Beyond::extend, w.primitive);
  if (!w.role) return;
  for (std::size_t c = 0; c < count; ++c) {
    const double missing = c == C::rho ? rho0 : 0.0;
    double* value = w.primitive + c * w.wide;
    keep_valued(w.wide, w.role, missing, value);
  }
}

/// Says which cells of the window have failed, and which of them have a void; nothing where none has. Matter
/// whose pressure knows its energy has an energy beside it (`extra`) only where donors of a ghost had a void.
template <int Dim>
void find_failed(const AnyEos& eos, Work<Dim>& w, Scratch& scratch) {
  using C = Components<Dim>;
  const double *damage = w.primitive + C::damage * w.wide, *p = w.primitive + C::p * w.wide,
               *extra = w.primitive + C::extra * w.wide;
  const auto has_void = [&](std::size_t k) {
    return (damage[k] >= failed_damage && p[k] == 0) || (!eos.barotropic && extra[k] != 0);
  };
  bool any = false;
  for (std::size_t k = 0; k < w.wide; ++k) any = any || damage[k] >= failed_damage || has_void(k);
  if (!any) return;
  w.failed = scratch.take<std::uint8_t>(w.wide);
  for (std::size_t k = 0; k < w.wide; ++k)
    w.failed[k] = has_void(k) ? with_void : damage[k] >= failed_damage ? failed_matter : intact;
}

/// The shear modulus of the window's cells.
template <int Dim>
void find_shear_moduli(const Body<Dim>& body, Work<Dim>& w, Scratch& scratch) {
  w.shear = scratch.take_filled<double>(w.wide + vector_length, shear_modulus(body.material));
  if (!modulus_follows(body.material.strength)) return;
  for (std::size_t k = 0; k < w.wide; ++k) {
    Primitives<Dim> v;
    for (std::size_t c = 0; c < v.size(); ++c) v[c] = w.primitive[c * w.wide + k];
    w.shear[k] = shear_modulus_of(body, v);
  }
}

/// Whether all matter in the window is at rest and without stress, so that no face of it lets anything pass
/// (AtRest): reconstructed stresses are at most ten times as large as components in cells. What has voids, or
/// may fall out of bounds, is not called so.
template <int Dim>
bool is_still(const AnyEos& eos, const Work<Dim>& w) {
  using C = Components<Dim>;
  constexpr double part = 1.0 / 16;
  if (w.whole || w.failed) return false;
  const detail::AtRest rest(eos);
  const auto within = [&](int first, int end, double most) {  // components, which stand side by side
    const auto count = static_cast<std::size_t>(end - first) * w.wide;
    return detail::all_within(w.primitive + static_cast<std::size_t>(first) * w.wide, static_cast<int>(count),
                              most);
  };
  if (!within(C::u, C::p, part * rest.speed) || !within(C::p, C::ep, part * rest.stress)) return false;
  const double* rho = w.primitive;
  return std::all_of(rho, rho + w.wide, [&](double r) { return r > 0.7 * eos.rho0 && r < 1.4 * eos.rho0; });
}

/// Whether a step adds exactly nothing to the block: far from surfaces, nothing passes its faces.
template <int Dim>
bool is_idle(const BodyBlock<Dim>& b, const Work<Dim>& w) {
  return w.still && !w.role && !w.sides && b.geometry.cuts.empty();
}

template <int Dim>
void gather_values(const State<Dim>& state, const Body<Dim>& body, int slot, const AnyEos& eos, Work<Dim>& w,
                   Scratch& scratch) {
  using C = Components<Dim>;
  w.fails = can_fail(body.material.damage);
  w.flattens = has_tension(body.material.eos);  // not in gases (docs/decisions/0046)
  gather_roles(state, body, slot, w, scratch);
  if (w.fails || eos.barotropic)
    gather_primitives<C::primitives>(body, eos.rho0, w, scratch);
  else
    gather_primitives<C::damage>(body, eos.rho0, w, scratch);
  if (w.fails) find_failed(eos, w, scratch);
  w.still = is_still(eos, w);
  if (is_idle(body.at(slot), w)) return;  // nothing else is read
  w.impedance = scratch.take<double>(w.wide + vector_length);
  const double least = least_sound_squared(eos);
  const double* rho = w.primitive;
  eos.wave_speeds_squared(rho, w.primitive + C::p * w.wide, w.primitive + C::crushed * w.wide, w.wide,
                          w.impedance);
  const auto count = static_cast<int>(w.wide);
  find_shear_moduli(body, w, scratch);
  detail::find_impedances(count, rho, least, w.shear, w.impedance);
}

/// Says where MP5 reconstructs: in matter that never yields, where the cell's own average stands in the
/// stencil, and beside contacts. In matter that yields it would ring behind plastic shocks, or cost more than
/// it gives where it may not; with ghost values in its stencils a disc in free flight gains spin
/// (docs/decisions/0043).
template <int Dim>
void find_never_yielding(const Body<Dim>& body, Work<Dim>& w, Scratch& scratch) {
  if (w.fails || !std::holds_alternative<Elastic>(body.material.strength)) return;
  w.never_yields = scratch.take_filled<std::uint8_t>(w.wide + vector_length, 1);
  if (!w.role) return;
  std::uint8_t any = 0;
  for (std::size_t k = 0; k < w.wide; ++k) any |= w.role[k] & beside_contact;
  if (any != 0) w.beside_contact = scratch.take_filled<std::uint8_t>(w.wide + vector_length, 0);
  for (std::size_t k = 0; k < w.wide; ++k) {
    const bool beside = (w.role[k] & beside_contact) != 0 && (w.role[k] & valued) != 0;
    w.never_yields[k] = (w.role[k] & regular) != 0 || beside;
    if (beside) w.beside_contact[k] = 1;
  }
}

/// Where pores are being crushed, waves of loading run along the crush curve, not along the elastic branch:
///   c^2 = c_e^2/(1 + (dp/dalpha) |dalpha/dp|),  dp/dalpha = (rho c_e^2 - p)/alpha at a fixed density,
///   |dalpha/dp| = n (alpha - 1)/(p_s - p) along the curve.
/// Their impedance stands in for that of sound in the cells that are on the curve and are compressed.
template <int Dim>
void soften_crushing(const Porous& eos, Work<Dim>& w) {
  using C = Components<Dim>;
  constexpr double on_curve = 0.97;  // of the pressure there
  const auto at = [&](int c, std::ptrdiff_t k) {
    return w.primitive[static_cast<std::size_t>(c) * w.wide + k];
  };
  for_each(w.window.box().grown(-1), [&](const Index<Dim>& i) {
    const std::ptrdiff_t k = w.window.at(i);
    const double alpha = eos.distension(at(C::crushed, k)), p = at(C::p, k), rho = at(C::rho, k);
    if (!(alpha > 1) || !(p > 0) || p >= eos.compaction) return;
    double divergence = 0;
    for (int d = 0; d < Dim; ++d)
      divergence += at(C::u + d, k + w.window.stride(d)) - at(C::u + d, k - w.window.stride(d));
    const double left = std::pow((alpha - 1) / (eos.alpha0 - 1), 1 / eos.exponent),
                 curve = eos.compaction - (eos.compaction - eos.elastic_limit) * left;
    if (!(divergence < 0) || p < on_curve * curve) return;
    const double z = w.impedance[k], shear = 4.0 / 3 * w.shear[k],
                 elastic = z * z / rho - shear;  // rho c_e^2
    const double slope = (elastic - p) / alpha * eos.exponent * (alpha - 1) / (eos.compaction - p);
    w.impedance[k] = std::sqrt(rho * (elastic / (1 + std::max(slope, 0.0)) + shear));
  });
}

template <int Dim>
void add_rates(BodyBlock<Dim>& b, const Work<Dim>& w, double dt) {
  const std::size_t all = w.grid.layout().size();
  Box<Dim> rows = w.cells;
  rows.hi[0] = rows.lo[0] + 1;
  const int width = w.cells.extent(0);
  for_each(rows, [&](const Index<Dim>& r) {
    const int from = w.cells.at(r), to = w.window.cell(r);
    for (std::size_t c = 0; c < w.carried(); ++c)
      detail::add_scaled(width, dt, w.rate + c * w.n + from, b.contents.data() + c * all + to);
  });
}

/// What flows into cells that are not real is lost: their values follow from the real ones.
template <int Dim>
void drop_outside(Work<Dim>& w) {
  if (!w.role) return;
  for_each(w.cells, [&](const Index<Dim>& i) {
    if ((w.role[w.window.at(i)] & regular) != 0) return;
    const int k = w.cells.at(i);
    for (std::size_t c = 0; c < Components<Dim>::contents; ++c) w.rate[c * w.n + k] = 0;
  });
}

template <int Dim, bool Shear, class Scheme>
void update(const State<Dim>& state, const AnyEos& eos, Body<Dim>& body, int slot, Cells cells,
            FaceTime faces, double dt, double weight, ExactEdgeAccount<Dim>& edges, Counters& counters,
            Scratch& scratch) {
  using C = Components<Dim>;
  BodyBlock<Dim>& b = body.at(slot);
  Work<Dim> w{state.grid(slot), Window<Dim>(state.mesh, slot, detail::face_reach, b.matter), b.matter};
  const detail::LevelSides<Dim> sides{state.mesh, body, slot};
  if (!state.mesh.is_among_equals(slot)) w.sides = &sides;
  w.n = w.cells.size();
  w.wide = w.window.size();
  w.whole = cells == Cells::whole;
  gather_values(state, body, slot, eos, w, scratch);
  if (is_idle(b, w)) return;
  if (Scheme::by_cells && eos.porous) soften_crushing(*eos.porous, w);  // LLF needs the fastest signal
  if (Shear && Scheme::by_cells && !w.whole && !eos.porous) find_never_yielding(body, w, scratch);
  if (faces == FaceTime::midstep) detail::find_half_step(body, dt, w, scratch);
  w.rate = scratch.take<double>(w.n * C::contents);  // set by the sweeps, as the next two
  w.gradient = scratch.take<double>(w.n * Dim * Dim);
  w.radial = scratch.take<double>(state.grid(slot).has_radius() ? w.n * Dim : 1);
  const double booked = weight * dt;
  detail::sweep<Dim, 0, Shear, Scheme>(eos, b.geometry, w, booked, edges, counters, scratch);
  if constexpr (Dim > 1)
    detail::sweep<Dim, 1, Shear, Scheme>(eos, b.geometry, w, booked, edges, counters, scratch);
  if constexpr (Dim > 2)
    detail::sweep<Dim, 2, Shear, Scheme>(eos, b.geometry, w, booked, edges, counters, scratch);
  if (faces == FaceTime::midstep) detail::move_to_midstep(w);
  if (!w.whole) detail::add_walls(b, w, dt);
  detail::add_sources(body, slot, w, scratch);
  if (w.whole) drop_outside(w);
  add_rates(b, w, dt);
}

template <class Scheme, int Dim>
void update_with(const State<Dim>& state, Body<Dim>& body, int slot, Cells cells, FaceTime faces, double dt,
                 double weight, ExactEdgeAccount<Dim>& edges, Counters& counters, Scratch& scratch) {
  if (body.at(slot).matter.size() == 0) return;
  const AnyEos eos{body.material.eos};
  if (has_strength(body.material.strength) && !is_fluid(eos.eos))
    update<Dim, true, Scheme>(state, eos, body, slot, cells, faces, dt, weight, edges, counters, scratch);
  else
    update<Dim, false, Scheme>(state, eos, body, slot, cells, faces, dt, weight, edges, counters, scratch);
}

}  // namespace

template <int Dim>
void update_block(const State<Dim>& state, Body<Dim>& body, int slot, FaceTime faces, double dt,
                  double weight, ExactEdgeAccount<Dim>& edges, Counters& counters, Scratch& scratch) {
  update_with<WenoHllc>(state, body, slot, Cells::cut, faces, dt, weight, edges, counters, scratch);
}

template <int Dim>
void update_whole_cells(const State<Dim>& state, Body<Dim>& body, int slot, FaceScheme scheme, double dt,
                        double weight, ExactEdgeAccount<Dim>& edges, Counters& counters, Scratch& scratch) {
  if (scheme == FaceScheme::eno_llf)
    update_with<EnoLlf>(state, body, slot, Cells::whole, FaceTime::now, dt, weight, edges, counters, scratch);
  else
    update_with<WenoHllc>(state, body, slot, Cells::whole, FaceTime::now, dt, weight, edges, counters,
                          scratch);
}

#define RECOIL_INSTANTIATE(Dim)                                                                         \
  template void update_block<Dim>(const State<Dim>&, Body<Dim>&, int, FaceTime, double, double,         \
                                  ExactEdgeAccount<Dim>&, Counters&, Scratch&);                         \
  template void update_whole_cells<Dim>(const State<Dim>&, Body<Dim>&, int, FaceScheme, double, double, \
                                        ExactEdgeAccount<Dim>&, Counters&, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
