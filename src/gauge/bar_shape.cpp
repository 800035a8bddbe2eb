#include "gauge/bar_shape.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "field/window.hpp"
#include "gauge/point_state.hpp"
#include "state/level_set_view.hpp"

namespace recoil {

namespace {

constexpr double touching = 0.1;    // dx, gap below which foot and wall are in contact
constexpr double rim_place = 0.95;  // of the foot's radius, where its lift-off is read
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

template <int Dim>
constexpr int axis = Dim - 1;

template <int Dim>
double radius_of(const Vec<Dim>& x) {
  if constexpr (Dim == 3) return std::hypot(x[0], x[1]);
  return std::abs(x[0]);
}

/// Places in a row of ExactSums. Sums: volume by row of cells across the axis. Maxima: two strains, both
/// ends, the radius by row, and minus the gap under the foot by distance from the axis in cells.
template <int Dim>
struct At {
  std::size_t rows, rings;
  std::size_t volume = 0, strain, axis_strain, highest, minus_lowest, axis_highest, minus_axis_lowest, radius,
              minus_gap, all;

  explicit At(const Grid<Dim>& grid) : rows(static_cast<std::size_t>(grid.cells[axis<Dim>])) {
    Vec<Dim> far;
    for (int d = 0; d < Dim; ++d)
      far[d] = std::max(std::abs(grid.origin[d]), std::abs(grid.origin[d] + grid.cells[d] * grid.dx));
    rings = static_cast<std::size_t>(std::ceil(radius_of(far) / grid.dx)) + 1;
    strain = rows, axis_strain = strain + 1, highest = strain + 2, minus_lowest = strain + 3;
    axis_highest = strain + 4, minus_axis_lowest = strain + 5, radius = strain + 6, minus_gap = radius + rows,
    all = minus_gap + rings;
  }
};

/// The surface between the centres of neighbouring cells of one block, beginning with the cells of the block.
/// f(cell, axis of the pair, place of the surface, phi of the wall there)
template <int Dim, class F>
void for_crossings(const State<Dim>& state, const BarWatch& bar, int slot, F&& f) {
  const Grid<Dim>& grid = state.grid(slot);
  const Window<Dim> window(state.mesh, slot, 1);
  const auto size = static_cast<std::size_t>(window.size());
  std::vector<double> own(size), wall(size);
  const auto gather = [&](int m, std::vector<double>& to) {
    view_level_set(grid, state.bodies[m], window, &BodyBlock<Dim>::phi, to.data());
  };
  gather(bar.body, own);
  gather(bar.wall, wall);
  for_each(window.inner(), [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(window.at(i));
    for (int d = 0; d < Dim; ++d) {
      const auto next = k + static_cast<std::size_t>(window.stride(d));
      if ((own[k] < 0) == (own[next] < 0)) continue;
      const double t = own[k] / (own[k] - own[next]);
      Vec<Dim> x = grid.centre(i);
      x[d] += t * grid.dx;
      f(i, d, x, own[k] < 0, wall[k] + t * (wall[next] - wall[k]));
    }
  });
}

template <int Dim>
void add_strains(const State<Dim>& state, const BodyBlock<Dim>& b, int slot, const At<Dim>& at,
                 const SumRow& row) {
  using C = Components<Dim>;
  const Box<Dim> cells = state.mesh.block(slot).cells;
  const int parts = 1 << state.mesh.block(slot).level;
  const Grid<Dim>& grid = state.grid(slot);
  const std::size_t n = b.volume.size();
  for_each(cells, [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(grid.layout().at(i - cells.lo));
    for (int part = 0; part < parts; ++part)  // rows of the finest cells
      row[at.volume + static_cast<std::size_t>(i[axis<Dim>] * parts + part)] += b.volume[k] / parts;
    if (b.volume[k] < shown_fill * grid.full_volume(i) || !(b.contents[k] > 0)) return;
    const double ep = b.contents[C::ep * n + k] / b.contents[k];
    row.raise(at.strain, ep);
    if (radius_of(grid.centre(i)) < grid.dx) row.raise(at.axis_strain, ep);
  });
}

/// The gap under the foot at a distance from the axis; linear between the rings that have one.
struct Underside {
  double dx = 0;
  std::span<const double> minus_gap;

  double place(std::size_t ring) const { return (static_cast<double>(ring) + 0.5) * dx; }
  bool known(std::size_t ring) const { return ring < minus_gap.size() && std::isfinite(minus_gap[ring]); }
  double gap(std::size_t ring) const { return -minus_gap[ring]; }

