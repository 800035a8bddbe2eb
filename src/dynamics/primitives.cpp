#include "dynamics/primitives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/multiversion.hpp"
#include "dynamics/failed_matter.hpp"
#include "dynamics/stiffness/shear_modulus.hpp"
#include "material/eos/isentrope.hpp"
#include "state/places.hpp"
#include "state/state_error.hpp"

namespace recoil {

namespace {

// A donor is averaged where it fills more than this part of a cell and its density lies between these
// multiples of the ends of the DensityRange (of the stages of a step only: at its start the donor's fill has
// been judged).
constexpr double least_averaged = 0.1, thinnest_averaged = 0.4, densest_averaged = 1.2;
// The mean of Runge and Kutta of a fragment that has lost more than this part of its volume in the step is
// one of an old volume and a negative one: it lies outside of the two states.
constexpr double least_of_old = 0.75;
constexpr double thinnest_used = 0.4;  // likewise: a fragment below it is of no use to fits and stencils
constexpr double near_front =
    1.5;                          // [cells] from a surface of gas, where it may soon run at its escape speed
constexpr double near_rigid = 3;  // [cells] from a rigid body, which may soon carry matter along

/// What phi is at most [m] in cells that a block without a surface near may hold. All there have a value, and
/// so have these in other blocks: the block beside would not know that one has none, and their fluxes through
/// the face between them would differ.
template <int Dim>
double within(const Grid<Dim>& grid) {
  return -far_cells * grid.dx;
}

template <int Dim>
std::vector<double> point_of(const State<Dim>& state, int slot, const Index<Dim>& local) {
  const Vec<Dim> x = state.grid(slot).centre(state.mesh.block(slot).cells.lo + local);
  return {x.c.begin(), x.c.end()};
}

template <int Dim>
std::string place_of(const State<Dim>& state, int slot, const Index<Dim>& local) {
  const Vec<Dim> x = state.grid(slot).centre(state.mesh.block(slot).cells.lo + local);
  std::string text;
  for (int d = 0; d < Dim; ++d) text += fmt::format("{}{:.6g}", d ? ", " : "", x[d] * 1e3);
  return "(" + text + ") mm";
}

/// Stops the run: a fragment is denser than its equation of state admits, or its density is below -rho0. So
/// far below zero it would grow in the averages over the cells around, until no sum over the body is exact.
template <int Dim>
[[noreturn]] void refuse_density(const State<Dim>& state, const Body<Dim>& body, int slot,
                                 const Index<Dim>& local, std::size_t k) {
  const BodyBlock<Dim>& b = body.at(slot);
  const Contents<Dim> q = contents_of(b, static_cast<int>(k));
  const double mass = q[Components<Dim>::rho], rho = mass / b.volume[k];
  double kinetic = 0;
  std::string velocity;
  for (std::size_t d = 0; d < Dim; ++d) {
    const double u = q[Components<Dim>::u + d] / mass;
    kinetic += 0.5 * u * u;
    velocity += fmt::format("{}{:.6g}", d > 0 ? ", " : "", u);
  }
  throw StateError(
      body.name, point_of(state, slot, local),
      fmt::format("{} has a density beyond its equation of state at {}, {:.6g} us: {:.6g} kg/m3, the largest "
                  "is {:.6g}, and none is below 0; "
                  "velocity ({}) m/s, internal energy {:.6g} J/kg, {:.3g} of a cell",
                  body.name, place_of(state, slot, local), state.time * 1e6, rho,
                  largest_density(body.material.eos), velocity, q[Components<Dim>::energy] / mass - kinetic,
                  b.volume[k] / state.grid(slot).full_volume(state.mesh.block(slot).cells.lo + local)));
}

template <int Dim>
[[noreturn]] void refuse_state(const State<Dim>& state, const Body<Dim>& body, int slot,
                               const Index<Dim>& local, double rho, double p) {
  throw StateError(body.name, point_of(state, slot, local),
                   fmt::format("{} has no admissible state at {}: density {:.6g} kg/m3, pressure {:.6g} GPa",
                               body.name, place_of(state, slot, local), rho, p * 1e-9));
}

/// One row of cells, all of them donors: the loop that interior blocks run.
template <int Dim, class EosModel>
RECOIL_MULTIVERSION void row_primitives(const EosModel& eos, std::size_t first, std::size_t count,
                                        std::size_t n, const double* q, const double* volume, double* w) {
  using C = Components<Dim>;
#pragma GCC ivdep
  for (std::size_t k = first; k < first + count; ++k) {
    const double mass = q[k], per_mass = 1 / mass, rho = mass / volume[k];
    double kinetic = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      const double u = q[(C::u + d) * n + k] * per_mass;
      w[(C::u + d) * n + k] = u;
      kinetic += 0.5 * u * u;
    }
    const double e = q[C::energy * n + k] * per_mass - kinetic;
    const auto& matter = frozen(eos, q[C::crushed * n + k] * per_mass);
    const double p = matter.pressure(rho, e);
    w[C::rho * n + k] = rho;
    w[C::p * n + k] = p;
    for (std::size_t c = C::s; c < C::contents; ++c) w[c * n + k] = q[c * n + k] * per_mass;
    if constexpr (EosModel::barotropic) w[C::extra * n + k] = e - matter.energy(rho, p);
  }
}

/// What is to be done with the average of a cell.
enum class Averaged : std::uint8_t { no, yes, kept };

/// What a donor is averaged by: its volume is above `least` (by column) and above `of_old` times that at the
/// start of the step, its density lies between `thinnest` and `densest` [kg/m3]. Any density that is a
/// number will do where phi [m] is at most `within`, as in blocks that no surface is near.
struct AveragedRow {
  const std::uint8_t* role;
  const double *volume, *volume_old, *mass, *phi, *least;
  double of_old, thinnest, densest, within;
};

/// Says it of a row of cells. The row is a copy, so that the compiler knows that it stays as it is.
RECOIL_MULTIVERSION void find_averaged(AveragedRow row, int count, Averaged* to) {
#pragma GCC ivdep
  for (int c = 0; c < count; ++c) {
    const double volume = row.volume[c], rho = row.mass[c] / volume;
    const bool donor = (row.role[c] & donates) != 0,
               good = (volume > row.of_old * row.volume_old[c]) & (volume > row.least[c]) &
                      (rho > row.thinnest) & (rho < row.densest),
               deep = (row.phi[c] <= row.within) & (rho == rho);
    to[c] = !donor ? Averaged::no : good | deep ? Averaged::yes : Averaged::kept;
  }
}

/// Runs of good donors, which go through the same loop as whole rows.
template <int Dim, class EosModel>
void average_donors(const State<Dim>& state, const EosModel& eos, Body<Dim>& body, int slot,
                    Counters& counters, AveragesOf what) {
  BodyBlock<Dim>& b = body.at(slot);
  const bool is_mean = what == AveragesOf::mean;
  const bool old_is_kept = what != AveragesOf::start && !b.contents_old.empty();
  const Grid<Dim>& grid = state.grid(slot);
  const Index<Dim> lo = state.mesh.block(slot).cells.lo;
  const Box<Dim> layout = grid.layout();
  const DensityRange range = density_range(eos);
  const double thinnest = can_fail(body.material.damage) ? thinnest_failed : thinnest_averaged * range.least;
  Box<Dim> rows = b.reach;
  const int width = rows.extent(0);
  rows.hi[0] = std::min(rows.hi[0], rows.lo[0] + 1);
  std::array<double, Window<Dim>::longest> least;
  Index<Dim> column = rows.lo;
  for (int c = 0; c < width; ++c, ++column[0])
    least[static_cast<std::size_t>(c)] = least_averaged * grid.full_volume(column);
  std::array<Averaged, Window<Dim>::longest> averaged;
  for_each(rows, [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(layout.at(i - lo));
    const double* volume = b.volume.data() + k;
    find_averaged({b.role.data() + k, volume, is_mean ? b.volume_old.data() + k : volume,
                   b.contents.data() + k, b.phi.data() + k, least.data(), is_mean ? least_of_old : 0.0,
                   thinnest * eos.rho0, densest_averaged * range.most * eos.rho0, within(grid)},
                  width, averaged.data());
    for (int c = 0; c < width; ++c) {
      const auto is = [&](int at, Averaged how) { return averaged[static_cast<std::size_t>(at)] == how; };
      if (is(c, Averaged::no)) continue;
      if (is(c, Averaged::yes)) {
        const int first = c;
        while (c + 1 < width && is(c + 1, Averaged::yes)) ++c;
        row_primitives<Dim>(eos, k + static_cast<std::size_t>(first), static_cast<std::size_t>(c + 1 - first),
                            b.volume.size(), b.contents.data(), b.volume.data(), b.average.data());
        continue;
      }
      Index<Dim> at = i;
      at[0] += c;
      const bool left = !is_mean || volume[c] > least_of_old * b.volume_old[k + static_cast<std::size_t>(c)];
      if (!std::isfinite(b.contents[k + static_cast<std::size_t>(c)] / volume[c]))
        throw StateError(
            body.name, point_of(state, slot, at - lo),
            "the density of " + body.name + " is not a number at " + place_of(state, slot, at - lo));
      if (left && volume[c] > least[static_cast<std::size_t>(c)]) ++counters.averages_kept;
      // Its average is that at the start of the step: what `average` holds by now are stencil values.
      if (old_is_kept)
        row_primitives<Dim>(eos, k + static_cast<std::size_t>(c), 1, b.volume.size(), b.contents_old.data(),
                            b.volume_old.data(), b.average.data());
    }
  });
}

template <int Dim, class EosModel>
void average_block(const State<Dim>& state, const EosModel& eos, Body<Dim>& body, int slot,
                   Counters& counters, AveragesOf what) {
  BodyBlock<Dim>& b = body.at(slot);
  if (b.near_surface) {
    average_donors(state, eos, body, slot, counters, what);
    return;
  }
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = state.grid(slot).layout();
  Box<Dim> rows = cells;
  rows.hi[0] = rows.lo[0] + 1;
  for_each(rows, [&](const Index<Dim>& i) {
    row_primitives<Dim>(eos, static_cast<std::size_t>(layout.at(i - cells.lo)),
                        static_cast<std::size_t>(cells.extent(0)), static_cast<std::size_t>(layout.size()),
                        b.contents.data(), b.volume.data(), b.average.data());
  });
}

}  // namespace

