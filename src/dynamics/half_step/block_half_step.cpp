#include "dynamics/half_step/block_half_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "core/multiversion.hpp"
#include "dynamics/flux.hpp"
#include "dynamics/half_step/half_step.hpp"
#include "dynamics/half_step/loading.hpp"
#include "dynamics/half_step/window_reader.hpp"

namespace recoil::detail {

namespace {

/// f(reader) with that of the window.
template <int Dim, class F>
void with_reader(const Work<Dim>& w, F&& f) {
  const double per_dx = 0.5 / w.grid.dx;
  if (w.open)
    f(WindowReader<Dim, true>{w.primitive, w.impedance, w.open, w.own, w.wide, per_dx, w.shear});
  else
    f(WindowReader<Dim, false>{w.primitive, w.impedance, nullptr, nullptr, w.wide, per_dx, w.shear});
}

/// What half a step by one axis changes is read this far from the block: a face reads the cells beside it,
/// and what half a step across changes on both sides of those.
constexpr int reach_along = 1, reach_across = 2;

/// The rows of a box of cells.
template <int Dim, class F>
void for_each_row(const Work<Dim>& w, Box<Dim> rows, F&& f) {
  const int width = rows.extent(0);
  rows.hi[0] = rows.lo[0] + 1;
  for_each(rows, [&](const Index<Dim>& r) { f(r, static_cast<std::ptrdiff_t>(w.window.at(r)), width); });
}

/// S:D of a row of cells; the least number above zero where matter without stress moves otherwise than what
/// is around it.
template <int Dim, class Reader>
RECOIL_MULTIVERSION void find_working(const Reader& read, const std::array<std::ptrdiff_t, Dim>& step,
                                      std::ptrdiff_t first, int count, double* working) {
  using C = Components<Dim>;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const auto v = read.at(first + i);
    double sum = 0, motion = 0, stress = 0;
    for_each_axis<Dim>([&](auto d) RECOIL_INLINE {
      const auto slope = read.slope(read.primitive, first + i, step[d]);
      sum += working_along<Dim, d>(v, slope);
      for_each_axis<Dim>([&](auto e) RECOIL_INLINE { motion += std::abs(slope[C::u + e]); });
    });
    for_each_constant<C::stresses>([&](auto c) RECOIL_INLINE { stress += std::abs(v[C::s + c]); });
    const double least = motion > 0 ? std::numeric_limits<double>::min() : 0.0;
    working[i] = stress > 0 ? sum : least;
  }
}

/// r of a cell of a row that begins with cell `first`, at least dx/2 from 0; below 0 beyond the axis.
template <int Dim>
double radius_of(const Grid<Dim>& grid, int first, int i) {
  const double r = grid.origin[0] + (first + i + 0.5) * grid.dx, least = 0.5 * grid.dx;
  return r < 0 ? std::min(r, -least) : std::max(r, least);
}

/// Adds the part of the hoop stresses to S:D of a row of cells, where the domain has a radius.
template <int Dim, class Reader>
void add_hoop_working(const Reader& read, const Grid<Dim>& grid, int column, std::ptrdiff_t first, int count,
                      double* working) {
  using C = Components<Dim>;
  for (int i = 0; i < count; ++i) {
    const auto v = read.at(first + i);
    double hoops = -v[C::s];  // S_tt, in a sphere twice
    if constexpr (Dim == 2) hoops -= v[C::s + 1];
    working[i] += hoops * v[C::u] / radius_of(grid, column, i);
  }
}

/// loading_of() all cells, 0 where they do not load on.
template <int Dim>
void find_loading(const Body<Dim>& body, Work<Dim>& w) {
  std::array<std::ptrdiff_t, Dim> step;
  for (int d = 0; d < Dim; ++d) step[static_cast<std::size_t>(d)] = w.window.stride(d);
  with_reader(w, [&](const auto& read) {
    for_each_row(w, w.cells.grown(reach_across), [&](const Index<Dim>& r, std::ptrdiff_t first, int width) {
      double* loading = w.ahead.loading + first;
      find_working<Dim>(read, step, first, width, loading);
      if constexpr (Dim < 3)
        if (w.grid.has_radius()) add_hoop_working(read, w.grid, r[0], first, width, loading);
      for (int i = 0; i < width; ++i)
        loading[i] = loading[i] > 0 ? loading_of(body, read.at(first + i)) : 0.0;
    });
  });
}

/// Rows are read in whole vectors: what follows a row's changes is read, to no effect, and must be a number.
template <int Dim>
void clear_behind(const Work<Dim>& w, std::ptrdiff_t end, double* change) {
  for (std::size_t c = 0; c < Components<Dim>::primitives; ++c)
    std::fill_n(change + static_cast<std::ptrdiff_t>(c * w.wide) + end, vector_length - 1, 0.0);
}

/// What the widening of rings or shells does in row r.
template <int Dim, class Reader>
[[gnu::always_inline]] inline void widen(const Work<Dim>& w, const Index<Dim>& r, int i, const Reader& read,
                                         std::ptrdiff_t k, const Primitives<Dim>& v, Primitives<Dim>& rate) {
  using C = Components<Dim>;
  // On the axis u_r/r is du_r/dr, and what the hoop stress does to the velocity vanishes: divided by dx/2
  // noise would grow there.
  const bool on_axis = r[0] + i == 0 || r[0] + i == -1;
  const double radius = std::abs(radius_of(w.grid, r[0], i));
  const double next = w.primitive[C::u * w.wide + static_cast<std::size_t>(r[0] + i < 0 ? k - 1 : k + 1)];
  const double widening = on_axis ? 0.5 * (v[C::u] + next) / w.grid.dx : v[C::u] / radius;
  const double sign = r[0] + i < 0 ? -1 : 1;
  add_widening<Dim>(v, sign * widening, on_axis ? 0.0 : sign / radius, read.response(k, w.ahead.loading),
                    rate);
}

/// Half a step changes the pressure by at most this part of rho c_L^2, and the density by this part of it.
/// Unlimited differences across a strong shock in a gas would leave none of the pressure ahead of it.
constexpr double largest_change = 0.25;

/// By what to multiply a change of half a step so that it keeps to largest_change, 1 nearly everywhere.
template <int Dim>
[[gnu::always_inline]] inline double kept_part(const Primitives<Dim>& v, const Primitives<Dim>& change,
                                               const Response& m) {
  using C = Components<Dim>;
  const double modulus = m.bulk + 4.0 / 3 * m.shear, most = largest_change * modulus,
               p = std::abs(change[C::p]), rho = std::abs(change[C::rho]) * (modulus / v[C::rho]);
  const double larger = p > rho ? p : rho;
  return larger > most ? most / larger : 1.0;
}

/// Where a row of changes goes: by central and by upwind differences.
struct ChangeRow {
  double *central, *upwind;
};

/// The changes of half a step by one axis, of a row of cells: of all that waves move.
/// @param step distance in memory along the axis.
// NOLINTBEGIN(readability-non-const-parameter): the lambdas write to the rows
template <int Dim, int Axis, class Reader>
RECOIL_MULTIVERSION void find_row_change(const Reader& read, const double* loading, std::ptrdiff_t step,
                                         std::ptrdiff_t first, int count, double half, ChangeRow out) {
  const double damping = half * 2 * read.per_dx / 12;  // third-order upwind differences
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const std::ptrdiff_t k = first + i;
    const auto v = read.at(k);
    const auto d = read.differences(k, step);
    const Response response = read.response(k, loading);
    auto central = rate_along<Dim, Axis>(v, d.slope, v[Components<Dim>::u + Axis], response);
    auto upwind = times_speeds<Dim, Axis>(v, d.fourth, d.bend, response);
    for_each_constant<Components<Dim>::ep>([&](auto c) RECOIL_INLINE {
      central[c] *= half;
      upwind[c] = central[c] - damping * upwind[c];
    });
    const double part = kept_part<Dim>(v, central, response), leaning = kept_part<Dim>(v, upwind, response);
    for_each_constant<Components<Dim>::ep>([&](auto c) RECOIL_INLINE {
      out.central[c * read.wide + k] = part * central[c];
      out.upwind[c * read.wide + k] = leaning * upwind[c];
    });
  }
}

