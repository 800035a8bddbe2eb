#include "levelset/distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/multiversion.hpp"
#include "state/level_set_view.hpp"

namespace recoil {

namespace {

constexpr double nearest_slowed = 2;  // [dx] from which on phi falls by `most_nearer` at most

constexpr double pseudo_step = 0.45;  // of the smallest distance used

double minmod(double a, double b) { return a * b <= 0 ? 0 : std::abs(a) < std::abs(b) ? a : b; }

/// Distance from a cell to the zero of the level set towards its neighbour, by a parabola; -1 where there is
/// none. Values: two before, the cell, the neighbour, one after.
double zero_towards(double before, double here, double there, double after, double h) {
  if (here * there > 0) return -1;
  const double curvature = minmod(before - 2 * here + there, here - 2 * there + after);
  const double least = 1e-9 * h;
  if (std::abs(curvature) > 1e-6 * h) {
    const double q = 0.5 * curvature - here - there;
    const double root = std::sqrt(std::max(0.0, q * q - 4 * here * there));
    const double s = h * (0.5 + (here - there - (here > there ? root : -root)) / curvature);
    if (s >= 0 && s <= h) return std::max(s, least);
  }
  const double drop = std::abs(here - there);
  return std::max(drop > 1e-300 ? h * here / (here - there) : 0.5 * h, least);
}

/// One-sided slope from the cell (value p[0]) to its neighbour st away, second order, with the zero at
/// distance `zero` where the surface lies between (zero > 0). sign +1: towards higher index.
double slope(const double* p, int st, double zero, double h, double& nearest) {
  const double here = p[st] - 2 * p[0] + p[-st], there = p[2 * st] - 2 * p[st] + p[0];
  const double curvature = minmod(here, there) / (h * h);
  if (zero > 0) {
    nearest = std::min(nearest, zero);
    return -p[0] / zero - 0.5 * zero * curvature;
  }
  return (p[st] - p[0]) / h - 0.5 * h * curvature;
}

template <int Dim>
using Strides = std::array<int, Dim>;

/// One relaxation towards |grad phi| = 1. `square`: of the upwind gradient.
[[gnu::always_inline]] inline double relaxed_by(double value, double square, double nearest) {
  const double sign = value > 0 ? 1 : -1;
  const double next = value - pseudo_step * nearest * sign * (std::sqrt(square) - 1);
  return next * sign <= 0 ? 0.5 * value : next;
}

/// Square of the upwind one of two one-sided slopes, seen from a cell outside (sign > 0) or inside.
[[gnu::always_inline]] inline double upwind_square(double sign, double low, double high) {
  const double a = sign > 0 ? std::max(low, 0.0) : std::min(low, 0.0);
  const double b = sign > 0 ? std::min(high, 0.0) : std::max(high, 0.0);
  return std::max(a * a, b * b);
}

/// A cell beside the surface, which stays where p0 has it.
template <int Dim>
double relaxed_beside(const double* p0, const double* p, const Strides<Dim>& stride, double h) {
  const double sign = p0[0] > 0 ? 1 : -1;
  double square = 0, nearest = h;
  for (const int st : stride) {
    const double up = zero_towards(p0[-st], p0[0], p0[st], p0[2 * st], h);
    const double down = zero_towards(p0[st], p0[0], p0[-st], p0[-2 * st], h);
    const double high = slope(p, st, up, h, nearest), low = -slope(p, -st, down, h, nearest);
    square += upwind_square(sign, low, high);
  }
  return relaxed_by(p[0], square, nearest);
}

/// A row of cells away from the surface: as relaxed_beside() where no neighbour has the other sign.
template <int Dim>
RECOIL_MULTIVERSION void relax_row(const double* p, const Strides<Dim>& stride, double h, int count,
                                   double* next) {
  const double per_h = 1 / h, half_per_h = 0.5 * per_h;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const double* q = p + i;
    const double sign = q[0] > 0 ? 1 : -1;
    double square = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      const int st = stride[d];
      const double here = q[st] - 2 * q[0] + q[-st], above = q[2 * st] - 2 * q[st] + q[0],
                   below = q[0] - 2 * q[-st] + q[-2 * st];
      const double high = (q[st] - q[0]) * per_h - half_per_h * minmod(here, above);
      const double low = (q[0] - q[-st]) * per_h + half_per_h * minmod(here, below);
      square += upwind_square(sign, low, high);
    }
    next[i] = relaxed_by(q[0], square, h);
  }
}

enum CellOfBand : std::uint8_t { kept, away, beside };

