#include "gauge/point_probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "dynamics/primitives.hpp"
#include "field/window.hpp"
#include "gauge/corners.hpp"
#include "gauge/level_set_slope.hpp"
#include "gauge/periods.hpp"

namespace recoil {

namespace {

constexpr double outside = 0.5;       // dx, of the surface: as far a point still counts as in the body
constexpr double full = 0.999;        // part of a cell from which on it counts as full
constexpr double fit_reach = 2;       // dx, from the point
constexpr double least_slope = 1e-9;  // ridge of the fit: where a slope cannot be told it is none
constexpr int halo = 4;               // cells read around the one that holds the point

/// What interpolation reads, in this order: density, velocity, pressure, stresses, strain, temperature,
/// molten part.
template <int Dim>
struct At {
  static constexpr std::size_t density = 0, velocity = 1, pressure = 1 + Dim, stress = 2 + Dim,
                               strain = stress + PointState<Dim>::stresses, temperature = strain + 1,
                               molten = temperature + 1, all = molten + 1;
};
template <int Dim>
using Values = std::array<double, At<Dim>::all>;

/// The state of the body in one cell.
template <int Dim>
struct Sample {
  double fill = 0;  // part of the cell
  Vec<Dim> at;      // m, middle of the fragment
  Values<Dim> value{};
};

/// Axes (bits) whose mirrors turn the sign of a stress, in the order of RunUnits::stresses.
template <int Dim>
constexpr std::array<unsigned, PointState<Dim>::stresses> odd_stresses() {
  if constexpr (Dim == 1) return {};
  if constexpr (Dim == 2) return {0, 0, 3, 0};
  if constexpr (Dim == 3) return {0, 0, 3, 5, 6, 0};
}

/// The body around one of its points.
template <int Dim>
struct Around {
  const Grid<Dim>& grid;  // of the block's level
  const Body<Dim>& body;
  Window<Dim> window;
  double far;  // m, beyond which phi is not kept

  double phi(const Index<Dim>& i) const {
    const auto from = window.source(i);
    const bool there = from.slot >= 0 && body.present(from.slot);
    return there ? body.at(from.slot).phi[from.cell] : far;
  }

  /// Middle of the body's fragment of a cell: half of what is missing away from the surface.
  Vec<Dim> middle(const Index<Dim>& i, double fill) const {
    Vec<Dim> slope, x = grid.centre(i);
    for (int d = 0; d < Dim; ++d) {
      Index<Dim> lo = i, hi = i;
      --lo[d], ++hi[d];
      slope[d] = phi(hi) - phi(lo);
    }
    if (fill < full && norm(slope) > 0) x += (-0.5 * (1 - fill) * grid.dx) * unit(slope);
    return x;
  }

  /// Beyond an edge through which matter leaves.
  bool beyond_open(const Index<Dim>& i) const {
    for (int d = 0; d < Dim; ++d)
      if ((i[d] < 0 && grid.edge[d][0] == Edge::outflow) ||
          (i[d] >= grid.cells[d] && grid.edge[d][1] == Edge::outflow))
        return true;
    return false;
  }

  std::optional<Sample<Dim>> sample(const Index<Dim>& i) const {
    if (beyond_open(i)) return {};
    const auto from = window.source(i);
    if (from.slot < 0 || !body.present(from.slot)) return {};
    const BodyBlock<Dim>& b = body.at(from.slot);
    const double volume = b.volume[from.cell], whole = grid.full_volume(i);
    const Contents<Dim> contents = contents_of(b, from.cell);
    if (volume < shown_fill * whole || !(contents[0] > 0)) return {};
    const PointState<Dim> p = point_state(body, contents, volume);
    Sample<Dim> s;
    s.fill = std::min(volume / whole, 1.0);
    s.at = middle(i, s.fill);
    using A = At<Dim>;
    s.value[A::density] = p.density, s.value[A::pressure] = p.pressure;
    s.value[A::strain] = p.plastic_strain, s.value[A::temperature] = p.temperature;
    s.value[A::molten] = p.molten;
    for (int d = 0; d < Dim; ++d)
      s.value[A::velocity + static_cast<std::size_t>(d)] =
          (from.flips >> d & 1U) != 0 ? -p.velocity[d] : p.velocity[d];
    constexpr auto odd = odd_stresses<Dim>();
    for (std::size_t c = 0; c < odd.size(); ++c)
      s.value[A::stress + c] = __builtin_popcount(from.flips & odd[c]) % 2 == 1 ? -p.stress[c] : p.stress[c];
    return s;
  }
};

/// Between full cells; nothing where one of them is not.
template <int Dim>
std::optional<Values<Dim>> between_cells(const Around<Dim>& around, const Vec<Dim>& x) {
  Values<Dim> sum{};
  bool complete = true;
  for_corners(around.grid, x, [&](const Index<Dim>& i, double weight) {
    const auto s = complete ? around.sample(i) : std::nullopt;
    complete = complete && s && s->fill >= full;
    if (!complete) return;
    for (std::size_t q = 0; q < sum.size(); ++q) sum[q] += weight * s->value[q];
  });
  if (!complete) return {};
  return sum;
}

/// Normal equations of a linear fit about a point, and the values' range.
template <int Dim>
struct LinearFit {
  static constexpr std::size_t n = 1 + Dim;
  std::array<std::array<double, n>, n> matrix{};
  std::array<Values<Dim>, n> right{};
  Values<Dim> low, high;

