#include "gauge/probes.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/primitives.hpp"
#include "gauge/level_set_slope.hpp"
#include "gauge/periods.hpp"

namespace recoil {

namespace {

constexpr double near_reach = 2, far_reach = 4;  // dx
constexpr double least_area = 0.02;              // of dx^(Dim-1): least weight of a sliver of surface

/// Whether some cells are near one of the domain, also across the edge of a period.
template <int Dim>
bool are_near(const Grid<Dim>& grid, const Box<Dim>& cells, const Index<Dim>& centre) {
  constexpr int reach = static_cast<int>(far_reach) + 1;
  for (int d = 0; d < Dim; ++d) {
    bool near = false;
    for (int period = grid.periodic(d) ? -1 : 0; period <= (grid.periodic(d) ? 1 : 0); ++period) {
      const int i = centre[d] + period * grid.cells[d];
      near = near || (i >= cells.lo[d] - reach && i < cells.hi[d] + reach);
    }
    if (!near) return false;
  }
  return true;
}

/// This rank's blocks in which a body, or a fragment of it, may have surface near x: f(slot, body).
template <int Dim, class F>
void for_blocks_near(const State<Dim>& state, int body, const Vec<Dim>& x, F&& f) {
  const Index<Dim> centre = state.grid().cell_of(into_domain(state.grid(), x));
  for_each_part(state, body, [&](int m) {
    const Body<Dim>& b = state.bodies[m];
    for (int slot = 0; slot < state.mesh.local(); ++slot)
      if (b.present(slot) && state.mesh.block(slot).level == 0 &&
          are_near(state.grid(), state.mesh.block(slot).cells, centre))
        f(slot, b);
  });
}

/// Square of a distance, in dx^2.
template <int Dim>
double cells_apart2(const Vec<Dim>& a, const Vec<Dim>& b, double dx) {
  const Vec<Dim> r = (a - b) * (1 / dx);
  return dot(r, r);
}

template <int Dim>
bool within_reach(const Vec<Dim>& piece, const Vec<Dim>& point, double dx) {
  return cells_apart2(piece, point, dx) <= far_reach * far_reach;
}

/// A piece of surface.
template <int Dim>
struct Piece {
  Vec<Dim> at, velocity, normal;
};

/// f(image) for a piece of surface and its images beyond the reflecting edges that are near x, the axis among
/// them: so a point on such an edge stays there.
template <int Dim, class F>
void for_images(const Grid<Dim>& grid, const Vec<Dim>& x, const Piece<Dim>& piece, F&& f) {
  Vec<Dim> edge;
  unsigned near = 0;  // axes, as bits
  for (int d = 0; d < Dim; ++d)
    for (int side = 0; side < 2; ++side) {
      const double at = grid.origin[d] + (side == 0 ? 0 : grid.cells[d]) * grid.dx;
      if (grid.edge[d][side] != Edge::reflect || !(std::abs(x[d] - at) <= far_reach * grid.dx)) continue;
      edge[d] = at;
      near |= 1U << d;
    }
  for (unsigned flips = 0; flips < 1U << Dim; ++flips) {
    if ((flips & ~near) != 0) continue;
    Piece<Dim> image = piece;
    for (int d = 0; d < Dim; ++d) {
      if ((flips >> d & 1U) == 0) continue;
      image.at[d] = 2 * edge[d] - piece.at[d];
      image.velocity[d] = -piece.velocity[d];
      image.normal[d] = -piece.normal[d];
    }
    f(image);
  }
}

/// Adds weight times velocity and normal to the near and far sums.
template <int Dim>
void add_reading(const SumRow& row, double r2, double weight, const Vec<Dim>& velocity,
                 const Vec<Dim>& normal) {
  for (std::size_t part = r2 <= near_reach * near_reach ? 0 : 1; part < 2; ++part) {
    const std::span<ExactSum> to = row.sums.subspan(part * (1 + 2 * Dim));
    to[0] += weight;
    for (int d = 0; d < Dim; ++d) {
      const auto k = static_cast<std::size_t>(d);
      to[1 + k] += weight * velocity[d];
      to[1 + Dim + k] += weight * normal[d];
    }
  }
}

}  // namespace

template <int Dim>
void probe_surface(const State<Dim>& state, const SurfacePoint<Dim>& point, int item, ExactSums& sums) {
  const double dx = state.grid().dx;
  for_blocks_near(state, point.body, point.at, [&](int slot, const Body<Dim>& body) {
    const BodyBlock<Dim>& b = body.at(slot);
    for (std::size_t m = 0; m < std::min(b.walls.size(), b.geometry.cuts.size()); ++m) {
      const CutCell<Dim>& cut = b.geometry.cuts[m];
      const Wall<Dim>& wall = b.walls[m];
      const Vec<Dim> at = image_near(state.grid(), cut.point, point.at);
      if (!within_reach(at, point.at, dx)) continue;
      const Box<Dim> cells = state.mesh.block(slot).cells;
      const Index<Dim> i = cells.lo + state.grid().layout().index(cut.cell);
      const double area = norm(cut.surface) / (state.grid().dx_power(Dim - 1) * state.grid().weight(i[0]));
      const Piece<Dim> own{at, wall.mean_velocity, wall.normal};
      for_images(state.grid(), point.at, own, [&](const Piece<Dim>& piece) {
        if (!within_reach(piece.at, point.at, dx)) return;
        const double r2 = cells_apart2(piece.at, point.at, dx);
        if (point.normal != Vec<Dim>{} && !(dot(piece.normal, point.normal) > 0)) return;
        add_reading(sums.add(item), r2, std::exp(-2 * r2) * (area + least_area), piece.velocity,
                    piece.normal);
      });
    }
  });
}

template <int Dim>
void probe_surface_at_rest(const State<Dim>& state, const SurfacePoint<Dim>& point, int item,
                           ExactSums& sums) {
  using C = Components<Dim>;
  const double dx = state.grid().dx;
  const Box<Dim> layout = state.grid().layout();
  for_blocks_near(state, point.body, point.at, [&](int slot, const Body<Dim>& body) {
    const BodyBlock<Dim>& b = body.at(slot);
    const Box<Dim> cells = state.mesh.block(slot).cells;
    const std::size_t n = b.volume.size();
    const Window<Dim> window(state.mesh, slot, 1);
    for_each(cells, [&](const Index<Dim>& i) {
      const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
      const Vec<Dim> centre = image_near(state.grid(), state.grid().centre(i), point.at);
      if (!within_reach(centre, point.at, dx) || n == 0 || !(b.contents[k] > 0)) return;
      Vec<Dim> velocity;
      for (int d = 0; d < Dim; ++d)
        velocity[d] = b.contents[static_cast<std::size_t>(C::u + d) * n + k] / b.contents[k];
      const Piece<Dim> own{centre, velocity, level_set_slope(window, body, i, 1, far_cells * dx)};
      for_images(state.grid(), point.at, own, [&](const Piece<Dim>& piece) {
        if (!within_reach(piece.at, point.at, dx)) return;
        const double r2 = cells_apart2(piece.at, point.at, dx);
        add_reading(sums.add(item), r2, std::exp(-2 * r2), piece.velocity, piece.normal);
      });
    });
  });
}

template <int Dim>
SurfaceReading<Dim> read_surface(std::span<const double> sums) {
  SurfaceReading<Dim> r;
  const double* from = sums.data();
  if (!(from[0] > 0)) from += 1 + 2 * Dim;
  if (!(from[0] > 0)) return r;
  r.found = true;
  for (int d = 0; d < Dim; ++d) {
    r.velocity[d] = from[1 + d] / from[0];
    r.normal[d] = from[1 + Dim + d];
  }
  r.normal = unit(r.normal);
  return r;
}

template <int Dim>
void follow_surface(const Grid<Dim>& grid, SurfacePoint<Dim>& point, const SurfaceReading<Dim>& reading,
                    double dt) {
  if (!reading.found) return;
  point.normal = reading.normal;
  point.at += dot(reading.velocity, reading.normal) * dt * reading.normal;
  point.at = into_domain(grid, point.at);
}

#define RECOIL_INSTANTIATE(Dim)                                                                           \
  template void probe_surface<Dim>(const State<Dim>&, const SurfacePoint<Dim>&, int, ExactSums&);         \
  template void probe_surface_at_rest<Dim>(const State<Dim>&, const SurfacePoint<Dim>&, int, ExactSums&); \
  template SurfaceReading<Dim> read_surface<Dim>(std::span<const double>);                                \
  template void follow_surface<Dim>(const Grid<Dim>&, SurfacePoint<Dim>&, const SurfaceReading<Dim>&, double);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
