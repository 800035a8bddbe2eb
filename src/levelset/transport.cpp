#include "levelset/transport.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/mul_add.hpp"
#include "core/multiversion.hpp"
#include "levelset/cuts_in_view.hpp"
#include "material/eos/isentrope.hpp"
#include "material/eos/quick_exp.hpp"
#include "state/level_set_view.hpp"

namespace recoil {

namespace {

/// HJ-WENO5 (Jiang & Peng 2000): the slope at a cell from five one-sided ones, from upwind to downwind. The
/// weights are multiplied out, so that there is one division.
[[gnu::always_inline]] inline double weno_slope(double v1, double v2, double v3, double v4, double v5) {
  constexpr double least = 1e-6;
  const auto measure = [](double second, double first) {
    const double s = mul_add(13.0 / 12 * second, second, mul_add(0.25 * first, first, least));
    return s * s;
  };
  const double q1 = measure(v1 - 2 * v2 + v3, v1 - 4 * v2 + 3 * v3), q2 = measure(v2 - 2 * v3 + v4, v2 - v4),
               q3 = measure(v3 - 2 * v4 + v5, 3 * v3 - 4 * v4 + v5);
  const double a = q2 * q3, b = 6 * (q1 * q3), c = 3 * (q1 * q2);
  return (a * (2 * v1 - 7 * v2 + 11 * v3) + b * (-v2 + 5 * v3 + 2 * v4) + c * (2 * v3 + 5 * v4 - v5)) /
         (6 * (a + b + c));
}

/// u . grad phi of a row of cells, each derivative from the side that the flow comes from. `u`: component
/// after component, n apart.
template <int Dim>
RECOIL_MULTIVERSION void advection_row(const Box<Dim>& window, const double* phi, const double* u,
                                       std::size_t n, int count, double h, double* sum) {
  for (int i = 0; i < count; ++i) sum[i] = 0;
  const double per_h = 1 / h;
  for (std::size_t d = 0; d < Dim; ++d) {
    const int st = window.stride(static_cast<int>(d));
    const double* speed = u + d * n;
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
      const double* p = phi + i;
      const double a = p[-2 * st] - p[-3 * st], b = p[-st] - p[-2 * st], c = p[0] - p[-st], e = p[st] - p[0],
                   f = p[2 * st] - p[st], g = p[3 * st] - p[2 * st];
      const bool up = speed[i] > 0;
      const double v1 = up ? a : g, v2 = up ? b : f, v3 = up ? c : e, v4 = up ? e : c, v5 = up ? f : b;
      sum[i] += speed[i] * weno_slope(v1 * per_h, v2 * per_h, v3 * per_h, v4 * per_h, v5 * per_h);
    }
  }
}

/// Calls f(cell, place in the window, count, u . grad phi) for every row of a window's own cells.
template <int Dim, class F>
void for_each_advected_row(const Grid<Dim>& grid, const BodyBlock<Dim>& b, const Window<Dim>& w,
                           const double* phi, Scratch& scratch, F&& f) {
  const auto n = static_cast<std::size_t>(grid.layout().size());
  const int count = w.inner().extent(0);
  double* sum = scratch.take<double>(static_cast<std::size_t>(count));
  Box<Dim> rows = w.inner();
  rows.hi[0] = rows.lo[0] + 1;
  for_each(rows, [&](const Index<Dim>& i) {
    const auto cell = static_cast<std::size_t>(w.cell(i));
    const int k = w.at(i);
    advection_row(w.box(), phi + k, b.extension_velocity.data() + cell, n, count, grid.dx, sum);
    f(cell, k, count, sum);
  });
}

template <int Dim>
bool moves(const BodyBlock<Dim>& b) {
  return std::any_of(b.extension_velocity.begin(), b.extension_velocity.end(),
                     [](double u) { return u != 0; });
}

constexpr double allowed_overlap = 0.1;  // [dx] of a body and a rigid one; contacts stay below
constexpr int surface_reach = 8;         // foot points lie up to 5 cells away, the walls asked there 3 more

/// Four numbers that are computed with at once: three components and a weight.
using Four [[gnu::vector_size(32)]] = double;
constexpr int last_of_four = 3;

/// The walls of the cut cells that a window shows, as their neighbours see them: number by number, one array
/// for each component.
template <int Dim>
struct WallsInView {
  std::array<double*, Dim> point;
  double* share;   // what counts of them: their area, in faces of a cell, and a little more
  Four* velocity;  // and a 1 behind it
};

constexpr double least_share = 0.02;

template <int Dim>
WallsInView<Dim> walls_in_view(const Grid<Dim>& grid, const Body<Dim>& body, const Window<Dim>& w,
                               const CutsInView& cuts, Scratch& scratch) {
  const auto count = static_cast<std::size_t>(cuts.count);
  WallsInView<Dim> walls;
  for (double*& component : walls.point) component = scratch.take<double>(count);
  walls.share = scratch.take<double>(count);
  walls.velocity = scratch.take_filled<Four>(count, Four{0, 0, 0, 1});
  const double per_area = 1 / grid.dx_power(Dim - 1);
  for (int m = 0; m < cuts.count; ++m) {
    const Index<Dim> i = w.box().index(cuts.cell[m]);
    const auto from = w.source(i);
    const BodyBlock<Dim>& home = body.at(from.slot);
    const auto at = static_cast<std::size_t>(home.geometry.index[from.cell]);
    const CutCell<Dim>& cut = home.geometry.cuts[at];
    const Vec<Dim> point = w.appear(i, from, cut.point), &velocity = home.walls[at].mean_velocity;
    walls.share[m] = norm(cut.surface) * per_area / grid.weight(i[0]) + least_share;
    for (int d = 0; d < Dim; ++d) {
      walls.point[d][m] = point[d];
      walls.velocity[m][d] = (from.flips >> d & 1U) != 0 ? -velocity[d] : velocity[d];
    }
  }
  return walls;
}

constexpr int widest_ring = 3;  // cells about a foot point in which walls are looked for

/// A list of walls about a point: where they are from there, component after component.
template <int Dim>
struct WallList {
  static constexpr int most = power<Dim>(2 * widest_ring + 1);
  std::array<std::array<double, most>, Dim> r;
  std::array<double, most> share, weight;
  std::array<int, most> number;
};

/// Adds up velocities and weights exp(-steepness r^2) times the share of the walls of a list.
template <int Dim>
RECOIL_MULTIVERSION void add_velocities(int count, double steepness, const Four* velocity,
                                        WallList<Dim>& list, Four& sum) {
#pragma GCC ivdep
  for (int c = 0; c < count; ++c) {
    double square = 0;
    for (std::size_t d = 0; d < Dim; ++d) square += list.r[d][c] * list.r[d][c];
    list.weight[c] = quick_exp(-steepness * square) * list.share[c];
  }
  Four all{};
  for (int c = 0; c < count; ++c) all += list.weight[c] * velocity[list.number[c]];
  sum = all;
}

/// Lists the walls of the cut cells of a box about x. @returns how many there are.
template <int Dim>
int list_walls(const CutsInView& cuts, const WallsInView<Dim>& walls, const Box<Dim>& window,
               const Box<Dim>& box, const Vec<Dim>& x, WallList<Dim>& list) {
  int count = 0;
  for_each_row_of_cuts(cuts, window, box, [&](const Index<Dim>&, int, int first, int end) {
    for (int m = first; m < end; ++m, ++count) {
      for (std::size_t d = 0; d < Dim; ++d) list.r[d][count] = walls.point[d][m] - x.c[d];
      list.share[count] = walls.share[m];
      list.number[count] = m;
    }
  });
  return count;
}

/// The mean velocity of the walls about a point x of the surface. @returns whether there are any.
template <int Dim>
bool mean_wall_velocity(const Grid<Dim>& grid, const Box<Dim>& window, const CutsInView& cuts,
                        const WallsInView<Dim>& walls, const Vec<Dim>& x, WallList<Dim>& list, Vec<Dim>& u) {
  const double steepness = 2 / (grid.dx * grid.dx);
  const Index<Dim> centre = grid.cell_of(x);
  Four sum{};
  for (int reach = 1; reach <= widest_ring && sum[last_of_four] == 0; ++reach) {
    const int count = list_walls(cuts, walls, window, around_cell(centre, reach, window), x, list);
    add_velocities<Dim>(count, steepness, walls.velocity, list, sum);
  }
  const double weights = sum[last_of_four];
  if (!(weights > 0)) return false;
  for (int d = 0; d < Dim; ++d) u[d] = sum[d] * (1 / weights);
  return true;
}

constexpr double followed_cells = 2;  // [dx] farther cells need not follow: each step redistances them
constexpr double near_body = 1.5;     // [dx] nearer to the surface of another body contact may close soon
// [dx] of growth of the mismatch in a step: that of corners which cross cells and of slow contact; taken up.
constexpr double usual_growth = 0.005, most_growth = 0.05;
constexpr int ring = 2;               // cells about a foot point whose mismatch counts
constexpr double fragment_depth = 1;  // [dx] matter that can fail and is nowhere deeper follows faster
using Bell = std::array<double, 2 * ring + 1>;

/// exp(-(x + k)^2) for k = -2..2 along every axis: exp(-x^2) exp(-2 x k) exp(-k^2).
template <int Dim>
void bells_about(const Vec<Dim>& x, std::array<Bell, Dim>& bell) {
  constexpr double e1 = 0.36787944117144233, e4 = 0.018315638888734179;
  for (std::size_t d = 0; d < Dim; ++d) {
    const double middle = quick_exp(-x.c[d] * x.c[d]), up = quick_exp(-2 * x.c[d]), down = 1 / up;
    bell[d] = {middle * down * down * e4, middle * down * e1, middle, middle * up * e1,
               middle * up * up * e4};
  }
}

/// The lags that the last step left; those of this step start as not known.
template <int Dim>
const double* lag_before(BodyBlock<Dim>& b, double unknown, Scratch& scratch) {
  double* before = scratch.take<double>(b.lag.size());
  std::copy(b.lag.begin(), b.lag.end(), before);
  std::fill(b.lag.begin(), b.lag.end(), unknown);
  return before;
}

/// Whether a cell is so near to another deformable body that their contact may close. Not of gases: a film of
/// gas between plates becomes thinner than a cell, and its surfaces must not cross.
template <int Dim>
bool may_touch(const State<Dim>& state, const Body<Dim>& body, int slot, std::size_t k) {
  if (is_gas(body.material.eos)) return false;
  return std::any_of(state.bodies.begin(), state.bodies.end(), [&](const Body<Dim>& other) {
    return &other != &body && !other.rigid && other.present(slot) &&
           other.at(slot).phi[k] < near_body * state.grid().dx && !is_gas(other.material.eos);
  });
}

/// What phi takes up of the growth of a mismatch h; nothing where that before is not known (far).
double growth(double before, double h, double dx) {
  const double grown = std::min(h - before, h) - usual_growth * dx;
  return std::clamp(grown, 0.0, most_growth * dx);
}

/// Whether the body is nowhere deeper than fragment_depth around a cell.
template <int Dim>
bool is_fragment(const Box<Dim>& box, const double* phi, const Index<Dim>& near, double dx) {
  bool deep = false;
  for_each(around_cell(near, ring, box),
           [&](const Index<Dim>& j) { deep = deep || phi[box.at(j)] <= -fragment_depth * dx; });
  return !deep;
}

}  // namespace

