#include "interface/fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "dynamics/half_step.hpp"
#include "dynamics/plastic_return.hpp"
#include "dynamics/primitives.hpp"
#include "state/level_set_view.hpp"

namespace recoil {

namespace {

// Donors lie within these distances [dx] from the surface point, and their weights fall with the square of
// the distance at these rates [1/dx^2]. Along a flat surface the reach is wide: the layers of cells that a
// slanted surface cuts then hold every phase of the cut, and a fit depends less on its own. It ends where the
// weight has fallen to a seventeenth; with a weight of a third at its end the fits of a surface at 45 degrees
// grow unstable. Where the radius of curvature is 10 dx or less, reach and rate are those across: a wide fit
// would leave the layers along the surface. In 3-D, which has two directions along the surface, a wider one
// would cost too much.
constexpr double reach_across = 2.35, decay_across = 0.6, decay_wide = 0.3;
template <int Dim>
constexpr double decay_along = Dim == 3 ? 0.35 : 0.15;
constexpr double end_exponent = 2.84, most_curved = 0.1;
constexpr double fit_ridge = 0.006;  // of the total weight, on the diagonal of the gradient's matrix
constexpr double deepest_rarefaction = 0.4,
                 highest_compression =
                     0.6;     // of the donors' mean density: the
                              // fitted density leaves it at most so far; what is cut is counted
constexpr int fit_reach = 7;  // the widest box reaches 6 cells, the surface point lies at most 1 away

template <int Dim>
using Matrix = std::array<Vec<Dim>, Dim>;

/// Inverse of a symmetric positive matrix by its adjugate.
template <int Dim>
Matrix<Dim> inverse(const Matrix<Dim>& m) {
  Matrix<Dim> a;
  if constexpr (Dim == 1) {
    a[0][0] = 1 / m[0][0];
  } else if constexpr (Dim == 2) {
    const double det = 1 / (m[0][0] * m[1][1] - m[0][1] * m[0][1]);
    a[0][0] = m[1][1] * det;
    a[1][1] = m[0][0] * det;
    a[0][1] = a[1][0] = -m[0][1] * det;
  } else {
    const double c00 = m[1][1] * m[2][2] - m[1][2] * m[1][2], c01 = m[0][2] * m[1][2] - m[0][1] * m[2][2],
                 c02 = m[0][1] * m[1][2] - m[0][2] * m[1][1];
    const double det = 1 / (m[0][0] * c00 + m[0][1] * c01 + m[0][2] * c02);
    a[0][0] = c00 * det;
    a[0][1] = a[1][0] = c01 * det;
    a[0][2] = a[2][0] = c02 * det;
    a[1][1] = (m[0][0] * m[2][2] - m[0][2] * m[0][2]) * det;
    a[1][2] = a[2][1] = (m[0][2] * m[0][1] - m[0][0] * m[1][2]) * det;
    a[2][2] = (m[0][0] * m[1][1] - m[0][1] * m[0][1]) * det;
  }
  return a;
}

/// Where the donors of one fit lie, and how their weights fall with the distance from the surface point.
template <int Dim>
struct Reach {
  Vec<Dim> normal;  // of the surface
  double along = 0, decay = 0;
  Index<Dim> half;  // cells around that of the surface point
  int widened = 0;  // a box of so many cells, the same in all directions, where the matter is far; else 0

