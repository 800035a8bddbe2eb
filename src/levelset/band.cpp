#include "levelset/band.hpp"
#include "core/multiversion.hpp"
#include "state/level_set_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace recoil {

namespace {

/// Of a rigid body, whose distance is known everywhere: coarser blocks do not hold it, so that it may come
/// near a finest one without being in a block beside it.
template <int Dim>
BandChoice<Dim> choose_rigid_band(const State<Dim>& state, const Body<Dim>& body, int slot) {
  const Grid<Dim>& grid = state.grid();
  const Box<Dim> cells = state.mesh.block(slot).cells;
  const double band = far_cells * grid.dx;
  const RigidPose<Dim> pose = pose_after(*body.rigid, 0);
  Vec<Dim> middle;
  double across = 0;
  for (int d = 0; d < Dim; ++d) {
    middle[d] = 0.5 * (grid.centre(cells.lo)[d] + grid.centre(cells.hi)[d] - grid.dx);
    across += std::pow(0.5 * (cells.extent(d) + 4) * grid.dx, 2);
  }
  BandChoice<Dim> choice;
  if (std::abs(distance_at(*body.rigid, pose, middle)) > std::sqrt(across) + band) return choice;
  for_each(cells.grown(2), [&](const Index<Dim>& i) {
    const double phi = distance_at(*body.rigid, pose, grid.centre(i));
    choice.near_surface = choice.near_surface || std::abs(phi) < band;
    if (cells.contains(i) && phi < reach_cells * grid.dx) extend(choice.reach, i);
  });
  choice.present = choice.near_surface;
  return choice;
}

struct Seen {
  bool near_surface, inside;
};

/// What cells with these values of phi say.
RECOIL_MULTIVERSION Seen look(int count, const double* phi, double band) {
  int near_surface = 0, inside = 0;
#pragma omp simd reduction(| : near_surface, inside)
  for (int k = 0; k < count; ++k) {
    near_surface |= std::abs(phi[k]) < band ? 1 : 0;
    inside |= phi[k] < 0 ? 1 : 0;
  }
  return {near_surface != 0, inside != 0};
}

/// Whether a cell of the window, which reaches into the blocks around, is filled in part: redistribution
/// shares what is in it with cells up to two away, so that their blocks have to take part. What stands in for
/// a coarser block is whole or empty.
template <int Dim>
bool has_partial_cells(const State<Dim>& state, const Body<Dim>& body, const Window<Dim>& w,
                       Scratch& scratch) {
  const Scratch::Frame frame(scratch);
  auto* volume = scratch.take<double>(static_cast<std::size_t>(w.size()));
  w.gather([&](int s) { return body.present(s) ? body.at(s).volume.data() : nullptr; }, 0.0, Beyond::nothing,
           volume);
  const Grid<Dim>& grid = state.grid();
  bool partial = false;
  for_each(w.box(), [&](const Index<Dim>& i) {
    const double v = volume[w.at(i)], full = grid.full_volume(i);
    partial = partial || (v != 0 && std::abs(v - full) > 1e-12 * full);
  });
  return partial;
}

}  // namespace