template <int Dim>
void spread_wall_velocity(const State<Dim>& state, Body<Dim>& body, int slot, double dt, Counters& counters,
                          Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  std::fill(b.extension_velocity.begin(), b.extension_velocity.end(), 0.0);
  if (!b.near_surface || b.reach.size() == 0) return;
  const Grid<Dim>& grid = state.grid();
  const double dx = grid.dx;
  const Window<Dim> w(state.mesh, slot, surface_reach, b.reach);
  const double* phi = view_level_set(state.grid(), body, w, &BodyBlock<Dim>::phi_midstep, scratch);
  const CutsInView cuts = cuts_in_view(
      w, [&](int s) { return body.present(s) ? body.at(s).geometry.index.data() : nullptr; }, scratch);
  const WallsInView<Dim> walls = walls_in_view(grid, body, w, cuts, scratch);
  WallList<Dim> list;
  const auto cells = static_cast<std::size_t>(grid.layout().size());
  for_each(w.inner(), [&](const Index<Dim>& i) {
    if (std::abs(phi[w.at(i)]) >= carried_cells * dx) return;
    const auto k = static_cast<std::size_t>(w.cell(i));
    Vec<Dim> u;
    const Vec<Dim> foot = foot_point(grid, w.box(), phi, i).point;
    if (!mean_wall_velocity(grid, w.box(), cuts, walls, foot, list, u) && (b.role[k] & regular) != 0)
      for (int d = 0; d < Dim; ++d)
        u[d] = b.average[static_cast<std::size_t>(Components<Dim>::u + d) * cells + k];
    const double step = norm(u) * dt;
    if (step > dx) {
      u *= dx / step;
      ++counters.capped_speeds;
    }
    for (int d = 0; d < Dim; ++d) b.extension_velocity[static_cast<std::size_t>(d) * cells + k] = u[d];
  });
}

