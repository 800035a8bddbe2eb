#include "dynamics/block_sources.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/constants.hpp"
#include "core/error.hpp"
#include "core/multiversion.hpp"
#include "dynamics/flux.hpp"
#include "state/rim_fluxes.hpp"

namespace recoil::detail {

namespace {

/// Puts the fits of the walls where cut cells have no value of their own; the fluxes no longer need what was
/// there.
template <int Dim>
void borrow_wall_values(const BodyBlock<Dim>& b, Work<Dim>& w) {
  if (!w.role) return;
  for (std::size_t m = 0; m < b.geometry.cuts.size(); ++m) {
    const int k = w.window.at(w.window.index_of(b.geometry.cuts[m].cell));
    if ((w.role[k] & valued) != 0) continue;
    for (std::size_t c = 0; c < Components<Dim>::primitives; ++c)
      w.primitive[c * w.wide + k] = b.walls[m].value[c];
  }
}

// NOLINTBEGIN(readability-non-const-parameter): what depends on the dimension is written to

/// Takes the widening of a cell off the r-columns of the gradient and the hoop stresses off the radial force
/// (theory: axisymmetry); the divergence keeps the raw weighted sums. `u`: velocity for the widening;
/// `hoop_area`: CutCell::hoop_area. What is at rest (AtRest) has neither, as faces let nothing pass.
template <int Dim>
[[gnu::always_inline]] inline void take_off_widening(const AtRest& rest, const double* value,
                                                     std::size_t wide, const std::array<double, Dim>& u,
                                                     double hoop_area, double* gradient, double* rate,
                                                     std::size_t n) {
  using C = Components<Dim>;
  gradient[0] -= u[0] * hoop_area;
  double hoop = -value[C::p * wide];
  if constexpr (Dim == 2) {
    gradient[Dim * n] -= (std::abs(u[1]) <= rest.speed ? 0.0 : u[1]) * hoop_area;
    hoop = hoop - value[C::s * wide] - value[(C::s + 1) * wide];
  } else {
    hoop -= 0.5 * value[C::s * wide];
  }
  rate[C::u * n] -= (std::abs(hoop) <= rest.stress ? 0.0 : hoop) * hoop_area;
}

/// take_off_widening() of a row of cells; `radial`: velocities as Work::radial has them.
template <int Dim>
RECOIL_MULTIVERSION void take_off_widenings(const AtRest& at_rest, int count, const double* value,
                                            std::size_t wide, const double* radial, const double* hoop_area,
                                            double* gradient, double* rate, std::size_t n) {
  const AtRest rest = at_rest;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    std::array<double, Dim> u;
    for_each_axis<Dim>([&](auto d) RECOIL_INLINE { u[d] = radial[d * n + static_cast<std::size_t>(i)]; });
    take_off_widening<Dim>(rest, value + i, wide, u, hoop_area[i], gradient + i, rate + i, n);
  }
}

/// A cut cell reads the velocity from its wall where its r-faces are not open.
template <int Dim>
void widen_cut(const AtRest& rest, const Wall<Dim>& wall, const CutCell<Dim>& cut, Work<Dim>& w) {
  using C = Components<Dim>;
  const Index<Dim> i = w.window.index_of(cut.cell);
  const int k = w.cells.at(i);
  const double* value = w.primitive + w.window.at(i);
  const double dx = w.grid.dx, area = w.grid.dx_power(Dim - 1);
  const auto wide_open = [&](int side) {
    return cut.open[0][side] > 0.3 * w.grid.face_weight(i[0] + side) * area;
  };
  const bool by_faces = (i[0] == 0 || wide_open(0)) && wide_open(1), by_wall = !by_faces && wall.donors > 0;
  const Vec<Dim> r = (w.grid.centre(i) - cut.point) * (1 / dx) + cut.centroid;
  std::array<double, Dim> u;
  for (std::size_t d = 0; d < Dim; ++d)
    u[d] = by_faces  ? w.radial[d * w.n + static_cast<std::size_t>(k)]
           : by_wall ? wall.value[C::u + d] + dot(wall.gradient[C::u + d], r)
                     : value[(C::u + d) * w.wide];
  take_off_widening<Dim>(rest, value, w.wide, u, cut.hoop_area, w.gradient + k, w.rate + k, w.n);
}

/// Hoop terms of a block: whole cells row by row, then the cut ones.
template <int Dim>
void widening_sources(const AtRest& rest, const BodyBlock<Dim>& b, Work<Dim>& w) {
  using C = Components<Dim>;
  Box<Dim> rows = w.cells;
  rows.hi[0] = rows.lo[0] + 1;
  const int width = w.cells.extent(0);
  std::array<double, longest_row> hoop_area;
  for_each(rows, [&](const Index<Dim>& r) {
    for (int from = 0; from < width; from += longest_row) {
      const int count = std::min(width - from, longest_row);
      const int at = w.window.at(r) + from;
      const int k = w.cells.at(r) + from, cell = w.window.cell(r) + from;
      const double* value = w.primitive + at;
      if (Dim == 2 && r[0] + from == 0)  // the axis is no face to take a mean with
        w.radial[w.n + static_cast<std::size_t>(k)] = value[(C::u + 1) * w.wide];
      for (int i = 0; i < count; ++i) {
        const bool full = w.whole ? !w.role || (w.role[at + i] & regular) != 0
                                  : b.geometry.kind[cell + i] == CellKind::full;
        hoop_area[i] = full ? w.grid.hoop_area(r[0] + from + i) : 0;
      }
      take_off_widenings<Dim>(rest, count, value, w.wide, w.radial + k, hoop_area.data(), w.gradient + k,
                              w.rate + k, w.n);
    }
  });
  if (w.whole) return;
  for (std::size_t m = 0; m < b.geometry.cuts.size(); ++m) widen_cut(rest, b.walls[m], b.geometry.cuts[m], w);
}

/// 2 G dev D + W S - S W of one cell, integrated over the fragment. L[(i * Dim + j) * n]: integral of
/// du_i/dx_j.
template <int Dim>
[[gnu::always_inline]] inline void stress_rate(double g, double trace, const double* value, std::size_t wide,
                                               const double* L, double* rate, std::size_t n) {
  using C = Components<Dim>;
  const double rho = value[C::rho * wide];
  // Axes are constants to the compiler: it leaves loops over cells with loops over axes in them as they are.
  std::array<double, Dim * Dim> l, stress;
  for_each_axis<Dim>([&](auto i) RECOIL_INLINE {
    for_each_axis<Dim>([&](auto j) RECOIL_INLINE {
      constexpr int c = C::stress(i, j);
      l[i * Dim + j] = L[(i * Dim + j) * n];
      if constexpr (c >= 0)
        stress[i * Dim + j] = value[(C::s + c) * wide];
      else
        stress[i * Dim + j] = -(value[C::s * wide] + value[(C::s + 1) * wide]);
    });
  });
  for_each_axis<Dim>([&](auto i) RECOIL_INLINE {
    for_each_axis<Dim>([&](auto j) RECOIL_INLINE {
      constexpr int c = C::stress(i, j);
      if constexpr (j >= i && c >= 0) {
        double sum = g * (l[i * Dim + j] + l[j * Dim + i]) - (i == j ? 2 * g * trace / 3 : 0);
        for_each_axis<Dim>([&](auto m) RECOIL_INLINE {
          sum += 0.5 * (l[i * Dim + m] - l[m * Dim + i]) * stress[m * Dim + j] -
                 stress[i * Dim + m] * (0.5 * (l[m * Dim + j] - l[j * Dim + m]));
        });
        rate[(C::s + c) * n] += rho * sum;
      }
    });
  });
}
// NOLINTEND(readability-non-const-parameter)

/// stress_rate() of a row of cells.
template <int Dim>
RECOIL_MULTIVERSION void stress_rates(const double* g, int count, const double* trace, const double* value,
                                      std::size_t wide, const double* L, double* rate, std::size_t n) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) stress_rate<Dim>(g[i], trace[i], value + i, wide, L + i, rate + i, n);
}