template <int Dim>
void choose_roles(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters) {
  BodyBlock<Dim>& b = body.at(slot);
  const double rho0 = density(body.material);
  const bool fails = can_fail(body.material.damage);
  const double densest = largest_density(body.material.eos);
  const double thinnest = thinnest_used * density_range(body.material.eos).least;
  const Grid<Dim>& grid = state.grid(slot);
  const Box<Dim> layout = grid.layout();
  const Index<Dim> lo = state.mesh.block(slot).cells.lo;
  std::fill(b.role.begin(), b.role.end(), std::uint8_t{0});
  for_each(b.reach, [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(layout.at(i - lo));
    const double fill = b.volume[k] / grid.full_volume(i);
    std::uint8_t role = 0;
    if (fill > donor_fill) role |= donates;
    if (fill >= regular_fill) role |= regular | valued;
    const double rho = role != 0 ? b.contents[k] / b.volume[k] : rho0;
    if (fill >= regular_fill && !(rho < densest && rho > -rho0)) refuse_density(state, body, slot, i - lo, k);
    if (role != 0 && b.phi[k] > within(grid) &&
        !(rho > (fails && has_failed(b, k) ? thinnest_failed : thinnest) * rho0)) {
      ++counters.fragments_too_thin;
      role = 0;
    }
    b.role[k] = role;
  });
}