/// Says what becomes of a row of cells, `band` of which are nearer than that to the surface. @returns whether
/// any changes.
template <int Dim>
RECOIL_MULTIVERSION bool place_in_band(const double* p, const Strides<Dim>& stride, double frozen,
                                       double band, double beside_band, int count, std::uint8_t* place) {
  int any = 0;
#pragma omp simd reduction(| : any)
  for (int i = 0; i < count; ++i) {
    const double* q = p + i;
    const double distance = std::abs(q[0]);
    bool other_sign = false, inside = distance < band;
    for (std::size_t d = 0; d < Dim; ++d) {
      const double high = q[stride[d]], low = q[-stride[d]];
      other_sign = other_sign | (q[0] * high <= 0) | (q[0] * low <= 0);
      inside = inside | (std::abs(high) < beside_band) | (std::abs(low) < beside_band);
    }
    const bool stays = (q[0] == 0) | (distance < frozen) | !inside;
    place[i] = stays ? kept : other_sign ? beside : away;
    any |= stays ? 0 : 1;
  }
  return any != 0;
}

}  // namespace

template <int Dim>
Foot<Dim> foot_point(const Grid<Dim>& grid, const Box<Dim>& window, const double* phi, const Index<Dim>& i) {
  Foot<Dim> f;
  f.normal = phi_normal(window, phi, i, grid.dx);
  f.distance = phi[window.at(i)];
  f.point = grid.centre(i) - f.distance * f.normal;
  const double rest = interpolate(grid, window, phi, f.point);
  if (std::abs(rest) < 0.5 * grid.dx) {
    f.point -= rest * f.normal;
    f.distance += rest;
  }
  return f;
}

template <int Dim>
void redistance(const State<Dim>& state, Body<Dim>& body, int slot, int sweeps, double frozen,
                double most_nearer, Scratch& scratch) {
  const double h = state.grid().dx, far = far_cells * h;
  const Window<Dim> w(state.mesh, slot, 2 * sweeps);
  const auto n = static_cast<std::size_t>(w.size());
  double* p0 = view_level_set(state.grid(), body, w, &BodyBlock<Dim>::phi, scratch);
  Strides<Dim> stride{};
  for (int d = 0; d < Dim; ++d) stride[d] = w.stride(d);

  // The cells that change, and the box that holds them.
  auto* place = scratch.take<std::uint8_t>(n);
  Box<Dim> band, places = w.inner().grown(2 * (sweeps - 1));
  const int length = places.extent(0);
  places.hi[0] = std::min(places.hi[0], places.lo[0] + 1);
  for_each(places, [&](Index<Dim> i) {
    std::uint8_t* row = place + w.at(i);
    if (!place_in_band<Dim>(p0 + w.at(i), stride, frozen * h, far, far - 0.9 * h, length, row)) return;
    int first = 0, last = length - 1;
    while (row[first] == kept) ++first;
    while (row[last] == kept) --last;
    const int low = i[0];
    for (const int c : {first, last}) {
      i[0] = low + c;
      extend(band, i);
    }
  });

  double *p = scratch.take<double>(n), *next = scratch.take<double>(n);
  std::copy(p0, p0 + n, p);
  for (int sweep = 1; sweep <= sweeps && band.size() > 0; ++sweep) {
    Box<Dim> rows = w.inner().grown(2 * (sweeps - sweep));
    for (int d = 0; d < Dim; ++d) {
      rows.lo[d] = std::max(rows.lo[d], band.lo[d]);
      rows.hi[d] = std::max(rows.lo[d], std::min(rows.hi[d], band.hi[d]));
    }
    const int count = rows.extent(0);
    rows.hi[0] = std::min(rows.hi[0], rows.lo[0] + 1);
    for_each(rows, [&](const Index<Dim>& i) {
      const int k = w.at(i);
      relax_row<Dim>(p + k, stride, h, count, next + k);
      for (int c = k; c < k + count; ++c) {
        if (place[c] == beside) next[c] = relaxed_beside<Dim>(p0 + c, p + c, stride, h);
        next[c] = place[c] == kept ? p[c] : std::clamp(next[c], -far, far);
      }
    });
    for_each(rows, [&](const Index<Dim>& i) { std::copy_n(next + w.at(i), count, p + w.at(i)); });
  }
  double* out = body.at(slot).phi_next.data();
  Box<Dim> rows = w.inner();
  rows.hi[0] = rows.lo[0] + 1;
  const int width = w.inner().extent(0);
  for_each(rows, [&](const Index<Dim>& i) {
    const double *found = p + w.at(i), *before = p0 + w.at(i);
    double* row = out + w.cell(i);
    for (int c = 0; c < width; ++c) {
      const double least = before[c] > nearest_slowed * h ? before[c] - most_nearer * h : -far;
      row[c] = std::max(found[c], least);
    }
  });
}

#define RECOIL_INSTANTIATE(Dim)                                                                            \
  template Foot<Dim> foot_point<Dim>(const Grid<Dim>&, const Box<Dim>&, const double*, const Index<Dim>&); \
  template void redistance<Dim>(const State<Dim>&, Body<Dim>&, int, int, double, double, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