/// The same of one primitive that rides with the matter. @param ride velocity along the axis.
template <class Reader>
RECOIL_MULTIVERSION void find_row_ride(const Reader& read, const double* ride, const double* value,
                                       std::ptrdiff_t step, std::ptrdiff_t first, int count, double half,
                                       ChangeRow out) {
  const double damping = half * 2 * read.per_dx / 12;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const std::ptrdiff_t k = first + i;
    const auto d = Reader::difference(read.weights_of_four(k, step), value + k, step);
    const double central = -half * ride[k] * d.slope;
    out.central[k] = central;
    out.upwind[k] = central - damping * std::abs(ride[k]) * d.fourth;
  }
}
// NOLINTEND(readability-non-const-parameter)

/// Where the changes by one axis are read.
template <int Dim>
Box<Dim> changed_by(const Work<Dim>& w, int axis) {
  Box<Dim> box = w.cells.grown(reach_across);
  box.lo[axis] = w.cells.lo[axis] - reach_along;
  box.hi[axis] = w.cells.hi[axis] + reach_along;
  return box;
}

/// The changes of half a step by one axis.
template <int Dim, int Axis>
void find_change(double half, Work<Dim>& w) {
  const std::ptrdiff_t step = w.window.stride(Axis);
  const ChangeRow out{w.ahead.change[Axis], w.ahead.leaning[Axis]};
  using C = Components<Dim>;
  with_reader(w, [&](const auto& read) {
    for_each_row(w, changed_by(w, Axis), [&](const Index<Dim>&, std::ptrdiff_t first, int width) {
      find_row_change<Dim, Axis>(read, w.ahead.loading, step, first, width, half, out);
      for (std::size_t c = C::ep; c < C::primitives; ++c) {
        const std::size_t at = c * w.wide;
        if (c < w.held) {
          find_row_ride(read, w.primitive + (C::u + Axis) * w.wide, w.primitive + at, step, first, width,
                        half, ChangeRow{out.central + at, out.upwind + at});
        } else {
          std::fill_n(out.central + at + first, width, 0.0);
          std::fill_n(out.upwind + at + first, width, 0.0);
        }
      }
      clear_behind(w, first + width, out.central);
    });
  });
}