  double at(double r) const {
    double last = nowhere;
    for (std::size_t k = 0; k < minus_gap.size(); ++k) {
      if (!known(k)) continue;
      if (place(k) <= r && known(k + 1) && place(k + 1) > r)
        return gap(k) + (r - place(k)) / dx * (gap(k + 1) - gap(k));
      if (place(k) <= r || std::isnan(last)) last = gap(k);
    }
    return last;
  }
  double at_rim() const {
    for (std::size_t k = minus_gap.size(); k-- > 0;)
      if (known(k)) return gap(k);
    return nowhere;
  }
  /// Outermost place at which the gap is that of contact.
  double contact(double foot_radius) const {
    const double limit = touching * dx;
    for (std::size_t k = minus_gap.size(); k-- > 0;) {
      if (!known(k) || !(gap(k) < limit)) continue;
      const double step = known(k + 1) ? (limit - gap(k)) / (gap(k + 1) - gap(k)) : 0.5;
      return std::min(place(k) + std::min(step, 1.0) * dx, foot_radius);
    }
    return 0;
  }
};

}  // namespace

template <int Dim>
int bar_item(const Grid<Dim>& grid, ExactSums& sums) {
  const At<Dim> at(grid);
  return sums.item(at.rows, at.all - at.rows);
}

template <int Dim>
void collect_bar(const State<Dim>& state, const BarWatch& bar, int item, ExactSums& sums) {
  const Grid<Dim>& grid = state.grid();
  const At<Dim> at(grid);
  const Body<Dim>& body = state.bodies[bar.body];
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    if (body.rigid || !body.present(slot)) continue;
    const Block<Dim>& block = state.mesh.block(slot);
    const SumRow row = sums.add(item);
    const auto raise = [&row](std::size_t where, double value) { row.raise(where, value); };
    add_strains(state, body.at(slot), slot, at, row);
    if (block.level > 0) continue;  // no surface is there
    for_crossings(state, bar, slot,
                  [&](const Index<Dim>& i, int d, const Vec<Dim>& x, bool below, double gap) {
                    if (d != axis<Dim>)
                      return raise(at.radius + static_cast<std::size_t>(i[axis<Dim>]), radius_of(x));
                    raise(at.highest, x[d]);
                    raise(at.minus_lowest, -x[d]);
                    if (radius_of(x) < grid.dx)
                      raise(at.axis_highest, x[d]), raise(at.minus_axis_lowest, -x[d]);
                    if (below == bar.foot_low) return;  // the other side of the head
                    const auto ring = static_cast<std::size_t>(radius_of(x) / grid.dx);
                    raise(at.minus_gap + std::min(ring, at.rings - 1), -gap);
                  });
  }
}

template <int Dim>
BarReading read_bar(const Grid<Dim>& grid, BarWatch& bar, std::span<const double> total) {
  const At<Dim> at(grid);
  BarReading r;
  const double highest = total[at.highest], lowest = -total[at.minus_lowest];
  if (!std::isfinite(highest))
    return {nowhere, nowhere, nowhere, nowhere, nowhere, nowhere, nowhere, nowhere, nowhere};
  r.length = bar.foot_low ? total[at.axis_highest] - lowest : highest + total[at.minus_axis_lowest];
  r.volume_radius = grid.has_radius() ? 0 : nowhere;
  const auto place = [&](std::size_t row) {
    return grid.origin[axis<Dim>] + (static_cast<double>(row) + 0.5) * grid.dx;
  };
  for (std::size_t k = 0; k < at.rows; ++k) {
    r.radius = std::max(r.radius, total[at.radius + k]);
    // A full row of radius R holds R^2/2 dx per radian.
    if (grid.has_radius())
      r.volume_radius =
          std::max(r.volume_radius, std::sqrt(2 * std::max(total[at.volume + k], 0.0) / grid.dx));
  }
  if (!(bar.start_radius > 0)) bar.start_radius = r.radius;
  for (std::size_t k = 0; k < at.rows; ++k)
    if ((bar.foot_low ? place(k) - lowest : highest - place(k)) <= 0.5 * bar.start_radius)
      r.foot_radius = std::max(r.foot_radius, total[at.radius + k]);
  const Underside foot{grid.dx, total.subspan(at.minus_gap, at.rings)};
  r.contact_radius = foot.contact(r.foot_radius);
  r.lift_off = foot.at(rim_place * r.foot_radius);
  r.rim_lift_off = foot.at_rim();
  r.plastic_strain = std::max(total[at.strain], 0.0);
  r.axis_plastic_strain = std::max(total[at.axis_strain], 0.0);
  return r;
}

#define RECOIL_INSTANTIATE(Dim)                                                        \
  template int bar_item<Dim>(const Grid<Dim>&, ExactSums&);                            \
  template void collect_bar<Dim>(const State<Dim>&, const BarWatch&, int, ExactSums&); \
  template BarReading read_bar<Dim>(const Grid<Dim>&, BarWatch&, std::span<const double>);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