template <int Dim>
void advect_level_set(const State<Dim>& state, Body<Dim>& body, int slot, double dt,
                      FieldArray<double> BodyBlock<Dim>::*out, Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  b.*out = b.phi;
  if (!b.near_surface || b.reach.size() == 0 || !moves(b)) return;
  const Grid<Dim>& grid = state.grid();
  const Window<Dim> w(state.mesh, slot, 3, b.reach);
  const double* phi = view_level_set(state.grid(), body, w, &BodyBlock<Dim>::phi, scratch);
  for_each_advected_row(grid, b, w, phi, scratch,
                        [&](std::size_t cell, int, int count, const double* change) {
                          double* p = (b.*out).data() + cell;
                          for (int i = 0; i < count; ++i) p[i] -= dt * change[i];
                        });
}

template <int Dim>
void advect_level_set_again(const State<Dim>& state, Body<Dim>& body, int slot, double dt, Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  if (!b.near_surface || b.reach.size() == 0 || !moves(b)) return;
  const Grid<Dim>& grid = state.grid();
  const double far = far_cells * grid.dx;
  const Window<Dim> w(state.mesh, slot, 3, b.reach);
  const double* phi = view_level_set(state.grid(), body, w, &BodyBlock<Dim>::phi_next, scratch);
  for_each_advected_row(grid, b, w, phi, scratch,
                        [&](std::size_t cell, int k, int count, const double* change) {
                          double* p = b.phi.data() + cell;
                          for (int i = 0; i < count; ++i)
                            p[i] = std::clamp(0.5 * (p[i] + (phi[k + i] - dt * change[i])), -far, far);
                        });
}

