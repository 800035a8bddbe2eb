#include "interface/values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

#include "dynamics/block_work.hpp"
#include "dynamics/primitives.hpp"
#include "interface/nearest_wall.hpp"
#include "interface/surface_state.hpp"
#include "material/eos/isentrope.hpp"
#include "mesh/open_edge.hpp"

namespace recoil {

using detail::face_reach;

namespace {

// Of the density at the surface: how far the linear response takes that of a ghost; beyond, it follows the
// isentrope. Behind a shock of 60 GPa in aluminium the way to zero stress is a quarter of the density.
constexpr double deepest_rarefaction = 0.4, highest_compression = 0.3;
constexpr double deepest_pull = 0.25;  // of the bulk modulus: the largest tension of a ghost
constexpr double rounding = 1e-9;      // of the density: a smaller cut is rounding, and not counted

double minmod(double a, double b) { return a * b <= 0 ? 0 : std::abs(a) < std::abs(b) ? a : b; }

template <int Dim>
void store(BodyBlock<Dim>& b, std::size_t n, int cell, const Primitives<Dim>& w) {
  for (std::size_t c = 0; c < w.size(); ++c) b.stencil[c * n + static_cast<std::size_t>(cell)] = w[c];
}

template <int Dim>
double sound_squared(const Material& m, double rho, double p, double crushed) {
  return std::visit(
      [&](const auto& eos) {
        const auto& matter = frozen(eos, crushed);
        return std::max(matter.sound_speed_squared(rho, p), least_wall_sound_squared(matter));
      },
      m.eos);
}

/// Adds to velocity and deviator of w: du along the normal, and so on. normal_stress: change of S_nn; shear:
/// change of the shear traction; rest: change of the tangential block, as a full matrix.
template <int Dim>
struct Change {
  double normal_velocity = 0, normal_deviator = 0;
  Vec<Dim> sliding, shear;
  std::array<Vec<Dim>, Dim> tangential{};
};

template <int Dim>
void apply(Primitives<Dim>& w, const Change<Dim>& x, const Vec<Dim>& n) {
  using C = Components<Dim>;
  for (int i = 0; i < Dim; ++i) {
    w[C::u + i] += x.normal_velocity * n[i] + x.sliding[i];
    for (int j = i; j < Dim; ++j) {
      const int c = C::stress(i, j);
      if (c >= 0)
        w[C::s + c] +=
            x.normal_deviator * n[i] * n[j] + x.shear[i] * n[j] + n[i] * x.shear[j] + x.tangential[i][j];
    }
  }
}

/// The tangential block of a deviator: S - S_nn n n - (t n + n t).
template <int Dim>
std::array<Vec<Dim>, Dim> tangential_block(const Primitives<Dim>& w, const SurfaceState<Dim>& s,
                                           const Vec<Dim>& n) {
  using C = Components<Dim>;
  std::array<Vec<Dim>, Dim> m{};
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) {
      const int c = C::stress(i, j);
      const double sij = c >= 0 ? w[C::s + c] : -(w[C::s] + w[C::s + 1]);
      m[i][j] = sij - s.deviator * n[i] * n[j] - s.shear[i] * n[j] - n[i] * s.shear[j];
    }
  return m;
}

/// The slope of all primitives along a direction, per metre, as a set of primitives.
template <int Dim>
Primitives<Dim> slope_along(const Wall<Dim>& wall, const Vec<Dim>& n, double dx) {
  Primitives<Dim> g{};
  for (std::size_t c = 0; c < g.size(); ++c) g[c] = dot(wall.gradient[c], n) / dx;
  return g;
}

/// The density at pressure p [Pa] of matter of density rho at p0: by linear response as far as that is small,
/// then on the isentrope.
struct MovedDensity {
  double rho = 0;  // kg/m3
  bool clamped = false;
};
MovedDensity density_at(const Material& material, double rho, double p0, double crushed, double c2,
                        double p) {
  const double change = (p - p0) / c2,
               kept = std::clamp(change, -deepest_rarefaction * rho, highest_compression * rho);
  if (std::abs(kept - change) <= rounding * rho) return {rho + kept, false};
  // Thin matter that is no gas has voids, which close before it is compressed.
  if (change > 0 && rho < density(material) && !is_fluid(material.eos)) return {rho + kept, true};
  const IsentropePoint far = follow_isentrope(material.eos, rho, p0, crushed, p);
  return {far.rho, !far.reached};
}

/// Moves the average of a regular cut cell from its centroid to the cell's centre. It stays where matter
/// could not follow, and that is counted: vapour of 20 kg/m3 would end below zero.
template <int Dim>
Primitives<Dim> centred(const Grid<Dim>& grid, const Material& material, const CutCell<Dim>& cut,
                        const Wall<Dim>& wall, const Index<Dim>& i, const Primitives<Dim>& average,
                        Counters& counters) {
  using C = Components<Dim>;
  Primitives<Dim> w = average;
  const Vec<Dim>& n = wall.normal;
  const auto here = resolve<Dim>(w, n);
  const auto fit = resolve<Dim>(wall.value, n);
  const Primitives<Dim> slope = slope_along(wall, n, grid.dx);
  const auto g = resolve<Dim>(slope, n);
  const double to_centre = -dot(cut.centroid, n) * grid.dx;
  const double to_wall = std::max(dot(cut.point - grid.centre(i), n) + to_centre, 0.25 * grid.dx);
  const double wall_normal = dot(wall.face_velocity, n);
  const Vec<Dim> wall_sliding = wall.face_velocity - wall_normal * n;
  const auto limited = [&](double fitted, double at_wall, double own) {
    return minmod(fitted, (at_wall - own) / to_wall) * to_centre;
  };
  Change<Dim> x;
  const double stress = limited(2 * g.stress, wall.traction, here.stress);
  x.normal_velocity = limited(2 * g.velocity, wall_normal, here.velocity);
  x.normal_deviator = limited(g.deviator, fit.deviator, here.deviator);
  const auto block = tangential_block(w, here, n), fitted = tangential_block(wall.value, fit, n),
             slopes = tangential_block(slope, g, n);
  for (int d = 0; d < Dim; ++d) {
    const auto e = static_cast<std::size_t>(d);
    x.shear[d] = limited(g.shear[d], wall.shear[d], here.shear[d]);
    x.sliding[d] = limited(g.sliding[d], wall_sliding[d], here.sliding[d]);
    for (int f = 0; f < Dim; ++f) x.tangential[e][f] = limited(slopes[e][f], fitted[e][f], block[e][f]);
  }
  const double p0 = w[C::p], p = here.deviator + x.normal_deviator - (here.stress + stress);
  const double c2 = sound_squared<Dim>(material, w[C::rho], p0, w[C::crushed]);
  const MovedDensity moved = density_at(material, w[C::rho], p0, w[C::crushed], c2, p);
  if (moved.clamped) {
    ++counters.clamped_ghost_densities;
    return average;
  }
  w[C::rho] = moved.rho;
  w[C::p] = p;
  apply(w, x, n);
  const Vec<Dim> along = dot(cut.centroid, n) * n - cut.centroid;
  const double most = wall.velocity_range();
  for (int d = 0; d < Dim; ++d) w[C::u + d] += std::clamp(dot(wall.gradient[C::u + d], along), -most, most);
  return w;
}

/// Largest change of normal stress and of velocity that a ghost may show: what the donors of the fit differ
/// by.
template <int Dim>
double stress_range(const Wall<Dim>& wall) {
  using C = Components<Dim>;
  double largest = 0;
  for (int d = 0; d < Dim; ++d) {
    const int c = C::stress(d, d);
    largest = std::max(largest, wall.range[c >= 0 ? C::s + c : C::extra]);
  }
  return wall.range[C::p] + 1.5 * largest;
}

/// The state of a ghost along the normal.
struct NormalState {
  double rho = 0, p = 0, velocity = 0;  // kg/m3, Pa, m/s
  bool clamped = false;
};

/// Matter that is no gas follows its surface's linear response. Its stress goes on beyond the wall as far as
/// the matter bears: a line through a strong shock would end in a tension of half the shock, at which nothing
/// has a density. @param stress of the ghost [Pa]
template <int Dim>
NormalState linear_state(const Material& material, const Primitives<Dim>& v, const SurfaceState<Dim>& s,
                         double traction, double stress) {
  using C = Components<Dim>;
  const double rho = v[C::rho], c2 = sound_squared<Dim>(material, rho, v[C::p], v[C::crushed]);
  // What the density may still fall by at the stress of the wall.
  const double left = deepest_rarefaction - (v[C::p] - s.deviator + traction) / (rho * c2);
  const double pull = rho * c2 * std::clamp(left, 0.0, deepest_pull);
  const double p = s.deviator - std::min(stress, traction + pull);
  const double velocity = s.velocity - s.stress / s.impedance + traction / s.impedance;
  const MovedDensity moved = density_at(material, rho, v[C::p], v[C::crushed], c2, p);
  return {moved.rho, p, velocity, moved.clamped};
}

/// A gas follows the isentrope through the state of its surface: to the wall's pressure, and from there by
/// the slope that the matter behind has, but down by no more than a part of its bulk modulus: a gas cannot
/// pull.
template <int Dim>
std::optional<NormalState> gas_state(const Material& material, const Primitives<Dim>& v,
                                     const SurfaceState<Dim>& s, double traction, double stress) {
  using C = Components<Dim>;
  const auto at_wall = gas_isentrope(material.eos, v[C::rho], v[C::p], -traction);
  if (!at_wall) return std::nullopt;
  const double modulus =
      at_wall->rho * sound_speed_squared(material.eos, at_wall->rho, at_wall->p, v[C::crushed]);
  const double change = std::max(traction - stress, -deepest_pull * modulus);
  const auto ghost = gas_isentrope(material.eos, v[C::rho], v[C::p], at_wall->p + change);
  if (!ghost) return std::nullopt;
  return NormalState{ghost->rho, ghost->p, s.velocity + at_wall->speed, !ghost->reached};
}

template <int Dim>
Primitives<Dim> ghost_value(const Grid<Dim>& grid, const Material& material, const Wall<Dim>& wall,
                            const GhostCell<Dim>& ghost, Counters& counters) {
  using C = Components<Dim>;
  const Vec<Dim>& n = ghost.normal;
  Primitives<Dim> v = continued_value(wall, ghost.from_wall, ghost.flips, grid.dx);
  const auto s = surface_state(material, v, n);
  const Vec<Dim> own = flipped(n, ghost.flips);
  const auto g = resolve<Dim>(slope_along(wall, own, grid.dx), own);
  const double most_u = wall.velocity_range(), most_s = stress_range(wall);
  // Beyond a corner that touches another body the gradients do not go on: what a ghost adds there to the
  // cells between the two surfaces would grow from step to step (docs/decisions/0076).
  const double along_normal = (1 - wall.corner) * ghost.distance;
  const double du = wall.partners != 0 ? std::clamp(g.velocity * along_normal, -most_u, most_u) : 0;
  const double stress = wall.traction + std::clamp(g.stress * along_normal, -most_s, most_s);
  const auto gas = gas_state(material, v, s, wall.traction, stress);
  const NormalState normal = gas ? *gas : linear_state<Dim>(material, v, s, wall.traction, stress);
  // Beyond the free surface of products is nothing, and no density that theirs would have to reach.
  const bool into_nothing = wall.partners == 0 && std::holds_alternative<Jwl>(material.eos);
  if (normal.clamped && !into_nothing) ++counters.clamped_ghost_densities;
  v[C::rho] = normal.rho;
  v[C::p] = normal.p;
  Change<Dim> x;
  x.normal_velocity = normal.velocity + du - s.velocity;
  Vec<Dim> held = flipped(wall.shear, ghost.flips);  // by friction, in the frame of the ghost
  held -= dot(held, n) * n;
  x.shear = held - s.shear;
  if (s.shear_impedance > 0) x.sliding = x.shear * (1 / s.shear_impedance);
  // A surface without shear traction still turns: a constant tangential velocity would brake a spinning body.
  // Its shear stress goes on through zero: constant, it would give reconstructions a kink.
  for (int d = 0; d < Dim; ++d) {
    const double same = own[d] == n[d] ? 1 : -1;
    x.sliding[d] += same * std::clamp(g.sliding[d] * ghost.distance, -most_u, most_u);
    x.shear[d] += same * std::clamp(g.shear[d] * ghost.distance, -most_s, most_s);
  }
  apply(v, x, n);
  return v;
}

}  // namespace