template <int Dim>
BandChoice<Dim> choose_band(const State<Dim>& state, const Body<Dim>& body, int slot, Scratch& scratch) {
  const Grid<Dim>& grid = state.grid();
  const BodyBlock<Dim>& b = body.at(slot);
  BandChoice<Dim> choice;
  if (state.mesh.block(slot).level > 0) {  // no surface is there
    choice.present = b.present && !body.rigid &&
                     std::any_of(b.volume.begin(), b.volume.end(), [](double v) { return v != 0; });
    return choice;
  }
  if (body.rigid && state.mesh.levels() > 1) return choose_rigid_band(state, body, slot);
  bool around = false;
  for (const int s : state.mesh.block(slot).neighbour) around = around || (s >= 0 && body.present(s));
  if (!around) return choice;
  const Window<Dim> w(state.mesh, slot, 2);
  const double* phi = view_level_set(state.grid(), body, w, &BodyBlock<Dim>::phi, scratch);
  const double band = far_cells * grid.dx;
  const Seen seen = look(w.size(), phi, band);
  const bool inside = seen.inside;
  choice.near_surface = seen.near_surface;
  choice.present = choice.near_surface || (inside && !body.rigid);
  const double* volume = b.present && !body.rigid ? b.volume.data() : nullptr;
  const int width = w.inner().extent(0);
  Box<Dim> rows = w.inner();
  rows.hi[0] = rows.lo[0] + 1;
  for_each(rows, [&](Index<Dim> i) {
    const double* row = phi + w.at(i);
    const double* held = volume ? volume + w.cell(i) : nullptr;
    const auto counts = [&](int c) { return row[c] < reach_cells * grid.dx || (held && held[c] != 0); };
    int first = 0, last = width - 1;
    while (first < width && !counts(first)) ++first;
    if (first == width) return;
    while (!counts(last)) --last;
    const int low = i[0];
    for (const int c : {first, last}) {
      i[0] = low + c;
      extend(choice.reach, i);
    }
  });
  if (!b.present || body.rigid || choice.near_surface) return choice;
  // Fragments that the level set has lost stay, and stay cut.
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = grid.layout();
  bool any = false;
  for_each(cells, [&](const Index<Dim>& i) { any = any || b.volume[layout.at(i - cells.lo)] != 0; });
  choice.present = choice.present || any;
  choice.near_surface = (any && !inside) || has_partial_cells(state, body, w, scratch);
  return choice;
}

/// Cells beyond the reach of a surface, and cells farther within than phi is kept, have no velocity of
/// surfaces: not where other cells of their block are near one either, since results do not depend on blocks.
template <int Dim>
void clear_far_velocity(BodyBlock<Dim>& b, double dx) {
  const std::size_t n = b.phi.size();
  for (std::size_t k = 0; k < n && !b.extension_velocity.empty(); ++k) {
    if (b.phi[k] < reach_cells * dx && b.phi[k] > -far_cells * dx) continue;
    for (std::size_t d = 0; d < Dim; ++d) b.extension_velocity[d * n + k] = 0;
  }
}

template <int Dim>
void apply_band(const State<Dim>& state, Body<Dim>& body, int slot, const BandChoice<Dim>& choice) {
  if (!choice.present) {
    leave_block(body, slot);
    return;
  }
  enter_block(body, slot, state.grid());
  BodyBlock<Dim>& b = body.at(slot);
  const bool was_near = b.near_surface;
  b.near_surface = choice.near_surface;
  b.reach = choice.near_surface ? choice.reach : state.mesh.block(slot).cells;
  if (!choice.near_surface) b.matter = b.reach;
  const bool void_here = choice.near_surface && choice.reach.size() == 0;
  if (choice.near_surface && !void_here && !body.rigid) clear_far_velocity(b, state.grid().dx);
  if ((choice.near_surface && !void_here) || (!choice.near_surface && !was_near)) return;
  if (void_here) b.matter = {};
  const CellKind kind = !void_here && b.phi[0] < 0 ? CellKind::full : CellKind::empty;
  for (Geometry<Dim>* g : {&b.geometry, &b.end_geometry}) {
    std::fill(g->kind.begin(), g->kind.end(), kind);
    std::fill(g->index.begin(), g->index.end(), -1);
    g->cuts.clear();
  }
  b.walls.clear();
  b.ghosts.clear();
  std::fill(b.extension_velocity.begin(), b.extension_velocity.end(), 0.0);
  std::fill(b.lag.begin(), b.lag.end(), far_cells * state.grid().dx);
  const int role = kind == CellKind::full ? donates | regular | valued : 0;
  std::fill(b.role.begin(), b.role.end(), static_cast<std::uint8_t>(role));
  std::fill(b.contact.begin(), b.contact.end(), 0U);
}

#define RECOIL_INSTANTIATE(Dim)                                                                  \
  template BandChoice<Dim> choose_band<Dim>(const State<Dim>&, const Body<Dim>&, int, Scratch&); \
  template void apply_band<Dim>(const State<Dim>&, Body<Dim>&, int, const BandChoice<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
