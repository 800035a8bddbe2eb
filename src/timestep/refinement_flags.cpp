#include "timestep/refinement_flags.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

#include "dynamics/failed_matter.hpp"

namespace recoil {

namespace {

constexpr double least_bend = 0.002;  // of the sound speed: what stands for the yield velocity of a fluid
constexpr double hold = 0.2;      // part of the bend at which a block keeps its level: in twice as wide cells
                                  // a smooth field bends four times as much
constexpr double damaged = 1e-3;  // from which on matter is refined
// Cells around what bends that are the finest too: waves run 2 cells or less in the 4 steps between two
// looks.
constexpr int ahead_of_waves = 6;
// Cells around a surface that are the finest in any case: irregular kernels read 9 around a cut cell.
constexpr int around_surface = widest_halo + 2;
constexpr double at_surface = 2;  // dx, of cells that are cut or may soon be

/// The velocity at which an elastic wave reaches the yield stress [m/s]: Y / (rho c_L).
double yield_velocity(const Material& m) {
  const double rest = bulk_sound_speed(m), fluid = least_bend * rest;
  if (!has_strength(m.strength)) return fluid;
  const double yield = std::visit([&](const auto& s) { return s.yield({.temperature = 300}); }, m.strength);
  const double c = longitudinal_speed(m);
  return yield > 0 ? std::max(yield / (density(m) * c), 0.1 * fluid) : fluid;
}

template <int Dim>
bool holds_surface(const State<Dim>& state, int slot) {
  return std::any_of(state.bodies.begin(), state.bodies.end(), [&](const Body<Dim>& body) {
    return !body.rigid && body.present(slot) && body.at(slot).near_surface;
  });
}

/// A box in cells of a level, in cells of the finest.
template <int Dim>
Box<Dim> to_finest(Box<Dim> box, int level) {
  for (int d = 0; d < Dim; ++d) box.lo[d] *= 1 << level, box.hi[d] *= 1 << level;
  return box;
}

template <int Dim>
void extend(Box<Dim>& box, const Box<Dim>& more) {
  if (more.size() == 0) return;
  Index<Dim> last = more.hi;
  for (int d = 0; d < Dim; ++d) --last[d];
  extend(box, more.lo), extend(box, last);
}

/// The cells of a finest block at which irregular kernels may work: near the surface, or not full.
template <int Dim>
Box<Dim> cells_at_surface(const State<Dim>& state, int slot) {
  Box<Dim> box{};
  const Grid<Dim>& grid = state.grid();
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = grid.layout();
  for (const Body<Dim>& body : state.bodies) {
    if (body.rigid || !body.present(slot) || !body.at(slot).near_surface) continue;
    const BodyBlock<Dim>& b = body.at(slot);
    for_each(cells, [&](const Index<Dim>& i) {
      const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
      const double full = grid.full_volume(i), v = b.volume[k];
      const bool partial = v != 0 && std::abs(v - full) > 1e-12 * full;
      if (partial || std::abs(b.phi[k]) < at_surface * grid.dx) extend(box, i);
    });
  }
  return box;
}

/// The cells around a block's surfaces that must be the finest: as far as irregular kernels read, where
/// blocks are wider than that; else all blocks around.
template <int Dim>
Box<Dim> finest_around_surface(const State<Dim>& state, int slot) {
  if (!holds_surface(state, slot)) return {};
  const Grid<Dim>& grid = state.grid();
  bool wide = state.mesh.block(slot).level == 0;
  for (int d = 0; d < Dim; ++d)
    wide = wide && (grid.block[d] >= around_surface || grid.cells[d] <= grid.block[d]);
  if (!wide) return finest_cells(state.mesh, slot).grown(1);
  const Box<Dim> box = cells_at_surface(state, slot);
  return box.size() > 0 ? box.grown(around_surface) : box;
}

template <int Dim>
bool holds_damage(const State<Dim>& state, int slot) {
  return std::any_of(state.bodies.begin(), state.bodies.end(), [&](const Body<Dim>& body) {
    if (body.rigid || !body.present(slot) || !can_fail(body.material.damage)) return false;
    const BodyBlock<Dim>& b = body.at(slot);
    const std::size_t n = b.volume.size();
    for (std::size_t k = 0; k < n; ++k)
      if (b.contents[Components<Dim>::damage * n + k] > damaged * b.contents[k]) return true;
    return false;
  });
}

/// The largest second difference of three cells in a row in a block, of the yield velocity: of velocities, or
/// of densities as a wave of that velocity would bring it. Grows `where` to hold the cells in which it is
/// above `bound`.
template <int Dim>
double largest_bend(const State<Dim>& state, const Body<Dim>& body, int slot, double bound, Box<Dim>& where) {
  using C = Components<Dim>;
  const BodyBlock<Dim>& b = body.at(slot);
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = state.grid().layout();
  const std::size_t n = b.volume.size();
  const double per_velocity = 1 / yield_velocity(body.material);
  const double per_density = bulk_sound_speed(body.material) * per_velocity;
  double most = 0;
  for (int d = 0; d < Dim; ++d) {
    Box<Dim> middle = cells;
    ++middle.lo[d], --middle.hi[d];
    if (middle.extent(d) <= 0) continue;
    const auto step = static_cast<std::size_t>(layout.stride(d));
    for_each(middle, [&](const Index<Dim>& i) {
      const auto k = static_cast<std::size_t>(layout.at(i - cells.lo)), low = k - step, high = k + step;
      const double *q = b.contents.data(), *v = b.volume.data();
      if (!(q[low] > 0 && q[k] > 0 && q[high] > 0)) return;
      double bend =
          std::abs(q[low] / v[low] + q[high] / v[high] - 2 * q[k] / v[k]) * v[k] / q[k] * per_density;
      for (std::size_t e = 0; e < Dim; ++e) {
        const double* u = q + (C::u + e) * n;
        bend = std::max(bend, std::abs(u[low] / q[low] + u[high] / q[high] - 2 * u[k] / q[k]) * per_velocity);
      }
      most = std::max(most, bend);
      if (bend > bound) extend(where, i);
    });
  }
  return most;
}

template <int Dim>
bool meets(const Grid<Dim>& grid, const Box<Dim>& cells, const typename Refinement<Dim>::Region& region) {
  for (int d = 0; d < Dim; ++d)
    if (grid.origin[d] + cells.hi[d] * grid.dx <= region.lo[d] ||
        grid.origin[d] + cells.lo[d] * grid.dx >= region.hi[d])
      return false;
  return true;
}

}  // namespace

template <int Dim>
Box<Dim> finest_cells(const Mesh<Dim>& mesh, int slot) {
  return to_finest(mesh.block(slot).cells, mesh.block(slot).level);
}

template <int Dim>
bool have_common_cells(const Grid<Dim>& grid, const Box<Dim>& a, const Box<Dim>& b) {
  if (a.size() <= 0 || b.size() <= 0) return false;
  for (int d = 0; d < Dim; ++d) {
    const int period = grid.periodic(d) ? grid.cells[d] : 0;
    const auto meet = [&](int by) { return a.lo[d] + by < b.hi[d] && b.lo[d] < a.hi[d] + by; };
    if (!meet(0) && !meet(-period) && !meet(period)) return false;
  }
  return true;
}

template <int Dim>
Need<Dim> need_of(const State<Dim>& state, int slot, const Refinement<Dim>& rules) {
  const int level = state.mesh.block(slot).level;
  const Box<Dim> cells = state.mesh.block(slot).cells;
  Need<Dim> need{Asks::nothing, finest_around_surface(state, slot)};
  if (holds_damage(state, slot)) {
    extend(need.finest, finest_cells(state.mesh, slot).grown(1));
    need.level = Asks::finest;
  }
  if (holds_surface(state, slot)) need.level = Asks::finest;
  for (const auto& region : rules.regions)
    if (meets(state.grid(slot), cells, region)) need.level = Asks::finest;
  double bend = 0;
  Box<Dim> where{};
  for (const Body<Dim>& body : state.bodies)
    if (!body.rigid && body.present(slot))
      bend = std::max(bend, largest_bend(state, body, slot, rules.bend, where));
  if (bend > rules.bend) {
    need.level = Asks::finest;
    extend(need.finest, to_finest(where.grown(ahead_of_waves), level));
  } else if (bend > hold * rules.bend && need.level == Asks::nothing) {
    need.level = Asks::keep;
  }
  return need;
}

template <int Dim>
bool lacks_finest(const State<Dim>& state, int slot) {
  if (!holds_surface(state, slot)) return false;
  if (state.mesh.block(slot).level > 0) return true;
  bool beside = false;
  state.mesh.for_each_adjacent(slot, [&](int s) { beside = beside || state.mesh.block(s).level > 0; });
  if (!beside) return false;
  const Box<Dim> around = finest_around_surface(state, slot);
  bool lacks = false;
  state.mesh.for_each_adjacent(slot, [&](int s) {
    lacks = lacks || (state.mesh.block(s).level > 0 &&
                      have_common_cells(state.grid(), around, finest_cells(state.mesh, s)));
  });
  return lacks;
}

#define RECOIL_INSTANTIATE(Dim)                                                             \
  template Need<Dim> need_of<Dim>(const State<Dim>&, int, const Refinement<Dim>&);          \
  template bool have_common_cells<Dim>(const Grid<Dim>&, const Box<Dim>&, const Box<Dim>&); \
  template Box<Dim> finest_cells<Dim>(const Mesh<Dim>&, int);                               \
  template bool lacks_finest<Dim>(const State<Dim>&, int);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