  bool holds(const Vec<Dim>& x, double across2, double along2) const {
    if (widened == 0) return across2 <= reach_across * reach_across && along2 <= along * along;
    bool inside = true;
    for (int d = 0; d < Dim; ++d) inside = inside && std::abs(x[d]) <= widened;
    return inside;
  }
  double weight(double across2, double along2) const {
    return widened == 0 ? std::exp(-decay_across * across2 - decay * along2)
                        : std::exp(-decay_wide * (across2 + along2));
  }
};

/// @param curvature of the surface, times dx.
template <int Dim>
Reach<Dim> reach_of(const Vec<Dim>& surface, double curvature, int widened) {
  const double bent = std::min(std::abs(curvature) / most_curved, 1.0);
  Reach<Dim> r{unit(surface), 0, decay_along<Dim> + bent * (decay_across - decay_along<Dim>), {}, widened};
  r.along = std::max(reach_across, std::sqrt(end_exponent / r.decay));
  for (int d = 0; d < Dim; ++d) {
    const double tangent = std::sqrt(std::max(0.0, 1 - r.normal[d] * r.normal[d]));
    const double extent = reach_across * std::abs(r.normal[d]) + r.along * tangent;
    r.half[d] = widened > 0 ? widened : static_cast<int>(std::lround(extent));
  }
  return r;
}

/// Mean curvature of a level set at a cell, times dx.
template <int Dim>
double curvature_at(const Window<Dim>& w, const double* phi, int k, double dx) {
  double sum = 0;
  for (int d = 0; d < Dim; ++d) sum += phi[k - w.stride(d)] + phi[k + w.stride(d)] - 2 * phi[k];
  return sum / (dx * std::max(Dim - 1, 1));
}

/// The donors around one surface point. Appends to block.donors; places go to `slope_weight`.
template <int Dim>
int collect(const State<Dim>& state, const Body<Dim>& body, const Window<Dim>& w, const std::uint8_t* role,
            const Vec<Dim>& point, const Reach<Dim>& reach, FieldArray<Donor<Dim>>& donors) {
  const Grid<Dim>& grid = state.grid();
  Vec<Dim> at;
  Box<Dim> box;
  for (int d = 0; d < Dim; ++d) {
    at[d] = (point[d] - grid.origin[d]) / grid.dx - 0.5;
    const int centre = static_cast<int>(std::floor(at[d] + 0.5));
    box.lo[d] = std::max(centre - reach.half[d], w.box().lo[d]);
    box.hi[d] = std::min(centre + reach.half[d] + 1, w.box().hi[d]);
  }
  const std::size_t before = donors.size();
  for_each(box, [&](const Index<Dim>& i) {
    if ((role[w.at(i)] & donates) == 0) return;
    const auto from = w.source(i);
    const BodyBlock<Dim>& home = body.at(from.slot);
    Vec<Dim> x;
    for (int d = 0; d < Dim; ++d) x[d] = i[d] - at[d];
    const int cut = home.geometry.index[from.cell];
    if (cut >= 0) {
      const Vec<Dim>& centroid = home.geometry.cuts[cut].centroid;
      for (int d = 0; d < Dim; ++d) x[d] += (from.flips >> d & 1U) != 0 ? -centroid[d] : centroid[d];
    }
    const double across = dot(x, reach.normal), across2 = across * across,
                 along2 = std::max(0.0, dot(x, x) - across2);
    if (!reach.holds(x, across2, along2)) return;
    const Index<Dim> home_cell = state.mesh.block(from.slot).cells.lo + grid.layout().index(from.cell);
    const double fill = home.volume[from.cell] / grid.full_volume(home_cell);
    donors.push_back(
        {from.slot, from.cell, from.flips, reach.weight(across2, along2) * std::min(fill, 1.0), x});
  });
  return static_cast<int>(donors.size() - before);
}

/// From weights and places (kept in slope_weight) to the coefficients of mean and gradient.
template <int Dim>
void solve(Wall<Dim>& wall, FieldArray<Donor<Dim>>& donors) {
  double total = 0;
  Vec<Dim> first;
  Matrix<Dim> second{};
  const auto begin = donors.begin() + wall.first_donor, end = begin + wall.donors;
  for (auto it = begin; it != end; ++it) {
    total += it->weight;
    for (int d = 0; d < Dim; ++d) {
      first[d] += it->weight * it->slope_weight[d];
      for (int e = d; e < Dim; ++e) second[d][e] += it->weight * it->slope_weight[d] * it->slope_weight[e];
    }
  }
  const Vec<Dim> mean = first * (1 / total);
  for (int d = 0; d < Dim; ++d)
    for (int e = d; e < Dim; ++e) {
      double& m = second[d][e];
      m -= total * mean[d] * mean[e];
      if (d == e) m += fit_ridge * total;
      second[e][d] = m;
    }
  const Matrix<Dim> a = inverse<Dim>(second);
  wall.donor_centre = mean;
  for (auto it = begin; it != end; ++it) {
    const Vec<Dim> x = it->slope_weight - mean;
    for (int d = 0; d < Dim; ++d) it->slope_weight[d] = it->weight * dot(a[d], x);
    it->weight /= total;
  }
}

/// A cut cell whose matter is too little to be fitted moves with what it holds.
template <int Dim>
void lone_fit(const Body<Dim>& body, const BodyBlock<Dim>& b, int cell, double full, Wall<Dim>& wall) {
  using C = Components<Dim>;
  wall.value = {};
  wall.range = {};
  wall.gradient = {};
  wall.value[C::rho] = density(body.material);
  const Contents<Dim> q = contents_of(b, cell);
  if (q[C::rho] > 1e-9 * full * density(body.material))
    for (std::size_t d = 0; d < Dim; ++d) wall.value[C::u + d] = q[C::u + d] / q[C::rho];
}

/// Range of S_xx + S_yy, that is of S_zz, which has no place of its own.
template <int Dim>
double trace_range(const Body<Dim>& body, const Wall<Dim>& wall, const Donor<Dim>* donors, std::size_t n) {
  using C = Components<Dim>;
  double low = 0, high = 0;
  for (int k = 0; k < wall.donors; ++k) {
    const double* s =
        body.at(donors[k].slot).average.data() + C::s * n + static_cast<std::size_t>(donors[k].cell);
    const double v = s[0] + s[n];
    low = k == 0 ? v : std::min(low, v);
    high = k == 0 ? v : std::max(high, v);
  }
  return high - low;
}

/// Weighted sums over donors of the first `count` primitives: differences from the first donor's values.
template <int Dim, std::size_t count>
struct DonorSums {
  std::array<double, count> base{}, mean{}, low{}, high{};
  std::array<std::array<double, count>, Dim> gradient{};
};

/// Signs of all components for each set of axes across which a donor is seen in a mirror.
template <int Dim>
constexpr auto mirror_signs() {
  std::array<std::array<double, Components<Dim>::primitives>, 1U << Dim> signs{};
  for (unsigned flips = 0; flips < signs.size(); ++flips)
    for (std::size_t c = 0; c < signs[flips].size(); ++c)
      signs[flips][c] = component_sign<Dim>(static_cast<int>(c), flips);
  return signs;
}

/// Donor by donor: all components of a cell at once, whose sums lie side by side.
template <int Dim, std::size_t count>
DonorSums<Dim, count> sum_donors(const Body<Dim>& body, const Donor<Dim>* donors, int number, std::size_t n) {
  static constexpr auto signs = mirror_signs<Dim>();
  DonorSums<Dim, count> sums;
  for (int k = 0; k < number; ++k) {
    const Donor<Dim>& donor = donors[k];
    const double* from = body.at(donor.slot).average.data() + donor.cell;
    std::array<double, count> v;
    for (std::size_t c = 0; c < count; ++c) v[c] = from[c * n];
    if (donor.flips != 0)
      for (std::size_t c = 0; c < count; ++c) v[c] *= signs[donor.flips][c];
    if (k == 0) sums.base = sums.low = sums.high = v;
#pragma omp simd
    for (std::size_t c = 0; c < count; ++c) {
      sums.low[c] = v[c] < sums.low[c] ? v[c] : sums.low[c];
      sums.high[c] = sums.high[c] < v[c] ? v[c] : sums.high[c];
      v[c] -= sums.base[c];
      sums.mean[c] += donor.weight * v[c];
    }
    for (int d = 0; d < Dim; ++d) {
      const double weight = donor.slope_weight[d];
      std::array<double, count>& gradient = sums.gradient[static_cast<std::size_t>(d)];
#pragma omp simd
      for (std::size_t c = 0; c < count; ++c) gradient[c] += v[c] * weight;
    }
  }
  return sums;
}

template <int Dim, class EosModel>
void evaluate(const EosModel& eos, const Body<Dim>& body, const BodyBlock<Dim>& b, Wall<Dim>& wall,
              std::size_t n, Counters& counters) {
  using C = Components<Dim>;
  constexpr std::size_t count = EosModel::barotropic ? C::primitives : C::contents;
  const Donor<Dim>* const donors = b.donors.data() + wall.first_donor;
  const auto sums = sum_donors<Dim, count>(body, donors, wall.donors, n);
  for (std::size_t c = 0; c < count; ++c) {
    const double mean = sums.mean[c] + sums.base[c], low = sums.low[c], high = sums.high[c];
    for (std::size_t d = 0; d < Dim; ++d) wall.gradient[c][static_cast<int>(d)] = sums.gradient[d][c];
    wall.range[c] = high - low;
    const double at_surface = mean - dot(wall.gradient[c], wall.donor_centre), slack = 0.5 * (high - low);
    wall.value[c] = c == C::rho || c >= C::ep ? mean : std::clamp(at_surface, low - slack, high + slack);
  }
  const double rho = wall.value[C::rho], mean_p = sums.mean[C::p] + sums.base[C::p];
  const auto& matter = frozen(eos, wall.value[C::crushed]);
  const double c2 = std::max(matter.sound_speed_squared(rho, mean_p), least_wall_sound_squared(matter));
  const double change = (wall.value[C::p] - mean_p) / c2,
               kept = std::clamp(change, -deepest_rarefaction * rho, highest_compression * rho);
  if (kept != change) ++counters.clamped_fit_densities;
  wall.value[C::rho] = rho + kept;
  wall.value[C::ep] = std::max(0.0, wall.value[C::ep]);
  wall.range[C::extra] = Dim == 3 ? trace_range(body, wall, donors, n) : 0;
}

/// 1/|S| where the fitted state is at yield and its gradients load it on, else 0.
template <int Dim, class EosModel>
double loading_of(const EosModel& eos, const Body<Dim>& body, const Primitives<Dim>& w, double working) {
  using C = Components<Dim>;
  if (!(working > 0)) return 0;
  const auto& matter = frozen(eos, w[C::crushed]);
  double e = matter.energy(w[C::rho], w[C::p]);
  if constexpr (EosModel::barotropic) e += w[C::extra];
  const double square = equivalent_stress_squared<Dim>(w.data() + C::s, 1);
  e -= distortion_energy(square, shear_modulus(body.material), w[C::rho]);
  const double temperature = body.temperature(w[C::rho], e, w[C::temperature_rise]);
  const double yielding = yield(body.material.strength, {.ep = w[C::ep],
                                                         .temperature = temperature,
                                                         .pressure = w[C::p],
                                                         .compression = w[C::rho] / matter.rho0});
  return square > 0 && square >= at_yield * yielding * yielding ? std::sqrt(1.5 / square) : 0;
}

template <int Dim, class EosModel>
void move_fit(const EosModel& eos, const Grid<Dim>& grid, const Body<Dim>& body, const CutCell<Dim>& cut,
              double time, Wall<Dim>& wall) {
  using C = Components<Dim>;
  const Primitives<Dim> w = wall.value;
  std::array<Primitives<Dim>, Dim> slope{};
  double working = 0;
  for_each_axis<Dim>([&](auto d) {
    for (std::size_t c = 0; c < w.size(); ++c) slope[d][c] = wall.gradient[c][d] / grid.dx;
    working += working_along<Dim, d>(w, slope[d]);
  });
  const double g = shear_modulus(body.material);
  const auto& matter = frozen(eos, w[C::crushed]);
  const double c2 =
      std::max(matter.sound_speed_squared(w[C::rho], w[C::p]), least_wall_sound_squared(matter));
  const Response m{w[C::rho] * c2, g, g > 0 ? loading_of(eos, body, w, working) : 0};
  Primitives<Dim> rate{};
  for_each_axis<Dim>([&](auto d) {
    const auto along = rate_along<Dim, d>(w, slope[d], w[C::u + d], m);
    for (std::size_t c = 0; c < w.size(); ++c) rate[c] += along[c];
  });
  if constexpr (Dim == 2)
    if (grid.axisymmetric && cut.point[0] > grid.dx)
      add_widening(w, w[C::u] / cut.point[0], 1 / cut.point[0], m, rate);
  for (std::size_t c = 0; c < w.size(); ++c) wall.value[c] += time * rate[c];
}

}  // namespace

template <int Dim>
void choose_donors(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters, Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  b.donors.clear();
  b.walls.assign(b.geometry.cuts.size(), {});
  if (b.geometry.cuts.empty()) return;
  const Window<Dim> w(state.mesh, slot, fit_reach, b.matter);
  auto* role = scratch.take<std::uint8_t>(static_cast<std::size_t>(w.size()));
  w.gather([&](int s) { return body.present(s) ? body.at(s).role.data() : nullptr; }, std::uint8_t{0},
           Beyond::extend, role);
  const double* phi = view_level_set(state.grid(), body, w, &BodyBlock<Dim>::phi, scratch);
  for (std::size_t m = 0; m < b.walls.size(); ++m) {
    Wall<Dim>& wall = b.walls[m];
    wall.first_donor = static_cast<int>(b.donors.size());
    const CutCell<Dim>& cut = b.geometry.cuts[m];
    const double curvature = curvature_at(w, phi, w.at(w.index_of(cut.cell)), state.grid().dx);
    for (const int widened : {0, 4, 6})
      if (wall.donors == 0)
        wall.donors = collect(state, body, w, role, cut.point, reach_of<Dim>(cut.surface, curvature, widened),
                              b.donors);
    if (wall.donors > 0)
      solve(wall, b.donors);
    else
      ++counters.cuts_without_donor;
  }
}

template <int Dim>
void evaluate_fits(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters) {
  BodyBlock<Dim>& b = body.at(slot);
  const auto n = static_cast<std::size_t>(state.grid().layout().size());
  const Box<Dim> layout = state.grid().layout();
  std::visit(
      [&](const auto& eos) {
        for (std::size_t m = 0; m < b.walls.size(); ++m) {
          if (b.walls[m].donors > 0) {
            evaluate(eos, body, b, b.walls[m], n, counters);
            continue;
          }
          const int cell = b.geometry.cuts[m].cell;
          const Index<Dim> i = state.mesh.block(slot).cells.lo + layout.index(cell);
          lone_fit(body, b, cell, state.grid().full_volume(i), b.walls[m]);
        }
      },
      body.material.eos);
}

template <int Dim>
void move_fits(const State<Dim>& state, Body<Dim>& body, int slot, double time) {
  BodyBlock<Dim>& b = body.at(slot);
  std::visit(
      [&](const auto& eos) {
        for (std::size_t m = 0; m < b.walls.size(); ++m)
          if (b.walls[m].donors > 0) move_fit(eos, state.grid(), body, b.geometry.cuts[m], time, b.walls[m]);
      },
      body.material.eos);
}

#define RECOIL_INSTANTIATE(Dim)                                                              \
  template void choose_donors<Dim>(const State<Dim>&, Body<Dim>&, int, Counters&, Scratch&); \
  template void evaluate_fits<Dim>(const State<Dim>&, Body<Dim>&, int, Counters&);           \
  template void move_fits<Dim>(const State<Dim>&, Body<Dim>&, int, double);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