/// Adds what half a step along the axis makes of what half a step across it has changed, of a row of cells.
// NOLINTBEGIN(readability-non-const-parameter): the lambda writes to `both`
template <int Dim, int Axis, class Reader>
RECOIL_MULTIVERSION void cross_row(const Reader& read, const double* loading, std::ptrdiff_t step,
                                   std::ptrdiff_t first, int count, double half, const double* across,
                                   double* both) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const std::ptrdiff_t k = first + i;
    const auto v = read.at(k);
    const auto rate = rate_along<Dim, Axis>(v, read.slope(across, k, step), v[Components<Dim>::u + Axis],
                                            read.response(k, loading));
    for_each_constant<Components<Dim>::primitives>(
        [&](auto c) RECOIL_INLINE { both[c * read.wide + k] = across[c * read.wide + k] + half * rate[c]; });
  }
}
// NOLINTEND(readability-non-const-parameter)

/// The changes of half a step by the widening of rings or shells, which stand beside those by each axis too.
template <int Dim>
void find_widening_change(double half, Work<Dim>& w) {
  double* const change = w.ahead.change[Dim];
  const WindowReader<Dim, false> read{w.primitive, w.impedance,     nullptr, nullptr,
                                      w.wide,      0.5 / w.grid.dx, w.shear};
  for_each_row(w, w.cells.grown(reach_across), [&](const Index<Dim>& r, std::ptrdiff_t first, int width) {
    for (int i = 0; i < width; ++i) {
      const std::ptrdiff_t k = first + i;
      Primitives<Dim> rate{};
      if (!w.open || w.open[k] != 0) widen(w, r, i, read, k, read.at(k), rate);
      for (std::size_t c = 0; c < rate.size(); ++c) change[c * w.wide + k] = half * rate[c];
    }
    clear_behind(w, first + width, change);
  });
  for (int d = 0; d < Dim; ++d)
    for_each_row(w, changed_by(w, d), [&](const Index<Dim>&, std::ptrdiff_t first, int width) {
      for (std::size_t c = 0; c < Components<Dim>::primitives; ++c) {
        const std::size_t at = c * w.wide + static_cast<std::size_t>(first);
        add_scaled(width, 1, change + at, w.ahead.leaning[d] + at);
      }
    });
}

template <int Dim>
Box<Dim> grown_along(const Work<Dim>& w, int axis, int reach) {
  Box<Dim> box = w.cells;
  box.lo[axis] -= reach;
  box.hi[axis] += reach;
  return box;
}

/// What half a step by both axes but one changes, into `sum`.
template <int Axis>
const double* sum_of_others(const Work<3>& w, double* sum) {
  const double *a = w.ahead.leaning[Axis == 0 ? 1 : 0], *b = w.ahead.leaning[Axis == 2 ? 1 : 2];
  for_each_row(w, grown_along(w, Axis, reach_across), [&](const Index<3>&, std::ptrdiff_t first, int width) {
    for (std::size_t c = 0; c < Components<3>::primitives; ++c) {
      const std::size_t at = c * w.wide + static_cast<std::size_t>(first);
      add_rows(width, a + at, b + at, sum + at);
    }
  });
  return sum;
}