template <int Dim>
void average_primitives(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters,
                        AveragesOf what) {
  BodyBlock<Dim>& b = body.at(slot);
  if (b.average.empty()) b.average.swap(b.stencil);  // which are over: they share their memory
  std::visit([&](const auto& eos) { average_block(state, eos, body, slot, counters, what); },
             body.material.eos);
  if (can_fail(body.material.damage)) relieve_averages(state, body, slot);
}

/// Twice the largest speed of the surfaces of a gas in the last step [m/s]. Into a void they run ahead of all
/// signals within, and faster in each step.
template <int Dim>
double gas_surface_speed(const BodyBlock<Dim>& b) {
  const std::size_t n = b.volume.size();
  double most2 = 0;
  for (std::size_t k = 0; b.near_surface && k < n; ++k) {
    double u2 = 0;
    for (std::size_t d = 0; d < Dim; ++d)
      u2 += b.extension_velocity[d * n + k] * b.extension_velocity[d * n + k];
    most2 = std::max(most2, u2);
  }
  return 2 * std::sqrt(most2);
}

/// The speed, sum over axes [m/s], to which a rigid body sweeps matter at x as soon as it touches it.
template <int Dim>
double swept_speed(const State<Dim>& state, const Vec<Dim>& x) {
  double fastest = 0;
  for (const Body<Dim>& body : state.bodies) {
    if (!body.rigid || never_moves(*body.rigid)) continue;
    const RigidPose<Dim> now{body.rigid->centre, body.rigid->turn};
    if (distance_at(*body.rigid, now, x) > near_rigid * state.grid().dx) continue;
    const Vec<Dim> u = velocity_at(*body.rigid, x);
    double sum = 0;
    for (int d = 0; d < Dim; ++d) sum += std::abs(u[d]);
    fastest = std::max(fastest, sum);
  }
  return fastest;
}