template <int Dim>
void fill_stencil_values(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters) {
  BodyBlock<Dim>& b = body.at(slot);
  b.stencil.swap(b.average);
  if (!b.near_surface) return;
  const Grid<Dim>& grid = state.grid();
  const Box<Dim> layout = grid.layout();
  const Index<Dim> lo = state.mesh.block(slot).cells.lo;
  const auto n = static_cast<std::size_t>(layout.size());
  for (std::size_t m = 0; m < b.walls.size(); ++m) {
    const CutCell<Dim>& cut = b.geometry.cuts[m];
    const auto k = static_cast<std::size_t>(cut.cell);
    double off = 0;
    for (int d = 0; d < Dim; ++d) off += std::abs(cut.centroid[d]);
    if ((b.role[k] & regular) == 0 || b.walls[m].donors == 0 || off < 1e-4) continue;
    Primitives<Dim> w{};
    for (std::size_t c = 0; c < w.size(); ++c) w[c] = b.stencil[c * n + k];
    store(b, n, cut.cell,
          centred(grid, body.material, cut, b.walls[m], lo + layout.index(cut.cell), w, counters));
  }
  for (const GhostCell<Dim>& ghost : b.ghosts) {
    std::uint8_t& role = b.role[ghost.cell];
    if (ghost.slot < 0) {
      // A crack that the geometry does not show: what is beside it is itself the nearest matter.
      if ((role & donates) != 0)
        role |= valued;
      else if (!near_open_edge(grid, lo + layout.index(ghost.cell), face_reach))  // judged by its faces there
        ++counters.ghosts_without_wall;
      continue;
    }
    const Wall<Dim>& wall = body.at(ghost.slot).walls[ghost.wall];
    store(b, n, ghost.cell, ghost_value(grid, body.material, wall, ghost, counters));
    role |= valued;
  }
}

#define RECOIL_INSTANTIATE(Dim) \
  template void fill_stencil_values<Dim>(const State<Dim>&, Body<Dim>&, int, Counters&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
