#include "kernels/strong_shocks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/multiversion.hpp"

namespace recoil::detail {

namespace {

// Changes of stress over two cells, of rho c_L^2, from which on a shock is strong, and wholly so; and one
// that is slow on the mesh.
constexpr double shock_onset = 0.1, shock_full = 0.2, slow_onset = 0.02, slow_full = 0.05;
// Speeds over the mesh, of c_L, up to which a shock is slow, and from which on it is not.
constexpr double slow_speed = 0.4, fast_speed = 0.8;
// Of one shock the jump of stress times that of the specific volume is the jump of velocity, squared (Rankine
// and Hugoniot). Waves that cross, as at a wall that throws one back, have more of the former.
constexpr double most_of_one_shock = 1.5;
// Factors between neighbouring densities of expanded matter.
constexpr double thin_onset = 1.2, thin_full = 2;
// What is left of the differences inside of matter.
constexpr double least_slope = 0.3, least_slope_slow = 0.5;

/// Where `x` is on the way from `from` to `to`: 0 to 1.
double way(double x, double from, double to) { return std::clamp((x - from) / (to - from), 0.0, 1.0); }

/// How slow a shock between the cells beside cell i is on the mesh, 0 (not at all) to 1. Its speed is that by
/// which mass is kept, the jump of rho u over that of rho.
double slowness(const ShockRow& row, std::ptrdiff_t i) {
  const std::ptrdiff_t low = i - row.step, high = i + row.step;
  const double* rho = row.rho;
  const double jump = rho[high] - rho[low], flow = rho[high] * row.u[high] - rho[low] * row.u[low];
  if (jump == 0) return 0;
  const double closing = row.u[high] - row.u[low], volume = 1 / rho[high] - 1 / rho[low];
  if (!((row.stress[high] - row.stress[low]) * volume < most_of_one_shock * closing * closing)) return 0;
  const double c = std::min(row.impedance[low] / rho[low], row.impedance[high] / rho[high]);
  return 1 - way(std::abs(flow / jump), slow_speed * c, fast_speed * c);
}

}  // namespace

RECOIL_MULTIVERSION
bool find_strong_shocks(const ShockRow& row, int count, double* kept) {
  const std::ptrdiff_t h = row.step;
  const double *stress = row.stress, *u = row.u, *z = row.impedance, *rho = row.rho;
  double most = 0;
#pragma omp simd reduction(max : most)
  for (int i = 0; i < count; ++i) {
    const double change = stress[i + h] - stress[i - h], jump = change < 0 ? -change : change;
    const double below = jump * rho[i - h], above = jump * rho[i + h];  // against z^2 = rho (rho c_L^2)
    const double z_below = z[i - h] * z[i - h], z_above = z[i + h] * z[i + h];
    const double part = below * z_above > above * z_below ? below / z_below : above / z_above;
    kept[i] = u[i + h] < u[i - h] && z_below > 0 && z_above > 0 ? part : 0.0;
    most = kept[i] > most ? kept[i] : most;
  }
  if (!(most > slow_onset)) return false;
  bool any = false;
  for (int i = 0; i < count; ++i) {
    const double part = kept[i];
    kept[i] = 1;
    if (!(part > slow_onset)) continue;
    kept[i] = std::max(1 - slowness(row, i) * way(part, slow_onset, slow_full), least_slope_slow);
    if (part > shock_onset) {
      bool own = true;
      for (int s = -2; row.own != nullptr && s <= 2; ++s)
        own = own && (row.own[i + s * h] & row.own_bit) != 0;
      const double strong = 1 - way(part, shock_onset, shock_full);
      kept[i] = std::min(kept[i], own ? std::max(strong, least_slope) : strong);
    }
    any |= kept[i] < 1;
  }
  return any;
}

RECOIL_MULTIVERSION
bool find_thin_matter(const double* rho, std::ptrdiff_t step, double vapour, int count, double* kept) {
  int any = 0;
#pragma omp simd reduction(| : any)
  for (int i = 0; i < count; ++i) any |= rho[i] < vapour ? 1 : 0;
  if (any == 0) return false;
  for (int i = 0; i < count; ++i) {
    kept[i] = 1;
    if (!(rho[i] < vapour)) continue;
    const double low = rho[i - step], high = rho[i + step], least = std::min({low, rho[i], high});
    kept[i] = least > 0 ? 1 - way(std::max({low, rho[i], high}) / least, thin_onset, thin_full) : 0;
  }
  return true;
}

RECOIL_MULTIVERSION
void flatten(const double* q, const double* kept, int count, RowEnds ends) {
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const double low = q[i] + kept[i] * (ends.low[i] - q[i]), high = q[i] + kept[i] * (ends.high[i] - q[i]);
    ends.low[i] = kept[i] < 1 ? low : ends.low[i];
    ends.high[i] = kept[i] < 1 ? high : ends.high[i];
  }
}

}  // namespace recoil::detail