  LinearFit() {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
  }
  /// @param r from the point, in dx.
  void add(const Vec<Dim>& r, double weight, const Values<Dim>& value) {
    std::array<double, n> basis{1};
    for (std::size_t d = 0; d < Dim; ++d) basis[1 + d] = r[static_cast<int>(d)];
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) matrix[a][b] += weight * basis[a] * basis[b];
      for (std::size_t q = 0; q < value.size(); ++q) right[a][q] += weight * basis[a] * value[q];
    }
    for (std::size_t q = 0; q < value.size(); ++q)
      low[q] = std::min(low[q], value[q]), high[q] = std::max(high[q], value[q]);
  }
  /// The function's value at the point: slopes are eliminated from the last one on.
  Values<Dim> value() {
    for (std::size_t d = 1; d < n; ++d) matrix[d][d] += least_slope * matrix[0][0];
    for (std::size_t k = n - 1; k > 0; --k)
      for (std::size_t a = 0; a < k; ++a) {
        const double factor = matrix[a][k] / matrix[k][k];
        for (std::size_t b = 0; b <= k; ++b) matrix[a][b] -= factor * matrix[k][b];
        for (std::size_t q = 0; q < right[a].size(); ++q) right[a][q] -= factor * right[k][q];
      }
    Values<Dim> found;
    for (std::size_t q = 0; q < found.size(); ++q) found[q] = right[0][q] / matrix[0][0];
    using A = At<Dim>;
    for (const std::size_t q : {A::density, A::strain, A::temperature, A::molten})
      found[q] = std::clamp(found[q], low[q], high[q]);
    return found;
  }
};

/// From the cells on the body's own side of its surface; nothing where there are none.
template <int Dim>
std::optional<Values<Dim>> beside_surface(const Around<Dim>& around, const Vec<Dim>& x) {
  const Grid<Dim>& grid = around.grid;
  Vec<Dim> half_back = x;
  for (int d = 0; d < Dim; ++d) half_back[d] -= 0.5 * grid.dx;
  const Index<Dim> low = grid.cell_of(half_back);
  Box<Dim> cells{low, low};
  for (int d = 0; d < Dim; ++d) --cells.lo[d], cells.hi[d] += 3;
  LinearFit<Dim> fit;
  for_each(cells, [&](const Index<Dim>& i) {
    const auto s = around.sample(i);
    if (!s) return;
    const Vec<Dim> r = (s->at - x) * (1 / grid.dx);
    double weight = s->fill;
    for (int d = 0; d < Dim; ++d) weight *= std::max(0.0, 1 - std::abs(r[d]) / fit_reach);
    fit.add(r, weight, s->value);
  });
  if (!(fit.matrix[0][0] > 0)) return {};
  return fit.value();
}

/// The body's state at x; nothing where it is not.
template <int Dim>
std::optional<Values<Dim>> values_at(const Around<Dim>& around, const Vec<Dim>& x) {
  double phi = 0;
  for_corners(around.grid, x, [&](const Index<Dim>& i, double weight) { phi += weight * around.phi(i); });
  if (phi > outside * around.grid.dx) return {};
  if (auto found = between_cells(around, x)) return found;
  return beside_surface(around, x);
}