/// A face of a finer block at its place in a side.
template <int Dim>
struct FinerFace {
  const double* rims;
  const RimFluxes<Dim>& layout;
  int axis, side;
  Index<Dim> local;
  double area;

  double operator[](std::size_t component) const { return rims[layout.at(axis, side, component, local)]; }
};

/// f(finer face) for those that make up face i of a block, across a side (0 low, 1 high).
template <int Dim, class F>
void for_each_finer_face(const LevelSides<Dim>& at, const std::array<int, power<Dim>(2)>& finer, int axis,
                         int side, const Index<Dim>& i, const RimFluxes<Dim>& layout, F&& f) {
  const Grid<Dim>& grid = at.mesh.level_grid(at.mesh.block(at.slot).level - 1);
  for (unsigned c = 0; c < 1U << Dim; ++c) {
    if ((c >> axis & 1U) != 0) continue;
    Index<Dim> j;
    for (int d = 0; d < Dim; ++d) j[d] = 2 * i[d] + static_cast<int>(c >> d & 1U);
    Index<Dim> beyond = j;  // the finer cell beside the face
    if (side == 0) --beyond[axis];
    for (int d = 0; d < Dim; ++d)
      if (grid.periodic(d)) beyond[d] = (beyond[d] + grid.cells[d]) % grid.cells[d];
    bool found = false;
    for (const int s : finer) {
      if (s < 0 || !at.mesh.block(s).cells.contains(beyond) || !at.body.present(s)) continue;
      const auto& rims = at.body.at(s).rims;
      require(!rims.empty(), "fluxes of the finer level");
      f(FinerFace<Dim>{rims.data(), layout, axis, 1 - side, beyond - at.mesh.block(s).cells.lo,
                       grid.full_area(j, axis)});
      found = true;
    }
    require(found, "a finer block with the same body");
  }
}

}  // namespace

