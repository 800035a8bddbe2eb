#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/scratch.hpp"
#include "cutcell/geometry.hpp"
#include "dynamics/block_sources.hpp"
#include "dynamics/face_rows.hpp"
#include "dynamics/failed_faces.hpp"
#include "dynamics/flux_llf.hpp"
#include "dynamics/half_step/block_half_step.hpp"
#include "mesh/open_edge.hpp"

namespace recoil::detail {

/// The scheme of the faces: face_fluxes() of dynamics/flux.hpp or of dynamics/flux_llf.hpp.
struct WenoHllc {
  static constexpr bool by_cells = true;  // reconstructs once per cell for both its faces
  template <int Dim, int Axis, bool Shear>
  static int fluxes(const AnyEos& eos, const Row<Dim>& in, const FaceFlux<Dim>& out) {
    return face_fluxes<Dim, Axis, Shear>(eos, in, out);
  }
};
struct EnoLlf {
  static constexpr bool by_cells = false;
  template <int Dim, int Axis, bool Shear>
  static int fluxes(const AnyEos& eos, const Row<Dim>& in, const FaceFlux<Dim>& out) {
    return face_fluxes_llf<Dim, Axis, Shear>(eos, in, out);
  }
};

/// Counts a face whose stencil lacks values. @param at the cell above it.
template <int Dim>
void count_poor_face(const Work<Dim>& w, std::ptrdiff_t at, std::ptrdiff_t step, Counters& counters) {
  bool dust = false;
  for (int s = -face_reach; s < face_reach; ++s)
    dust = dust || (w.failed && w.failed[at + s * step] != intact);
  const bool leaves = near_open_edge(w.grid, w.window.box().index(static_cast<int>(at)), face_reach);
  ++(dust ? counters.faces_of_dust : leaves ? counters.faces_at_open_edges : counters.faces_without_value);
}

/// A face whose stencil lacks values: the nearest value stands in for those beyond it.
template <int Dim, int Axis, bool Shear, class Scheme>
void poor_face(const AnyEos& eos, const Work<Dim>& w, std::ptrdiff_t at, std::ptrdiff_t step,
               const FaceFlux<Dim>& out, Counters& counters) {
  using C = Components<Dim>;
  std::array<std::ptrdiff_t, 6> from{};
  std::array<bool, 6> has{};
  for (std::size_t s = 0; s < 6; ++s) {
    from[s] = at + (static_cast<std::ptrdiff_t>(s) - 3) * step;
    has[s] = (w.role[from[s]] & valued) != 0;
  }
  count_poor_face(w, at, step, counters);
  if (!has[2] && !has[3]) {
    for (std::size_t c = 0; c < C::contents; ++c) out.flux[c * out.faces + out.first] = 0;
    for (std::size_t d = 0; d < Dim; ++d) out.velocity[d * out.faces + out.first] = 0;
    return;
  }
  if (!has[2]) from[2] = from[3];
  if (!has[3]) from[3] = from[2];
  for (std::size_t s : {1, 0})
    if (!has[s]) from[s] = from[s + 1];
  for (std::size_t s : {4, 5})
    if (!has[s]) from[s] = from[s - 1];
  std::array<double, 6 * C::primitives> value{};
  std::array<double, 6 * C::primitives> change{}, across{};
  std::array<double, 6> stress{}, impedance{}, loading{}, shear{};
  const std::array<std::uint8_t, 6> role{};  // its stencil is no regular one
  for (std::size_t s = 0; s < 6; ++s) {
    for (std::size_t c = 0; c < C::primitives; ++c) {
      value[c * 6 + s] = w.primitive[c * w.wide + from[s]];
      if (w.ahead.dt > 0) change[c * 6 + s] = w.ahead.change[Axis][c * w.wide + from[s]];
      if (w.ahead.across) across[c * 6 + s] = w.ahead.across[c * w.wide + from[s]];
    }
    stress[s] = w.stress[from[s]];
    impedance[s] = w.impedance[from[s]];
    if (w.ahead.loading) loading[s] = w.ahead.loading[from[s]];
    shear[s] = w.shear[from[s]];
  }
  HalfStep ahead{w.ahead.dt, w.ahead.per_dx, loading.data()};
  ahead.change[Axis] = change.data();
  if (w.ahead.across) ahead.across = across.data();
  Row<Dim> row{value.data(), stress.data(), impedance.data(), 6, 3, 1, 1, ahead.dt > 0 ? &ahead : nullptr,
               w.fails};
  row.shear = shear.data();
  row.role = role.data();
  row.flattens = w.flattens;
  counters.first_order_faces += Scheme::template fluxes<Dim, Axis, Shear>(eos, row, out);
}

/// Of every face of a row: whether all cells of its stencil have a value.
/// @param role of the cells above the faces. @returns whether it is so of all faces.
inline bool find_complete(const std::uint8_t* role, std::ptrdiff_t step, int count, std::uint8_t* complete) {
  std::uint8_t all = valued;
#pragma omp simd reduction(& : all)
  for (int i = 0; i < count; ++i) {
    const std::uint8_t* at = role + i;
    complete[i] = at[-3 * step] & at[-2 * step] & at[-step] & at[0] & at[step] & at[2 * step] & valued;
    all &= complete[i];
  }
  return all != 0;
}

inline bool any_closed(const double* area, int count) {
  int closed = 0;
#pragma omp simd reduction(| : closed)
  for (int i = 0; i < count; ++i) closed |= area[i] == 0 ? 1 : 0;
  return closed != 0;
}

/// Nothing passes closed faces; those whose stencil lacks values are done on their own.
template <int Dim, int Axis, bool Shear, class Scheme>
void replace_inadmissible_faces(const AnyEos& eos, const Work<Dim>& w, const Faces<Dim>& out,
                                Counters& counters) {
  using C = Components<Dim>;
  static_assert(face_reach == 3, "cells that find_complete() looks at");
  const std::ptrdiff_t step = w.window.stride(Axis);
  Box<Dim> rows = out.box;
  rows.hi[0] = rows.lo[0] + 1;
  const int width = out.box.extent(0);
  std::array<std::uint8_t, Window<Dim>::longest> complete;
  for_each(rows, [&](const Index<Dim>& r) {
    const int at_face = out.box.at(r), at_cell = w.window.at(r);
    const bool all = !w.role || find_complete(w.role + at_cell, step, width, complete.data());
    if (all && !any_closed(out.area + at_face, width)) return;
    for (int i = 0; i < width; ++i) {
      const int face = at_face + i;
      if (out.area[face] == 0) {
        for (std::size_t c = 0; c < C::contents; ++c) out.flux.flux[c * out.flux.faces + face] = 0;
        for (std::size_t d = 0; d < Dim; ++d) out.flux.velocity[d * out.flux.faces + face] = 0;
      } else if (!all && complete[static_cast<std::size_t>(i)] == 0 && !between_voids(w, at_cell + i, step)) {
        poor_face<Dim, Axis, Shear, Scheme>(eos, w, at_cell + i, step, out.flux_at(at_face + i), counters);
      }
    }
  });
}

/// All faces of real cells are open, those between two others are not there.
template <int Dim>
void whole_areas(const Work<Dim>& w, const Box<Dim>& faces, int axis, double* area) {
  const std::ptrdiff_t step = w.window.stride(axis);
  int k = 0;
  for_each(faces, [&](const Index<Dim>& i) {
    const std::ptrdiff_t at = w.window.at(i);
    const bool open = !w.role || ((w.role[at] | w.role[at - step]) & regular) != 0;
    area[k++] = open ? w.grid.full_area(i, axis) : 0;
  });
}

/// S_nn - p along an axis in all cells of the window, into Work::stress.
template <int Dim, int Axis>
void find_normal_stress(Work<Dim>& w, Scratch& scratch) {
  using C = Components<Dim>;
  w.stress = scratch.take<double>(w.wide + vector_length);
  const double* p = w.primitive + C::p * w.wide;
  const double* a = w.primitive + C::s * w.wide;
  if constexpr (Dim == 3 && Axis == 2) {
    for (std::size_t k = 0; k < w.wide; ++k) w.stress[k] = -(a[k] + a[w.wide + k]) - p[k];
  } else {
    a += C::stress(Axis, Axis) * w.wide;
    for (std::size_t k = 0; k < w.wide; ++k) w.stress[k] = a[k] - p[k];
  }
}

/// Adds what the fluxes bring to the rates of the block's cells, which the first axis sets, and the star
/// velocities to their gradients, each of which one axis sets.
template <int Dim, int Axis>
void add_fluxes(const Faces<Dim>& in, Work<Dim>& w) {
  const std::size_t nf = in.flux.faces;
  const double *area = in.area, *flux = in.flux.flux, *velocity = in.flux.velocity;
  const std::ptrdiff_t next = in.box.stride(Axis);
  Box<Dim> cell_rows = w.cells;
  cell_rows.hi[0] = cell_rows.lo[0] + 1;
  const int cell_width = w.cells.extent(0);
  for_each(cell_rows, [&](const Index<Dim>& r) {
    const int f = in.box.at(r), k = w.cells.at(r);
    const double *low = area + f, *high = area + f + next;
    for (std::size_t c = 0; c < w.carried(); ++c) {
      const double* q = flux + c * nf + f;
      double* const rate = w.rate + c * w.n + k;
      if constexpr (Axis == 0)
        set_difference(cell_width, low, q, high, q + next, rate);
      else
        add_difference(cell_width, low, q, high, q + next, rate);
    }
    for (std::size_t d = 0; d < Dim; ++d) {
      const double* u = velocity + d * nf + f;
      set_difference(cell_width, high, u + next, low, u, w.gradient + (d * Dim + Axis) * w.n + k);
      if (w.grid.has_radius() && Axis == 0)
        for (int i = 0; i < cell_width; ++i) {
          const double low = Dim == 1 ? w.grid.low_face_part(r[0] + i) : 0.5;
          w.radial[d * w.n + k + i] = low * u[i] + (1 - low) * u[i + next];
        }
    }
  });
}

/// Books what passes the edges of the domain, times `booked` seconds. Nothing is booked at periodic edges: it
/// comes back on the other side.
template <int Dim>
void book_edges(const Faces<Dim>& in, const Work<Dim>& w, int axis, double booked,
                ExactEdgeAccount<Dim>& edges) {
  using C = Components<Dim>;
  if (w.grid.periodic(axis)) return;
  const std::size_t nf = in.flux.faces;
  const double *area = in.area, *flux = in.flux.flux;
  for (int side = 0; side < 2; ++side) {
    const int edge = side == 0 ? 0 : w.grid.cells[axis];
    if (side == 0 ? w.cells.lo[axis] != 0 : w.cells.hi[axis] != edge) continue;
    Box<Dim> face = in.box;
    face.lo[axis] = edge;
    face.hi[axis] = edge + 1;
    const double sign = side == 0 ? -booked : booked;
    for_each(face, [&](const Index<Dim>& i) {
      const int k = in.box.at(i);
      Vec<Dim> middle = w.grid.centre(i);
      middle[axis] -= 0.5 * w.grid.dx;
      edges.leave(sign * area[k] * flux[C::rho * nf + k], middle);
      edges.energy += sign * area[k] * flux[C::energy * nf + k];
      for (std::size_t d = 0; d < Dim; ++d) edges.momentum.c[d] += sign * area[k] * flux[(C::u + d) * nf + k];
    });
  }
}

/// Fluxes through all faces whose stencil has values.
template <int Dim, int Axis, bool Shear, class Scheme>
void solve_all(const AnyEos& eos, const Work<Dim>& w, const Faces<Dim>& out, Counters& counters) {
  if constexpr (!Scheme::by_cells)
    solve_row_by_row<Dim, Axis, Shear, Scheme>(eos, w, out, counters);
  else if constexpr (Axis == 0)
    solve_along_rows<Dim, Shear>(eos, w, out, counters);
  else
    solve_across_rows<Dim, Axis, Shear>(eos, w, out, counters);
}

/// Fluxes through all faces across one axis, their open areas, and what they add to the block's cells.
/// @param booked seconds with which what passes the edges of the domain is booked in `edges`.
template <int Dim, int Axis, bool Shear, class Scheme>
void sweep(const AnyEos& eos, const Geometry<Dim>& geometry, Work<Dim>& w, double booked,
           ExactEdgeAccount<Dim>& edges, Counters& counters, Scratch& scratch) {
  const Scratch::Frame frame(scratch);
  Box<Dim> faces = w.cells;
  ++faces.hi[Axis];
  const std::size_t nf = faces.size();
  double* area = scratch.take<double>(nf);
  double* flux = scratch.take<double>(nf * Components<Dim>::contents);
  double* velocity = scratch.take<double>(nf * Dim);
  find_normal_stress<Dim, Axis>(w, scratch);
  if (w.ahead.dt > 0) find_across<Dim, Axis>(w, scratch);
  if (w.whole)
    whole_areas(w, faces, Axis, area);
  else
    open_areas(w.grid, w.window, geometry, Axis, area);

  const PartlyOpen<Dim> partly =
      w.whole ? PartlyOpen<Dim>{} : find_partly_open(w.window, geometry, Axis, faces, scratch);
  const Faces<Dim> out{faces, area, {flux, velocity, nf, 0}, partly};
  if (w.still) {
    std::fill_n(flux, nf * Components<Dim>::contents, 0.0);
    std::fill_n(velocity, nf * Dim, 0.0);
  } else {
    solve_all<Dim, Axis, Shear, Scheme>(eos, w, out, counters);
  }
  replace_inadmissible_faces<Dim, Axis, Shear, Scheme>(eos, w, out, counters);
  PartedFace<Dim>* parted = nullptr;
  int apart = 0;
  if (w.failed) {
    parted = scratch.take<PartedFace<Dim>>(nf);
    apart = solve_failed_faces<Dim, Axis, Shear>(eos, w, out, parted);
  }
  if (w.sides) meet_other_levels(out, Axis, w);

  add_fluxes<Dim, Axis>(out, w);
  for (int k = 0; k < apart; ++k) part_gradient<Dim, Axis>(out, parted[k], w);
  book_edges(out, w, Axis, booked, edges);
}

}  // namespace recoil::detail
