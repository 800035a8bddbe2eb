#include "dynamics/block_update.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "cutcell/geometry.hpp"
#include "cutcell/whole_cells.hpp"
#include "dynamics/face_rows.hpp"
#include "dynamics/flux_llf.hpp"

namespace recoil {

namespace {

using detail::Faces;
using detail::Work;

constexpr int reach = 3;  // cells that a reconstruction reads beyond a face

template <int Dim, class EosModel>
void gather_values(const Body<Dim>& body, int slot, const EosModel& eos, double shear_modulus, Work<Dim>& w,
                   Scratch& scratch) {
  using C = Components<Dim>;
  constexpr std::size_t count = EosModel::barotropic ? C::primitives : C::contents;
  w.primitive = scratch.take<double>(w.wide * C::primitives + vector_length);
  std::array<typename Window<Dim>::template Component<double>, count> components;
  for (std::size_t c = 0; c < count; ++c) {
    components[c].missing = c == C::rho ? eos.rho0 : 0.0;
    for (int d = 0; d < Dim; ++d)
      if (component_sign<Dim>(static_cast<int>(c), 1U << d) < 0) components[c].odd_axes |= 1U << d;
  }
  w.window.gather([&](int s) { return body.present(s) ? body.at(s).stencil.data() : nullptr; }, components,
                  Beyond::extend, w.primitive);
  if (body.at(slot).near_surface) {
    w.role = scratch.take<std::uint8_t>(w.wide);
    w.window.gather([&](int s) { return body.present(s) ? body.at(s).role.data() : nullptr; },
                    std::uint8_t{0}, Beyond::extend, w.role);
    for (std::size_t c = 0; c < count; ++c) {
      const double missing = c == C::rho ? eos.rho0 : 0.0;
      double* value = w.primitive + c * w.wide;
#pragma omp simd
      for (std::size_t k = 0; k < w.wide; ++k) value[k] = (w.role[k] & valued) != 0 ? value[k] : missing;
    }
  }
  w.impedance = scratch.take<double>(w.wide + vector_length);
  const double c0 = bulk_sound_speed(eos), least = least_sound * c0 * c0;
  const double *rho = w.primitive, *p = w.primitive + C::p * w.wide;
#pragma omp simd
  for (std::size_t k = 0; k < w.wide; ++k) {
    const double c2 = eos.sound_speed_squared(rho[k], p[k]);
    w.impedance[k] = rho[k] * std::sqrt((c2 > least ? c2 : least) + 4 * shear_modulus / (3 * rho[k]));
  }
}

/// The scheme of the faces: face_fluxes() of dynamics/flux.hpp or of dynamics/flux_llf.hpp.
struct WenoHllc {
  static constexpr bool by_cells = true;  // reconstructs once per cell for both its faces
  template <int Dim, int Axis, bool Shear, class EosModel>
  static int fluxes(const EosModel& eos, double g, const Row<Dim>& in, const FaceFlux<Dim>& out) {
    return face_fluxes<Dim, Axis, Shear>(eos, g, in, out);
  }
};
struct EnoLlf {
  static constexpr bool by_cells = false;
  template <int Dim, int Axis, bool Shear, class EosModel>
  static int fluxes(const EosModel& eos, double g, const Row<Dim>& in, const FaceFlux<Dim>& out) {
    return face_fluxes_llf<Dim, Axis, Shear>(eos, g, in, out);
  }
};

/// A face whose stencil lacks values: the nearest value stands in for those beyond it.
template <int Dim, int Axis, bool Shear, class Scheme, class EosModel>
void poor_face(const EosModel& eos, double g, const Work<Dim>& w, std::ptrdiff_t at, std::ptrdiff_t step,
               const FaceFlux<Dim>& out, Counters& counters) {
  using C = Components<Dim>;
  std::array<std::ptrdiff_t, 6> from{};
  std::array<bool, 6> has{};
  for (std::size_t s = 0; s < 6; ++s) {
    from[s] = at + (static_cast<std::ptrdiff_t>(s) - 3) * step;
    has[s] = (w.role[from[s]] & valued) != 0;
  }
  ++counters.faces_without_value;
  if (!has[2] && !has[3]) {
    for (std::size_t c = 0; c < C::contents; ++c)
      out.flux[c * out.faces + static_cast<std::size_t>(out.first)] = 0;
    for (std::size_t d = 0; d < Dim; ++d)
      out.velocity[d * out.faces + static_cast<std::size_t>(out.first)] = 0;
    return;
  }
  if (!has[2]) from[2] = from[3];
  if (!has[3]) from[3] = from[2];
  for (std::size_t s : {1, 0})
    if (!has[s]) from[s] = from[s + 1];
  for (std::size_t s : {4, 5})
    if (!has[s]) from[s] = from[s - 1];
  std::array<double, 6 * C::primitives> value{};
  std::array<double, 6> stress{}, impedance{};
  for (std::size_t s = 0; s < 6; ++s) {
    for (std::size_t c = 0; c < C::primitives; ++c)
      value[c * 6 + s] = w.primitive[c * w.wide + static_cast<std::size_t>(from[s])];
    stress[s] = w.stress[from[s]];
    impedance[s] = w.impedance[from[s]];
  }
  const Row<Dim> row{value.data(), stress.data(), impedance.data(), 6, 3, 1, 1};
  counters.first_order_faces += Scheme::template fluxes<Dim, Axis, Shear>(eos, g, row, out);
}

template <int Dim>
bool complete(const Work<Dim>& w, std::ptrdiff_t at, std::ptrdiff_t step) {
  for (int s = -3; s < 3; ++s)
    if ((w.role[at + s * step] & valued) == 0) return false;
  return true;
}

/// Nothing passes closed faces; those whose stencil lacks values are done on their own.
template <int Dim, int Axis, bool Shear, class Scheme, class EosModel>
void replace_inadmissible_faces(const EosModel& eos, double g, const Work<Dim>& w, const Faces<Dim>& out,
                                Counters& counters) {
  using C = Components<Dim>;
  const std::ptrdiff_t step = w.window.stride(Axis);
  Box<Dim> rows = out.box;
  rows.hi[0] = rows.lo[0] + 1;
  const int width = out.box.extent(0);
  for_each(rows, [&](const Index<Dim>& r) {
    const int at_face = out.box.at(r), at_cell = w.window.at(r);
    for (int i = 0; i < width; ++i) {
      const auto face = static_cast<std::size_t>(at_face + i);
      if (out.area[face] == 0) {
        for (std::size_t c = 0; c < C::contents; ++c) out.flux.flux[c * out.flux.faces + face] = 0;
        for (std::size_t d = 0; d < Dim; ++d) out.flux.velocity[d * out.flux.faces + face] = 0;
      } else if (w.role && !complete(w, at_cell + i, step)) {
        poor_face<Dim, Axis, Shear, Scheme>(eos, g, w, at_cell + i, step, out.flux_at(at_face + i), counters);
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

/// Fluxes through all faces across one axis, their open areas, and what they add to the block's cells.
template <int Dim, int Axis, bool Shear, class Scheme, class EosModel>
void sweep(const EosModel& eos, double g, const Geometry<Dim>& geometry, Work<Dim>& w, double booked,
           Account<Dim>& edges, Counters& counters, Scratch& scratch) {
  using C = Components<Dim>;
  const Scratch::Frame frame(scratch);
  Box<Dim> faces = w.cells;
  ++faces.hi[Axis];
  const auto nf = static_cast<std::size_t>(faces.size());
  double* area = scratch.take<double>(nf);
  double* flux = scratch.take<double>(nf * C::contents);
  double* velocity = scratch.take<double>(nf * Dim);
  w.stress = scratch.take<double>(w.wide + vector_length);
  {
    const double* p = w.primitive + C::p * w.wide;
    const double* a = w.primitive + static_cast<std::size_t>(C::s) * w.wide;
    if constexpr (Dim == 3 && Axis == 2) {
      for (std::size_t k = 0; k < w.wide; ++k) w.stress[k] = -(a[k] + a[w.wide + k]) - p[k];
    } else {
      a += static_cast<std::size_t>(C::stress(Axis, Axis)) * w.wide;
      for (std::size_t k = 0; k < w.wide; ++k) w.stress[k] = a[k] - p[k];
    }
  }
  if (w.whole)
    whole_areas(w, faces, Axis, area);
  else
    open_areas(w.grid, w.window, geometry, Axis, area);

  const Faces<Dim> out{faces, area, {flux, velocity, nf, 0}};
  if constexpr (!Scheme::by_cells)
    solve_row_by_row<Dim, Axis, Shear, Scheme>(eos, g, w, out, counters);
  else if constexpr (Axis == 0)
    solve_along_rows<Dim, Shear>(eos, g, w, out, counters);
  else
    solve_across_rows<Dim, Axis, Shear>(eos, g, w, out, counters);
  replace_inadmissible_faces<Dim, Axis, Shear, Scheme>(eos, g, w, out, counters);

  const std::ptrdiff_t next = faces.stride(Axis);
  Box<Dim> cell_rows = w.cells;
  cell_rows.hi[0] = cell_rows.lo[0] + 1;
  const int cell_width = w.cells.extent(0);
  for_each(cell_rows, [&](const Index<Dim>& r) {
    const int f = faces.at(r), k = w.cells.at(r);
    const double *low = area + f, *high = area + f + next;
    for (std::size_t c = 0; c < C::contents; ++c) {
      const double* q = flux + c * nf + f;
      double* out = w.rate + c * w.n + k;
#pragma omp simd
      for (int i = 0; i < cell_width; ++i) out[i] += low[i] * q[i] - high[i] * q[i + next];
    }
    for (std::size_t d = 0; d < Dim; ++d) {
      const double* u = velocity + d * nf + f;
      double* out = w.gradient + (d * Dim + Axis) * w.n + k;
#pragma omp simd
      for (int i = 0; i < cell_width; ++i) out[i] += high[i] * u[i + next] - low[i] * u[i];
      if (w.grid.axisymmetric && Axis == 0)
        for (int i = 0; i < cell_width; ++i)
          w.radial[d * w.n + static_cast<std::size_t>(k + i)] = 0.5 * (u[i] + u[i + next]);
    }
  });

  // What passes the edges of the domain. Nothing is booked at periodic ones: it comes back on the other side.
  if (w.grid.periodic(Axis)) return;
  for (int side = 0; side < 2; ++side) {
    const int edge = side == 0 ? 0 : w.grid.cells[Axis];
    if (side == 0 ? w.cells.lo[Axis] != 0 : w.cells.hi[Axis] != edge) continue;
    Box<Dim> face = faces;
    face.lo[Axis] = edge;
    face.hi[Axis] = edge + 1;
    const double sign = side == 0 ? -booked : booked;
    for_each(face, [&](const Index<Dim>& i) {
      const auto k = static_cast<std::size_t>(faces.at(i));
      edges.mass += sign * area[k] * flux[C::rho * nf + k];
      edges.energy += sign * area[k] * flux[C::energy * nf + k];
      for (int d = 0; d < Dim; ++d)
        edges.momentum[d] += sign * area[k] * flux[static_cast<std::size_t>(C::u + d) * nf + k];
    });
  }
}

/// Adds what the walls do to the rates of cut cells, and moves their volumes.
template <int Dim>
void add_walls(BodyBlock<Dim>& b, Work<Dim>& w, double dt) {
  using C = Components<Dim>;
  for (std::size_t m = 0; m < b.geometry.cuts.size(); ++m) {
    const int cell = b.geometry.cuts[m].cell;
    const Wall<Dim>& wall = b.walls[m];
    const auto k = static_cast<std::size_t>(w.cells.at(w.window.index_of(cell)));
    for (int d = 0; d < Dim; ++d) {
      const auto row = static_cast<std::size_t>(d);
      w.rate[(C::u + row) * w.n + k] += wall.force[d];
      for (int e = 0; e < Dim; ++e)
        w.gradient[(row * Dim + static_cast<std::size_t>(e)) * w.n + k] += wall.stretching[row][e];
    }
    w.rate[C::energy * w.n + k] += wall.power;
    b.volume[cell] += dt * wall.volume_rate;
  }
}

/// Puts the fits of the walls where cut cells have no value of their own; the fluxes no longer need what was
/// there.
template <int Dim>
void borrow_wall_values(const BodyBlock<Dim>& b, Work<Dim>& w) {
  if (!w.role) return;
  for (std::size_t m = 0; m < b.geometry.cuts.size(); ++m) {
    const auto k = static_cast<std::size_t>(w.window.at(w.window.index_of(b.geometry.cuts[m].cell)));
    if ((w.role[k] & valued) != 0) continue;
    for (std::size_t c = 0; c < Components<Dim>::primitives; ++c)
      w.primitive[c * w.wide + k] = b.walls[m].value[c];
  }
}

/// Takes the widening of a cell off both r-columns of the gradient and the hoop stress off the radial force
/// (theory: axisymmetry); the divergence keeps the raw r-weighted sums. `plane`: area of the fragment in the
/// (r, z) plane.
template <int Dim>
[[gnu::always_inline]] inline void take_off_widening(const double* value, std::size_t wide, double ur,
                                                     double uz, double plane, double* gradient, double* rate,
                                                     std::size_t n) {
  using C = Components<Dim>;
  gradient[0] -= ur * plane;
  gradient[Dim * n] -= uz * plane;
  const double hoop = -value[C::p * wide] - value[C::s * wide] - value[(C::s + 1) * wide];
  rate[C::u * n] -= hoop * plane;
}

/// A cut cell reads the velocity from its wall where its r-faces are not open.
template <int Dim>
void axisymmetric_cut(const Wall<Dim>& wall, const CutCell<Dim>& cut, Work<Dim>& w) {
  using C = Components<Dim>;
  const Index<Dim> i = w.window.index_of(cut.cell);
  const auto k = static_cast<std::size_t>(w.cells.at(i));
  const double* value = w.primitive + w.window.at(i);
  const double dx = w.grid.dx;
  double ur = value[C::u * w.wide], uz = value[(C::u + 1) * w.wide];
  const auto wide_open = [&](int side) {
    return cut.open[0][side] > 0.3 * w.grid.face_radius(i[0] + side) * dx;
  };
  if ((i[0] == 0 || wide_open(0)) && wide_open(1)) {
    ur = w.radial[k];
    uz = w.radial[w.n + k];
  } else if (wall.donors > 0) {
    const Vec<Dim> r = (w.grid.centre(i) - cut.point) * (1 / dx) + cut.centroid;
    ur = wall.value[C::u] + dot(wall.gradient[C::u], r);
    uz = wall.value[C::u + 1] + dot(wall.gradient[C::u + 1], r);
  }
  take_off_widening<Dim>(value, w.wide, ur, uz, cut.plane_area, w.gradient + k, w.rate + k, w.n);
}

/// Hoop terms of a block: whole cells row by row, then the cut ones.
template <int Dim>
void axisymmetric_sources(const BodyBlock<Dim>& b, Work<Dim>& w) {
  using C = Components<Dim>;
  Box<Dim> rows = w.cells;
  rows.hi[0] = rows.lo[0] + 1;
  const int width = w.cells.extent(0);
  const double area = w.grid.dx * w.grid.dx;
  std::array<double, longest_row> plane;
  for_each(rows, [&](const Index<Dim>& r) {
    for (int from = 0; from < width; from += longest_row) {
      const int count = std::min(width - from, longest_row);
      const int at = w.window.at(r) + from;
      const auto k = static_cast<std::size_t>(w.cells.at(r) + from);
      const auto cell = static_cast<std::size_t>(w.window.cell(r) + from);
      const double* value = w.primitive + at;
      double *ur = w.radial + k, *uz = w.radial + w.n + k;
      if (r[0] + from == 0) *uz = value[(C::u + 1) * w.wide];  // the axis is no face to take a mean with
      for (int i = 0; i < count; ++i) {
        const bool full = w.whole ? !w.role || (w.role[at + i] & regular) != 0
                                  : b.geometry.kind[cell + static_cast<std::size_t>(i)] == CellKind::full;
        plane[i] = full ? area : 0;
      }
#pragma omp simd
      for (int i = 0; i < count; ++i)
        take_off_widening<Dim>(value + i, w.wide, ur[i], uz[i], plane[i], w.gradient + k + i, w.rate + k + i,
                               w.n);
    }
  });
  if (w.whole) return;
  for (std::size_t m = 0; m < b.geometry.cuts.size(); ++m)
    axisymmetric_cut(b.walls[m], b.geometry.cuts[m], w);
}

/// 2 G dev D + W S - S W of one cell, integrated over the fragment. L[(i * Dim + j) * n]: integral of
/// du_i/dx_j.
template <int Dim>
[[gnu::always_inline]] inline void stress_rate(double g, double trace, const double* value, std::size_t wide,
                                               const double* L, double* rate, std::size_t n) {
  using C = Components<Dim>;
  const double rho = value[C::rho * wide];
  std::array<double, Dim * Dim> l, full;
  for (std::size_t c = 0; c < l.size(); ++c) l[c] = L[c * n];
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) {
      const int c = C::stress(i, j);
      full[i * Dim + j] = c >= 0 ? value[static_cast<std::size_t>(C::s + c) * wide]
                                 : -(value[C::s * wide] + value[(C::s + 1) * wide]);
    }
  const auto at = [](const auto& m, int i, int j) { return m[i * Dim + j]; };
  for (int i = 0; i < Dim; ++i)
    for (int j = i; j < Dim; ++j) {
      const int c = C::stress(i, j);
      if (c < 0) continue;
      double sum = g * (at(l, i, j) + at(l, j, i)) - (i == j ? 2 * g * trace / 3 : 0);
      for (int m = 0; m < Dim; ++m)
        sum += 0.5 * (at(l, i, m) - at(l, m, i)) * at(full, m, j) -
               at(full, i, m) * (0.5 * (at(l, m, j) - at(l, j, m)));
      rate[static_cast<std::size_t>(C::s + c) * n] += rho * sum;
    }
}

template <int Dim>
void add_sources(const BodyBlock<Dim>& b, double g, Work<Dim>& w, Scratch& scratch) {
  if (!w.whole) borrow_wall_values(b, w);
  double* trace = scratch.take_filled<double>(w.n, 0);
  for (std::size_t d = 0; d < Dim; ++d)
    for (std::size_t k = 0; k < w.n; ++k) trace[k] += w.gradient[(d * Dim + d) * w.n + k];
  if constexpr (Dim == 2)
    if (w.grid.axisymmetric) axisymmetric_sources(b, w);
  if (!(g > 0)) return;
  Box<Dim> rows = w.cells;
  rows.hi[0] = rows.lo[0] + 1;
  const int width = w.cells.extent(0);
  for_each(rows, [&](const Index<Dim>& r) {
    const double* value = w.primitive + w.window.at(r);
    const auto k = w.cells.at(r);
    const double *L = w.gradient + k, *t = trace + k;
    double* rate = w.rate + k;
#pragma omp simd
    for (int i = 0; i < width; ++i) stress_rate<Dim>(g, t[i], value + i, w.wide, L + i, rate + i, w.n);
  });
}

template <int Dim>
void add_rates(BodyBlock<Dim>& b, const Work<Dim>& w, double dt) {
  const auto all = static_cast<std::size_t>(w.grid.layout().size());
  Box<Dim> rows = w.cells;
  rows.hi[0] = rows.lo[0] + 1;
  const int width = w.cells.extent(0);
  for_each(rows, [&](const Index<Dim>& r) {
    const auto from = static_cast<std::size_t>(w.cells.at(r)),
               to = static_cast<std::size_t>(w.window.cell(r));
    for (std::size_t c = 0; c < Components<Dim>::contents; ++c) {
      const double* rate = w.rate + c * w.n + from;
      double* q = b.contents.data() + c * all + to;
#pragma omp simd
      for (int i = 0; i < width; ++i) q[i] += dt * rate[i];
    }
  });
}

/// What flows into cells that are not real is lost: their values follow from the real ones.
template <int Dim>
void drop_outside(Work<Dim>& w) {
  if (!w.role) return;
  for_each(w.cells, [&](const Index<Dim>& i) {
    if ((w.role[w.window.at(i)] & regular) != 0) return;
    const auto k = static_cast<std::size_t>(w.cells.at(i));
    for (std::size_t c = 0; c < Components<Dim>::contents; ++c) w.rate[c * w.n + k] = 0;
  });
}

template <int Dim, bool Shear, class Scheme, class EosModel>
void update(const State<Dim>& state, const EosModel& eos, Body<Dim>& body, int slot, Cells cells, double dt,
            double weight, Account<Dim>& edges, Counters& counters, Scratch& scratch) {
  using C = Components<Dim>;
  BodyBlock<Dim>& b = body.at(slot);
  const double g = shear_modulus(body.material);
  Work<Dim> w{state.grid(), Window<Dim>(state.mesh, slot, reach, b.matter), b.matter};
  w.n = static_cast<std::size_t>(w.cells.size());
  w.wide = static_cast<std::size_t>(w.window.size());
  w.whole = cells == Cells::whole;
  gather_values(body, slot, eos, g, w, scratch);
  w.rate = scratch.take_filled<double>(w.n * C::contents, 0);
  w.gradient = scratch.take_filled<double>(w.n * Dim * Dim, 0);
  w.radial = scratch.take_filled<double>(state.grid().axisymmetric ? w.n * 2 : 1, 0);
  const double booked = weight * dt;
  sweep<Dim, 0, Shear, Scheme>(eos, g, b.geometry, w, booked, edges, counters, scratch);
  if constexpr (Dim > 1)
    sweep<Dim, 1, Shear, Scheme>(eos, g, b.geometry, w, booked, edges, counters, scratch);
  if constexpr (Dim > 2)
    sweep<Dim, 2, Shear, Scheme>(eos, g, b.geometry, w, booked, edges, counters, scratch);
  if (!w.whole) add_walls(b, w, dt);
  add_sources(b, g, w, scratch);
  if (w.whole) drop_outside(w);
  add_rates(b, w, dt);
}

template <class Scheme, int Dim>
void update_with(const State<Dim>& state, Body<Dim>& body, int slot, Cells cells, double dt, double weight,
                 Account<Dim>& edges, Counters& counters, Scratch& scratch) {
  if (body.at(slot).matter.size() == 0) return;
  std::visit(
      [&](const auto& eos) {
        if (has_strength(body.material.strength))
          update<Dim, true, Scheme>(state, eos, body, slot, cells, dt, weight, edges, counters, scratch);
        else
          update<Dim, false, Scheme>(state, eos, body, slot, cells, dt, weight, edges, counters, scratch);
      },
      body.material.eos);
}

}  // namespace

template <int Dim>
void update_block(const State<Dim>& state, Body<Dim>& body, int slot, double dt, double weight,
                  Account<Dim>& edges, Counters& counters, Scratch& scratch) {
  update_with<WenoHllc>(state, body, slot, Cells::cut, dt, weight, edges, counters, scratch);
}

template <int Dim>
void update_whole_cells(const State<Dim>& state, Body<Dim>& body, int slot, FaceScheme scheme, double dt,
                        double weight, Account<Dim>& edges, Counters& counters, Scratch& scratch) {
  if (scheme == FaceScheme::eno_llf)
    update_with<EnoLlf>(state, body, slot, Cells::whole, dt, weight, edges, counters, scratch);
  else
    update_with<WenoHllc>(state, body, slot, Cells::whole, dt, weight, edges, counters, scratch);
}

#define RECOIL_INSTANTIATE(Dim)                                                                         \
  template void update_block<Dim>(const State<Dim>&, Body<Dim>&, int, double, double, Account<Dim>&,    \
                                  Counters&, Scratch&);                                                 \
  template void update_whole_cells<Dim>(const State<Dim>&, Body<Dim>&, int, FaceScheme, double, double, \
                                        Account<Dim>&, Counters&, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