template <int Dim>
void meet_other_levels(const Faces<Dim>& faces, int axis, const Work<Dim>& w) {
  const LevelSides<Dim>& at = *w.sides;
  const RimFluxes<Dim> layout(w.grid);
  const FaceFlux<Dim>& flux = faces.flux;
  for (int side = 0; side < 2; ++side) {
    Box<Dim> plane = faces.box;
    plane.lo[axis] = side == 0 ? faces.box.lo[axis] : faces.box.hi[axis] - 1;
    plane.hi[axis] = plane.lo[axis] + 1;
    if (at.mesh.coarser_across(at.slot, axis, side) >= 0) {
      auto& rims = at.body.at(at.slot).rims;
      if (rims.empty()) rims.assign(layout.size(), 0.0);
      for_each(plane, [&](const Index<Dim>& i) {
        const auto k = static_cast<std::size_t>(faces.box.at(i));
        const Index<Dim> local = i - at.mesh.block(at.slot).cells.lo;
        for (std::size_t c = 0; c < w.carried(); ++c)
          rims[layout.at(axis, side, c, local)] = flux.flux[c * flux.faces + k];
        for (std::size_t d = 0; d < Dim; ++d)
          rims[layout.at(axis, side, RimFluxes<Dim>::contents + d, local)] =
              flux.velocity[d * flux.faces + k];
      });
    }
    const auto finer = at.mesh.finer_across(at.slot, axis, side);
    if (std::all_of(finer.begin(), finer.end(), [](int s) { return s < 0; })) continue;
    for_each(plane, [&](const Index<Dim>& i) {
      const auto k = static_cast<std::size_t>(faces.box.at(i));
      if (!(faces.area[k] > 0)) return;
      std::array<double, RimFluxes<Dim>::components> sum{};
      for_each_finer_face(at, finer, axis, side, i, layout, [&](const FinerFace<Dim>& face) {
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += face.area * face[c];
      });
      for (std::size_t c = 0; c < w.carried(); ++c) flux.flux[c * flux.faces + k] = sum[c] / faces.area[k];
      for (std::size_t d = 0; d < Dim; ++d)
        flux.velocity[d * flux.faces + k] = sum[RimFluxes<Dim>::contents + d] / faces.area[k];
    });
  }
}

template <int Dim>
void add_walls(BodyBlock<Dim>& b, Work<Dim>& w, double dt) {
  using C = Components<Dim>;
  for (std::size_t m = 0; m < b.geometry.cuts.size(); ++m) {
    const int cell = b.geometry.cuts[m].cell;
    const Wall<Dim>& wall = b.walls[m];
    const int k = w.cells.at(w.window.index_of(cell));
    for (int d = 0; d < Dim; ++d) {
      w.rate[(C::u + d) * w.n + k] += wall.force[d];
      for (int e = 0; e < Dim; ++e) w.gradient[(d * Dim + e) * w.n + k] += wall.stretching[d][e];
    }
    w.rate[C::energy * w.n + k] += wall.power;
    b.volume[cell] += dt * wall.volume_rate;
  }
}

template <int Dim>
void add_sources(const Body<Dim>& body, int slot, Work<Dim>& w, Scratch& scratch) {
  const BodyBlock<Dim>& b = body.at(slot);
  if (!w.whole) borrow_wall_values(b, w);
  double* trace = scratch.take<double>(w.n);
  for (std::size_t k = 0; k < w.n; ++k) {
    double sum = 0;
    for (std::size_t d = 0; d < Dim; ++d) sum += w.gradient[(d * Dim + d) * w.n + k];
    trace[k] = sum;
  }
  if constexpr (Dim < 3)
    if (w.grid.has_radius()) widening_sources(AtRest(AnyEos{body.material.eos}), b, w);
  if (!has_strength(body.material.strength)) return;
  Box<Dim> rows = w.cells;
  rows.hi[0] = rows.lo[0] + 1;
  const int width = w.cells.extent(0);
  for_each(rows, [&](const Index<Dim>& r) {
    const double* value = w.primitive + w.window.at(r);
    const auto k = w.cells.at(r);
    stress_rates<Dim>(w.shear + w.window.at(r), width, trace + k, value, w.wide, w.gradient + k, w.rate + k,
                      w.n);
  });
}

#define RECOIL_INSTANTIATE(Dim)                                                   \
  template void meet_other_levels<Dim>(const Faces<Dim>&, int, const Work<Dim>&); \
  template void add_walls<Dim>(BodyBlock<Dim>&, Work<Dim>&, double);              \
  template void add_sources<Dim>(const Body<Dim>&, int, Work<Dim>&, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil::detail