template <int Dim>
void follow_volume(const State<Dim>& state, Body<Dim>& body, int slot, const Following& following,
                   Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  b.phi_next = b.phi;
  if (!b.near_surface || b.reach.size() == 0) return;
  const Grid<Dim>& grid = state.grid();
  const double dx = grid.dx;
  const double* before = lag_before(b, far_cells * dx, scratch);
  const Window<Dim> w(state.mesh, slot, surface_reach, b.reach);
  const double* phi = view_level_set(state.grid(), body, w, &BodyBlock<Dim>::phi, scratch);
  const CutsInView cuts = cuts_in_view(
      w, [&](int s) { return body.present(s) ? body.at(s).end_geometry.index.data() : nullptr; }, scratch);
  const bool may_fail = can_fail(body.material.damage);
  double* mismatch = scratch.take<double>(static_cast<std::size_t>(cuts.count));
  double* failed = scratch.take<double>(static_cast<std::size_t>(cuts.count));
  for (int m = 0; m < cuts.count; ++m) {
    const auto from = w.source(w.box().index(cuts.cell[m]));
    const Geometry<Dim>& g = body.at(from.slot).end_geometry;
    const CutCell<Dim>& cut = g.cuts[g.index[from.cell]];
    mismatch[m] = cut.mismatch;
    failed[m] = cut.failed ? 1 : 0;
  }
  for_each(w.inner(), [&](const Index<Dim>& i) {
    if (std::abs(phi[w.at(i)]) >= followed_cells * dx) return;
    const Foot<Dim> foot = foot_point(grid, w.box(), phi, i);
    const Index<Dim> near = grid.cell_of(foot.point);
    std::array<Bell, Dim> bell;
    Vec<Dim> off = grid.centre(near) - foot.point;
    for (int d = 0; d < Dim; ++d) off[d] /= dx;
    bells_about<Dim>(off, bell);
    double sum = 0, failing = 0, weights = 0;
    for_each_row_of_cuts(cuts, w.box(), around_cell(near, ring, w.box()),
                         [&](const Index<Dim>& j, int at, int first, int end) {
                           const int from_near = j[0] - near[0] + ring - at;
                           Vec<Dim> across;
                           for (int d = 1; d < Dim; ++d) across[d] = bell[d][j[d] - near[d] + ring];
                           for (int m = first; m < end; ++m) {
                             double weight = bell[0][cuts.cell[m] + from_near];
                             for (int d = 1; d < Dim; ++d) weight *= across[d];
                             sum += weight * mismatch[m];
                             failing += weight * failed[m];
                             weights += weight;
                           }
                         });
    if (!(weights > 1e-3)) return;
    const auto k = static_cast<std::size_t>(w.cell(i));
    const double h = sum / weights;
    double part = failing / weights;
    if (may_fail && part < 1 && is_fragment(w.box(), phi, near, dx)) part = 1;
    double step = (following.rate + part * (following.rate_failed - following.rate)) * h;
    if (following.growth_beside_bodies && may_touch(state, body, slot, k)) step += growth(before[k], h, dx);
    b.phi_next[k] -= step;
    b.lag[k] = h - step;
  });
}

