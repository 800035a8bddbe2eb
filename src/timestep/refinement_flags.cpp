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
/// of densities as a wave of that velocity would bring it.
template <int Dim>
double largest_bend(const State<Dim>& state, const Body<Dim>& body, int slot) {
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
Asks asks_of(const State<Dim>& state, int slot, const Refinement<Dim>& rules) {
  if (holds_surface(state, slot) || holds_damage(state, slot)) return Asks::finest;
  const Box<Dim> cells = state.mesh.block(slot).cells;
  for (const auto& region : rules.regions)
    if (meets(state.grid(slot), cells, region)) return Asks::finest;
  double bend = 0;
  for (const Body<Dim>& body : state.bodies)
    if (!body.rigid && body.present(slot)) bend = std::max(bend, largest_bend(state, body, slot));
  return bend > rules.bend ? Asks::finest : bend > hold * rules.bend ? Asks::keep : Asks::nothing;
}

template <int Dim>
bool lacks_finest(const State<Dim>& state, int slot) {
  if (!holds_surface(state, slot)) return false;
  bool lacks = state.mesh.block(slot).level > 0;
  state.mesh.for_each_adjacent(slot, [&](int s) { lacks = lacks || state.mesh.block(s).level > 0; });
  return lacks;
}

#define RECOIL_INSTANTIATE(Dim)                                               \
  template Asks asks_of<Dim>(const State<Dim>&, int, const Refinement<Dim>&); \
  template bool lacks_finest<Dim>(const State<Dim>&, int);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
