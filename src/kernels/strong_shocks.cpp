#include "kernels/strong_shocks.hpp"

#include <algorithm>
#include <cstddef>

#include "core/multiversion.hpp"

namespace recoil::detail {

namespace {

// Changes of stress over two cells, of rho c_L^2, from which on a shock is strong, and wholly so.
constexpr double shock_onset = 0.1, shock_full = 0.2;
constexpr double least_slope = 0.3;  // of the differences that a strong shock leaves inside of matter

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
  if (!(most > shock_onset)) return false;
  for (int i = 0; i < count; ++i) {
    const double strength = std::clamp((kept[i] - shock_onset) / (shock_full - shock_onset), 0.0, 1.0);
    bool own = true;
    for (int s = -2; row.own != nullptr && s <= 2; ++s) own = own && (row.own[i + s * h] & row.own_bit) != 0;
    kept[i] = own ? std::max(1 - strength, least_slope) : 1 - strength;
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