template <int Dim>
void place_rigid(const State<Dim>& state, Body<Dim>& body, int slot, double ahead, PhiAt where) {
  const Grid<Dim>& grid = state.grid();
  const double far = far_cells * grid.dx;
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = grid.layout();
  BodyBlock<Dim>& b = body.at(slot);
  double* phi = where == PhiAt::midstep ? b.phi_midstep.data() : b.phi.data();
  const RigidPose<Dim> pose = pose_after(*body.rigid, ahead);
  for_each(cells, [&](const Index<Dim>& i) {
    phi[layout.at(i - cells.lo)] = std::clamp(distance_at(*body.rigid, pose, grid.centre(i)), -far, far);
  });
}

template <int Dim>
void cut_out_rigid(const State<Dim>& state, Body<Dim>& body, int slot) {
  BodyBlock<Dim>& b = body.at(slot);
  const double slack = allowed_overlap * state.grid().dx;
  if (!b.near_surface) return;
  for (const Body<Dim>& other : state.bodies) {
    if (!other.rigid || !other.present(slot)) continue;
    const double* rigid = other.at(slot).phi.data();
    for (std::size_t k = 0; k < b.phi.size(); ++k) b.phi[k] = std::max(b.phi[k], -rigid[k] - slack);
  }
}

#define RECOIL_INSTANTIATE(Dim)                                                                             \
  template void spread_wall_velocity<Dim>(const State<Dim>&, Body<Dim>&, int, double, Counters&, Scratch&); \
  template void advect_level_set<Dim>(const State<Dim>&, Body<Dim>&, int, double,                           \
                                      FieldArray<double> BodyBlock<Dim>::*, Scratch&);                      \
  template void advect_level_set_again<Dim>(const State<Dim>&, Body<Dim>&, int, double, Scratch&);          \
  template void follow_volume<Dim>(const State<Dim>&, Body<Dim>&, int, const Following&, Scratch&);         \
  template void place_rigid<Dim>(const State<Dim>&, Body<Dim>&, int, double, PhiAt);                        \
  template void cut_out_rigid<Dim>(const State<Dim>&, Body<Dim>&, int);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