/// Averages of a row of cells, the first one's at `average` (components n apart).
struct SignalRow {
  const std::uint8_t* role;
  const double* average;
  std::size_t n;
};

/// The fastest signal of a row of solid matter, sum over axes [m/s]: what its regular cells have, or
/// `fastest` if that is more. @returns whether no cell has to be looked at by itself; if one has, `fastest`
/// stays. The row is a copy, so that the compiler knows that it stays as it is.
template <int Dim, class EosModel>
RECOIL_MULTIVERSION [[gnu::flatten]] bool row_signal(const EosModel& eos, SignalRow row, int count, double g,
                                                     double sound, double least, double& fastest) {
  using C = Components<Dim>;
  double most = fastest;
  int odd = 0;
#pragma omp simd reduction(max : most) reduction(| : odd)
  for (int c = 0; c < count; ++c) {
    const double* w = row.average + c;
    const double rho = w[0],
                 c2 = frozen(eos, w[C::crushed * row.n]).sound_speed_squared(rho, w[C::p * row.n]),
                 wave2 = wave_speed_squared(frozen(eos, w[C::crushed * row.n]), rho, w[C::p * row.n]);
    double sum = 0;
    for (std::size_t d = 0; d < Dim; ++d) sum += std::abs(w[(C::u + d) * row.n]);
    const bool counts = (row.role[c] & regular) != 0,
               usual = std::isfinite(sum + c2) & (rho > 0) &
                       frozen(eos, w[C::crushed * row.n]).admissible(rho) & (c2 >= least);
    sum += sound * std::sqrt((wave2 > least ? wave2 : least) + 4 * g / (3 * rho));
    odd |= counts & !usual ? 1 : 0;
    most = counts & usual & (sum > most) ? sum : most;
  }
  if (odd == 0) fastest = most;
  return odd == 0;
}

/// by_row(place of its first cell, count) for all rows of cells of a block; where the answer is no,
/// f(cell, its place) for the cells of the row.
template <int Dim, class ByRow, class F>
void for_each_row_or_place(const State<Dim>& state, int slot, ByRow&& by_row, F&& f) {
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = state.grid(slot).layout();
  Box<Dim> rows = cells;
  const int width = rows.extent(0);
  rows.hi[0] = rows.lo[0] + 1;
  for_each(rows, [&](Index<Dim> i) {
    const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
    if (by_row(k, width)) return;
    for (int c = 0; c < width; ++c, ++i[0]) f(i, k + static_cast<std::size_t>(c));
  });
}