template <int Dim>
Vec<Dim> velocity_in(const Values<Dim>& values) {
  Vec<Dim> u;
  for (std::size_t d = 0; d < Dim; ++d) u[static_cast<int>(d)] = values[At<Dim>::velocity + d];
  return u;
}

/// Equivalent stress of components in the order of RunUnits::stresses.
template <int Dim>
double von_mises_of(const double* s) {
  std::array<double, 3> direct{s[0], s[1], s[2]};
  double shear2 = 0;
  if constexpr (Dim == 2) direct[2] = s[3], shear2 = s[2] * s[2];
  if constexpr (Dim == 3) direct[2] = s[5], shear2 = s[2] * s[2] + s[3] * s[3] + s[4] * s[4];
  const double a = direct[0] - direct[1], b = direct[1] - direct[2], c = direct[2] - direct[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * shear2);
}

template <int Dim>
void put(const Values<Dim>& v, const Vec<Dim>& x, std::span<ExactSum> to) {
  using A = At<Dim>;
  std::size_t k = 0;
  for (; k < A::strain; ++k) to[k] += v[k];
  to[k++] += von_mises_of<Dim>(v.data() + A::stress);
  to[k++] += v[A::strain];
  to[k++] += v[A::temperature];
  to[k++] += v[A::molten];
  for (int d = 0; d < Dim; ++d) to[k++] += x[d];
}

/// Where a point is dt [s] after the time for which its velocity is known.
template <int Dim>
Vec<Dim> moved(const Around<Dim>& around, const BodyPoint<Dim>& point, double dt) {
  const double dx = around.grid.dx;
  Vec<Dim> x = point.at;
  if (!(point.follows && point.moves && dt > 0 && norm(point.velocity) * dt < dx)) return x;
  const auto ahead = values_at(around, x + dt * point.velocity);
  const Vec<Dim> then = ahead ? velocity_in<Dim>(*ahead) : point.velocity;
  x += (0.5 * dt) * (norm(then) * dt < dx ? point.velocity + then : 2.0 * point.velocity);
  return x;
}

/// The cell of the domain that holds x; a point on the domain's high edge belongs to the last one.
template <int Dim>
Index<Dim> cell_in_domain(const Grid<Dim>& grid, const Vec<Dim>& x) {
  constexpr double on_edge = 1e-6;  // dx
  Index<Dim> i = grid.cell_of(x);
  for (int d = 0; d < Dim; ++d) {
    const double beyond = (x[d] - grid.origin[d]) / grid.dx - grid.cells[d];
    if (i[d] == grid.cells[d] && beyond <= on_edge) --i[d];
  }
  return i;
}

}  // namespace

template <int Dim>
void probe_point(const State<Dim>& state, const BodyPoint<Dim>& point, int item, ExactSums& sums) {
  if (state.bodies[point.body].rigid) return;
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    const Grid<Dim>& grid = state.grid(slot);
    const Index<Dim> i = cell_in_domain(grid, point.at);
    if (!state.mesh.block(slot).cells.contains(i)) continue;
    Box<Dim> own{i, i};
    for (int d = 0; d < Dim; ++d) ++own.hi[d];
    bool found = false;
    for_each_part(state, point.body, [&](int m) {
      if (found) return;
      const Around<Dim> around{grid, state.bodies[m], Window<Dim>(state.mesh, slot, halo, own),
                               far_cells * state.grid().dx};
      const Vec<Dim> x = moved(around, point, state.time - point.time);
      if (const auto values = values_at(around, x)) {
        put<Dim>(*values, into_domain(state.grid(), x), sums.add(item).sums);
        found = true;
      }
    });
    return;
  }
}

template <int Dim>
void follow_point(BodyPoint<Dim>& point, double time, bool found, std::span<const double> sums) {
  point.time = time;
  point.moves = found;
  if (!found) return;
  for (int d = 0; d < Dim; ++d) {
    point.velocity[d] = sums[1 + static_cast<std::size_t>(d)];
    point.at[d] = sums[point_sums<Dim> - Dim + static_cast<std::size_t>(d)];
  }
}

#define RECOIL_INSTANTIATE(Dim)                                                              \
  template void probe_point<Dim>(const State<Dim>&, const BodyPoint<Dim>&, int, ExactSums&); \
  template void follow_point<Dim>(BodyPoint<Dim>&, double, bool, std::span<const double>);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