template <int Dim>
void find_open(Work<Dim>& w, Scratch& scratch) {
  if (!w.role) return;
  w.open = scratch.take<double>(w.wide);
  w.own = scratch.take<double>(w.wide);
#pragma omp simd
  for (std::size_t k = 0; k < w.wide; ++k) {
    w.open[k] = (w.role[k] & valued) != 0 ? 1.0 : 0.0;
    w.own[k] = (w.role[k] & regular) != 0 ? 1.0 : 0.0;
  }
}

/// Dust stays as it is: a void bears no wave.
template <int Dim>
void leave_voids(Work<Dim>& w) {
  if (!w.failed) return;
  for (std::size_t k = 0; k < w.wide; ++k)
    if (w.failed[k] == with_void)
      for (const auto& changes : {std::span<double*>(w.ahead.change), std::span<double*>(w.ahead.leaning)})
        for (double* change : changes)
          for (std::size_t c = 0; change && c < Components<Dim>::primitives; ++c) change[c * w.wide + k] = 0;
}

}  // namespace

template <int Dim>
void find_half_step(const Body<Dim>& body, double dt, Work<Dim>& w, Scratch& scratch) {
  const std::size_t n = w.wide * Components<Dim>::primitives + vector_length;
  w.ahead.dt = dt;
  w.ahead.per_dx = dt / w.grid.dx;
  w.ahead.loading = scratch.take_filled<double>(w.wide + vector_length, 0);
  find_open(w, scratch);
  if (has_strength(body.material.strength)) find_loading(body, w);
  for_each_axis<Dim>([&](auto axis) {
    w.ahead.change[axis] = scratch.take<double>(n);
    w.ahead.leaning[axis] = scratch.take<double>(n);
    find_change<Dim, axis>(0.5 * dt, w);
  });
  if constexpr (Dim < 3)
    if (w.grid.has_radius()) {
      w.ahead.change[Dim] = scratch.take<double>(n);
      find_widening_change(0.5 * dt, w);
    }
  leave_voids(w);
}

template <int Dim, int Axis>
void find_across(Work<Dim>& w, Scratch& scratch) {
  if constexpr (Dim > 1) {
    constexpr std::size_t primitives = Components<Dim>::primitives;
    const std::size_t n = w.wide * primitives + vector_length;
    double* both = scratch.take<double>(n);
    const double* across = w.ahead.leaning[Axis == 0 ? 1 : 0];
    if constexpr (Dim == 3) across = sum_of_others<Axis>(w, scratch.take<double>(n));
    with_reader(w, [&](const auto& read) {
      for_each_row(w, grown_along(w, Axis, reach_along),
                   [&](const Index<Dim>&, std::ptrdiff_t first, int width) {
                     cross_row<Dim, Axis>(read, w.ahead.loading, w.window.stride(Axis), first, width,
                                          0.5 * w.ahead.dt, across, both);
                     clear_behind(w, first + width, both);
                     if (!w.failed) return;
                     for (std::ptrdiff_t k = first; k < first + width; ++k)
                       for (std::size_t c = 0; w.failed[k] == with_void && c < primitives; ++c)
                         both[c * w.wide + k] = 0;
                   });
    });
    w.ahead.across = both;
  } else if (w.grid.has_radius()) {
    w.ahead.across = w.ahead.change[Dim];
  }
}

template <int Dim>
void move_to_midstep(Work<Dim>& w) {
  using C = Components<Dim>;
  Box<Dim> rows = w.cells;
  const int width = rows.extent(0);
  rows.hi[0] = rows.lo[0] + 1;
  for (const double* change : w.ahead.change) {
    if (!change) continue;
    for_each(rows, [&](const Index<Dim>& r) {
      for (std::size_t c = 0; c < C::primitives; ++c) {
        const std::size_t first = c * w.wide + static_cast<std::size_t>(w.window.at(r));
        add_scaled(width, 1, change + first, w.primitive + first);
      }
    });
  }
}

#define RECOIL_INSTANTIATE(Dim)                                                      \
  template void find_half_step<Dim>(const Body<Dim>&, double, Work<Dim>&, Scratch&); \
  template void move_to_midstep<Dim>(Work<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE
#define RECOIL_INSTANTIATE(Dim, Axis) template void find_across<Dim, Axis>(Work<Dim>&, Scratch&);
RECOIL_INSTANTIATE(1, 0)
RECOIL_INSTANTIATE(2, 0)
RECOIL_INSTANTIATE(2, 1)
RECOIL_INSTANTIATE(3, 0)
RECOIL_INSTANTIATE(3, 1)
RECOIL_INSTANTIATE(3, 2)
#undef RECOIL_INSTANTIATE

}  // namespace recoil::detail