template <int Dim>
double fastest_signal(const State<Dim>& state, const Body<Dim>& body, int slot, double sound,
                      Counters& counters) {
  using C = Components<Dim>;
  const BodyBlock<Dim>& b = body.at(slot);
  const auto n = static_cast<std::size_t>(state.grid(slot).layout().size());
  const double g = shear_modulus(body.material);
  const bool fails = can_fail(body.material.damage);
  const bool follows = modulus_follows(body.material.strength);
  const auto modulus_in = [&](std::size_t k) {
    Primitives<Dim> w;
    for (std::size_t c = 0; c < w.size(); ++c) w[c] = b.average[c * n + k];
    return shear_modulus_of(body, w);
  };
  const bool beside_rigid = std::ranges::any_of(
      state.bodies, [](const Body<Dim>& other) { return other.rigid && !never_moves(*other.rigid); });
  const bool by_rows = !follows && !beside_rigid && !is_fluid(body.material.eos) && !(fails && has_voids(b));
  // Faces beside voids are solved by averages alone: in one stage without what half a step across them
  // changes, and no longer stable with its steps.
  const double sound_of_dust = std::max(sound, std::sqrt(static_cast<double>(Dim)));
  const Grid<Dim>& grid = state.grid(slot);
  double fastest = 0;
  std::visit(
      [&](const auto& eos) {
        const double least = least_sound_squared(eos);
        const auto look_at = [&](const Index<Dim>& i, std::size_t k) {
          if ((b.role[k] & regular) == 0) return;
          const double rho = b.average[k], p = b.average[C::p * n + k];
          const auto& matter = frozen(eos, b.average[C::crushed * n + k]);
          const double c2 = matter.sound_speed_squared(rho, p), wave2 = wave_speed_squared(matter, rho, p);
          double sum = 0;
          for (std::size_t d = 0; d < Dim; ++d) sum += std::abs(b.average[(C::u + d) * n + k]);
          const bool dust = fails && has_void(b, k);
          if (!std::isfinite(sum + c2) || !(rho > 0) || !(dust || matter.admissible(rho)))
            refuse_state(state, body, slot, i - state.mesh.block(slot).cells.lo, rho, p);
          if (c2 < least && !dust) ++counters.floored_sound_speeds;
          if (beside_rigid && b.phi[k] > -near_rigid * grid.dx)
            sum = std::max(sum, swept_speed(state, grid.centre(i)));
          const double shear = follows ? modulus_in(k) : g;
          const double still = sum;
          sum += (dust ? sound_of_dust : sound) * std::sqrt(std::max(wave2, least) + 4 * shear / (3 * rho));
          if (is_fluid(body.material.eos) && b.phi[k] > -near_front * grid.dx)
            if (const auto front = gas_isentrope(body.material.eos, rho, p, 0))
              sum = std::max(sum, still + front->speed);
          fastest = sum > fastest ? sum : fastest;
        };
        const auto look_at_row = [&](std::size_t k, int count) {
          return by_rows && row_signal<Dim>(eos, {b.role.data() + k, b.average.data() + k, n}, count, g,
                                            sound, least, fastest);
        };
        for_each_row_or_place(state, slot, look_at_row, look_at);
      },
      body.material.eos);
  if (is_fluid(body.material.eos)) fastest = std::max(fastest, gas_surface_speed(b));
  if (body.detonation) fastest = std::max(fastest, body.detonation->velocity);
  return fastest / state.grid(slot).dx;
}

#define RECOIL_INSTANTIATE(Dim)                                                                     \
  template void choose_roles<Dim>(const State<Dim>&, Body<Dim>&, int, Counters&);                   \
  template void average_primitives<Dim>(const State<Dim>&, Body<Dim>&, int, Counters&, AveragesOf); \
  template double fastest_signal<Dim>(const State<Dim>&, const Body<Dim>&, int, double, Counters&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
