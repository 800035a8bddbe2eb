#include "interface/fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <type_traits>
#include <variant>

#include "core/multiversion.hpp"
#include "dynamics/half_step/half_step.hpp"
#include "dynamics/half_step/loading.hpp"
#include "dynamics/primitives.hpp"
#include "material/eos/isentrope.hpp"

namespace recoil {

namespace {

// The fitted density leaves the donors' mean at most so far, in parts of it; what is cut is counted.
constexpr double deepest_rarefaction = 0.4, highest_compression = 0.6;

// Values of a fit leave the range of its donors by this part of it where they are calm.
constexpr double slack_of_fits = 0.5;
// Parts of the bulk modulus that the pressures of calm donors differ by at most, and those in a strong shock.
constexpr double calm_range = 0.05, shocked_range = 0.1;

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

/// Four numbers that are computed with at once. A vector of eight would be taken apart, at ten times the
/// cost, by processors that have none.
using Four [[gnu::vector_size(32)]] = double;

/// The first `count` primitives of a donor in whole Fours; the rest is 0, but for S_xx + S_yy behind them
/// where S_zz has no place of its own.
template <std::size_t count>
struct Packed {
  std::array<Four, (count + 3) / 4> four;

  double operator[](std::size_t c) const { return four[c / 4][c % 4]; }
};

/// Weighted sums over donors: differences from the first donor's values.
template <int Dim, std::size_t count>
struct DonorSums {
  Packed<count> base{}, mean{}, low{}, high{};
  std::array<Packed<count>, Dim> gradient{};
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

/// The averages of all donors of a block: the numbers of a cell, which lie far apart in its block, side by
/// side.
template <int Dim, std::size_t count>
void pack(const Body<Dim>& body, const FieldArray<DonorCell>& cells, std::size_t n, Packed<count>* values) {
  static constexpr auto signs = mirror_signs<Dim>();
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const DonorCell& cell = cells[k];
    const double* from = body.at(cell.slot).average.data() + cell.cell;
    alignas(Four) std::array<double, sizeof(Packed<count>) / sizeof(double)> v{};
    for (std::size_t c = 0; c < count; ++c) v[c] = from[c * n];
    if (cell.flips != 0)
      for (std::size_t c = 0; c < count; ++c) v[c] *= signs[cell.flips][c];
    if constexpr (Dim == 3) {
      static_assert(count % 4 != 0, "room for one more");
      v[count] = v[Components<Dim>::s] + v[Components<Dim>::s + 1];
    }
    std::memcpy(&values[k], v.data(), sizeof v);
  }
}

/// Donor by donor: all components of a cell at once, but no more than eight, whose sums registers hold.
template <int Dim, std::size_t count>
RECOIL_MULTIVERSION void sum_donors(const Packed<count>* values, const Donor<Dim>* donors, int number,
                                    DonorSums<Dim, count>& out) {
  constexpr std::size_t fours = std::tuple_size_v<decltype(Packed<count>::four)>, together = 2;
  out.base = values[donors[0].place];
  for (std::size_t first = 0; first < fours; first += together) {
    std::array<Four, together> base{}, mean{}, low{}, high{};
    std::array<std::array<Four, together>, Dim> gradient{};
    const std::size_t n = std::min(together, fours - first);
    for (std::size_t e = 0; e < n; ++e) base[e] = low[e] = high[e] = out.base.four[first + e];
    for (int k = 0; k < number; ++k) {
      const Donor<Dim>& donor = donors[k];
      const Four* value = values[donor.place].four.data() + first;
      for (std::size_t e = 0; e < n; ++e) {
        const Four v = value[e], change = v - base[e];
        low[e] = v < low[e] ? v : low[e];
        high[e] = high[e] < v ? v : high[e];
        mean[e] += donor.weight * change;
        for (std::size_t d = 0; d < Dim; ++d)
          gradient[d][e] += change * donor.slope_weight[static_cast<int>(d)];
      }
    }
    for (std::size_t e = 0; e < n; ++e) {
      out.mean.four[first + e] = mean[e];
      out.low.four[first + e] = low[e];
      out.high.four[first + e] = high[e];
      for (std::size_t d = 0; d < Dim; ++d) out.gradient[d].four[first + e] = gradient[d][e];
    }
  }
}

/// Primitives that are fitted: all. The energy of voids (`extra`) belongs to the density that they lower.
template <int Dim>
constexpr std::size_t fitted = Components<Dim>::primitives;

/// Whether surface_state() has to take a faster sound than that of this state. Voids have no stress to need
/// it for.
template <int Dim>
bool soft_for_its_stress(const Material& material, const Primitives<Dim>& w) {
  using C = Components<Dim>;
  return w[C::p] != 0 &&
         std::abs(w[C::p]) > w[C::rho] * sound_speed_squared(material.eos, w[C::rho], w[C::p], w[C::crushed]);
}

/// 1 where the donors of a fit are calm, 0 in a strong shock: a line through a front of 60 GPa would end in a
/// tension that throws the surface away. Gases, which have no tension, are calm.
/// @param range that the pressures of the donors differ by [Pa]. @param modulus at their mean [Pa]; that at
/// rest counts where it is softer.
double calm_part(const Material& material, double range, double modulus) {
  if (!has_tension(material.eos)) return 1;
  const double c0 = bulk_sound_speed(material), softer = std::min(modulus, density(material) * c0 * c0);
  return std::clamp((shocked_range * softer - range) / ((shocked_range - calm_range) * softer), 0.0, 1.0);
}

/// The least pressure [Pa] that a fit may show at a surface: a gas cannot pull, and where it expands into
/// nothing a line through the donors' pressures ends below zero. @param lowest of the donors.
template <class EosModel>
double least_pressure(const EosModel& eos, double lowest) {
  constexpr double part = 0.1;
  if constexpr (std::is_same_v<EosModel, Jwl>) return lowest > 0 ? part * lowest : lowest;
  if constexpr (std::is_same_v<EosModel, IdealGas>)
    if (eos.p_inf == 0 && lowest + eos.p0 > 0) return part * (lowest + eos.p0) - eos.p0;
  return -infinite;
}

/// Limits a fitted velocity to the ball around the box that the donors' velocities are in, with a radius
/// larger by the part 2 `outside`. A limit component by component cuts off a body that turns where its donors
/// hardly differ in one component but do in another, as at the corners of a square.
template <int Dim, class Sums>
void limit_velocity(const Sums& sums, double outside, Wall<Dim>& wall) {
  using C = Components<Dim>;
  Vec<Dim> middle, range, off;
  for (int d = 0; d < Dim; ++d) {
    const std::size_t c = C::u + d;
    middle[d] = 0.5 * (sums.low[c] + sums.high[c]);
    range[d] = sums.high[c] - sums.low[c];
    off[d] = wall.value[c] - middle[d];
  }
  const double most = (0.5 + outside) * norm(range), length = norm(off);
  if (length <= most) return;
  for (int d = 0; d < Dim; ++d) wall.value[C::u + d] = middle[d] + off[d] * (most / length);
}

template <int Dim, class EosModel>
void evaluate(const EosModel& eos, const Body<Dim>& body, const Donor<Dim>* donors,
              const Packed<fitted<Dim>>* values, Wall<Dim>& wall, Counters& counters) {
  using C = Components<Dim>;
  constexpr std::size_t count = fitted<Dim>;
  DonorSums<Dim, count> sums;
  sum_donors<Dim, count>(values, donors, wall.donors, sums);
  const auto mean_of = [&](std::size_t c) { return sums.mean[c] + sums.base[c]; };
  const double mean_p = mean_of(C::p);
  const auto& matter = frozen(eos, mean_of(C::crushed));
  const double c2 =
      std::max(matter.sound_speed_squared(mean_of(C::rho), mean_p), least_wall_sound_squared(matter));
  const double outside =
      slack_of_fits * calm_part(body.material, sums.high[C::p] - sums.low[C::p], mean_of(C::rho) * c2);
  for (std::size_t c = 0; c < count; ++c) {
    const double mean = mean_of(c), low = sums.low[c], high = sums.high[c];
    for (std::size_t d = 0; d < Dim; ++d) wall.gradient[c][static_cast<int>(d)] = sums.gradient[d][c];
    wall.range[c] = high - low;
    const double at_surface = mean - dot(wall.gradient[c], wall.donor_centre), slack = outside * (high - low);
    const bool velocity = c >= C::u && c < C::p;
    wall.value[c] = c == C::rho || c >= C::ep ? mean
                    : velocity                ? at_surface
                                              : std::clamp(at_surface, low - slack, high + slack);
  }
  wall.value[C::p] = std::max(wall.value[C::p], least_pressure(eos, sums.low[C::p]));
  limit_velocity(sums, outside, wall);
  const double rho = wall.value[C::rho];
  if (const auto gas = gas_isentrope(body.material.eos, rho, mean_p, wall.value[C::p])) {
    if (!gas->reached) ++counters.clamped_fit_densities;
    wall.value[C::rho] = gas->rho;
    wall.value[C::p] = gas->p;
  } else if (std::is_same_v<EosModel, Jwl>) {
    const IsentropePoint moved = follow_isentrope(body.material.eos, rho, mean_p, 0, wall.value[C::p]);
    if (!moved.reached) ++counters.clamped_fit_densities;
    wall.value[C::rho] = moved.rho;
  } else {
    const double change = (wall.value[C::p] - mean_p) / c2,
                 kept = std::clamp(change, -deepest_rarefaction * rho, highest_compression * rho);
    if (kept != change) ++counters.clamped_fit_densities;
    wall.value[C::rho] = rho + kept;
  }
  if (soft_for_its_stress<Dim>(body.material, wall.value)) ++counters.floored_sound_speeds;
  wall.value[C::ep] = std::max(0.0, wall.value[C::ep]);
  wall.range[C::extra] = Dim == 3 ? sums.high[count] - sums.low[count] : 0;
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
  const bool widens = Dim < 3 && grid.has_radius() && cut.point[0] > grid.dx;
  const double widening = widens ? w[C::u] / cut.point[0] : 0;
  if constexpr (Dim < 3) working -= (w[C::s] + (Dim == 2 ? w[C::s + 1] : 0.0)) * widening;
  const double g = shear_modulus(body.material);
  const auto& matter = frozen(eos, w[C::crushed]);
  const double c2 =
      std::max(matter.sound_speed_squared(w[C::rho], w[C::p]), least_wall_sound_squared(matter));
  const bool unstressed = equivalent_stress_squared<Dim>(w.data() + C::s, 1) == 0;
  const Response m{w[C::rho] * c2, g, g > 0 && (working > 0 || unstressed) ? loading_of(body, w) : 0};
  Primitives<Dim> rate{};
  for_each_axis<Dim>([&](auto d) {
    const auto along = rate_along<Dim, d>(w, slope[d], w[C::u + d], m);
    for (std::size_t c = 0; c < w.size(); ++c) rate[c] += along[c];
  });
  if constexpr (Dim < 3)
    if (widens) add_widening<Dim>(w, widening, 1 / cut.point[0], m, rate);
  for (std::size_t c = 0; c < w.size(); ++c) wall.value[c] += time * rate[c];
  if (m.loading > 0) keep_at_yield<Dim>(w, w, wall.value);
}

}  // namespace

template <int Dim>
void evaluate_fits(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters, Scratch& scratch) {
  const Scratch::Frame frame(scratch);
  BodyBlock<Dim>& b = body.at(slot);
  const auto n = static_cast<std::size_t>(state.grid().layout().size());
  const Box<Dim> layout = state.grid().layout();
  std::visit(
      [&](const auto& eos) {
        constexpr std::size_t count = fitted<Dim>;
        auto* values = scratch.take<Packed<count>>(b.donors.cells.size());
        pack<Dim, count>(body, b.donors.cells, n, values);
        for (std::size_t m = 0; m < b.walls.size(); ++m) {
          if (Wall<Dim>& wall = b.walls[m]; wall.donors > 0) {
            evaluate(eos, body, b.donors.parts.data() + wall.first_donor, values, wall, counters);
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
                                                                                             \
  template void evaluate_fits<Dim>(const State<Dim>&, Body<Dim>&, int, Counters&, Scratch&); \
  template void move_fits<Dim>(const State<Dim>&, Body<Dim>&, int, double);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
