#include "kernels/row_kernels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/multiversion.hpp"
#include "kernels/reconstruction.hpp"

namespace recoil::detail {

namespace {

/// How a loop over a row finds the values of its cells.
enum class How : std::uint8_t {
  weno,    // all by WENO5-Z
  linear,  // by linear weights; says where they are not those of MP5
  mixed    // by MP5 where cells are smooth, else by WENO5-Z
};

/// Of a cell in such a loop. @param smooth read if `mixed`. @param rough written if `linear`.
template <How how, class Value>
[[gnu::always_inline]] inline Ends ends_of(const Value& value, std::ptrdiff_t step, double least, bool smooth,
                                           double& rough) {
  const double a = value(-2 * step), b = value(-step), c = value(0), d = value(step), e = value(2 * step);
  if constexpr (how == How::weno) {
    return weno5z(a, b, c, d, e, least);
  } else if constexpr (how == How::linear) {
    return linear5(a, b, c, d, e, least, rough);
  } else {
    const Ends limited = mp5(a, b, c, d, e, least), weighted = weno5z(a, b, c, d, e, least);
    return {smooth ? limited.low : weighted.low, smooth ? limited.high : weighted.high};
  }
}

template <How how>
using As = std::integral_constant<How, how>;

/// cell(As<how>, i, whether it is smooth) for a row, in loops without a branch; returns whether the cell is
/// rough. Where cells are smooth, MP5 is nearly everywhere linear: so linear values come first, then eight
/// cells at a time again wherever one of them is rough or not smooth.
template <class Cell>
[[gnu::always_inline]] inline void reconstruct_row(const SmoothCells& cells, int count, const Cell& cell) {
  if (cells.smooth == nullptr) {
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) cell(As<How::weno>{}, i, false);
    return;
  }
  constexpr int piece = 64, together = 8;
  alignas(64) double rough[piece], smooth[piece];
  for (int first = 0; first < count; first += piece) {
    const int length = first + piece < count ? piece : count - first;
    for (int k = 0; k < length; ++k) smooth[k] = cells.smooth[first + k];
#pragma GCC ivdep
    for (int k = 0; k < length; ++k) rough[k] = cell(As<How::linear>{}, first + k, true);
    for (int from = 0; from < length; from += together) {
      const int to = from + together < length ? from + together : length;
      bool again = false;
      for (int k = from; k < to; ++k) again = again | (rough[k] > 0) | !(smooth[k] > 0);
      if (!again) continue;
      if (length >= together) {  // a number of cells that the compiler knows; some of them once more
#pragma GCC ivdep
        for (int k = to - together; k < to; ++k) cell(As<How::mixed>{}, first + k, smooth[k] > 0);
      } else {
        for (int k = from; k < to; ++k) cell(As<How::mixed>{}, first + k, smooth[k] > 0);
      }
    }
  }
}

/// reconstruct_waves() of cell i. @returns whether it is rough.
template <How how>
[[gnu::always_inline]] inline double reconstruct_pair(const double* stress, const double* u, double z,
                                                      std::ptrdiff_t step, int i, double least, bool smooth,
                                                      RowEnds stress_ends, RowEnds u_ends) {
  double rough_plus = 0, rough_minus = 0;
  const double half = 0.5 / z;
  const Ends plus = ends_of<how>([&](std::ptrdiff_t k) { return mul_add(z, u[i + k], stress[i + k]); }, step,
                                 least, smooth, rough_plus);
  const Ends minus = ends_of<how>([&](std::ptrdiff_t k) { return mul_add(-z, u[i + k], stress[i + k]); },
                                  step, least, smooth, rough_minus);
  stress_ends.low[i] = 0.5 * (plus.low + minus.low);
  stress_ends.high[i] = 0.5 * (plus.high + minus.high);
  u_ends.low[i] = (plus.low - minus.low) * half;
  u_ends.high[i] = (plus.high - minus.high) * half;
  return rough_plus + rough_minus;
}

/// Whether what a row of cells reads along its axis is +0 everywhere, bit by bit. Where something is there,
/// the ends and the middle of the row mostly say so.
[[gnu::always_inline]] inline bool all_zero(const double* q, std::ptrdiff_t step, int count) {
  if (q[0] != 0 || q[count / 2] != 0 || q[count - 1] != 0) return false;
  for (std::ptrdiff_t s = -2; s <= 2; ++s) {
    std::uint64_t any = 0;
#pragma omp simd reduction(| : any)
    for (int i = 0; i < count; ++i) any |= std::bit_cast<std::uint64_t>(q[i + s * step]);
    if (any != 0) return false;
  }
  return true;
}

}  // namespace

SmoothCells find_smooth(const std::uint8_t* never_yields, std::ptrdiff_t step, int count,
                        std::uint8_t* smooth) {
  std::uint8_t any = 0;
  for (int i = 0; i < count; ++i) {
    const std::uint8_t* at = never_yields + i;
    smooth[i] = at[-2 * step] & at[-step] & at[0] & at[step] & at[2 * step];
    any |= smooth[i];
  }
  return {any != 0 ? smooth : nullptr};
}

RECOIL_MULTIVERSION
void reconstruct_plain(const double* q, std::ptrdiff_t step, int count, double least, SmoothCells cells,
                       RowEnds ends) {
  if (all_zero(q, step, count)) {  // as plastic strain in matter that has not yielded
    for (int i = 0; i < count; ++i) ends.low[i] = ends.high[i] = 0;
    return;
  }
  reconstruct_row(cells, count, [&](auto how, int i, bool smooth) RECOIL_INLINE {
    double rough = 0;
    const Ends at = ends_of<how()>([&](std::ptrdiff_t k) { return q[i + k]; }, step, least, smooth, rough);
    ends.low[i] = at.low;
    ends.high[i] = at.high;
    return rough;
  });
}

RECOIL_MULTIVERSION
void reconstruct_waves(const double* stress, const double* u, const double* impedance, std::ptrdiff_t step,
                       int count, double least, SmoothCells cells, RowEnds stress_ends, RowEnds u_ends) {
  reconstruct_row(cells, count, [&](auto how, int i, bool smooth) RECOIL_INLINE {
    return reconstruct_pair<how()>(stress, u, impedance[i], step, i, least, smooth, stress_ends, u_ends);
  });
}

RECOIL_MULTIVERSION
void reconstruct_shear_waves(const double* tau, const double* u, const double* rho,
                             const double* shear_modulus, std::ptrdiff_t step, int count, SmoothCells cells,
                             RowEnds tau_ends, RowEnds u_ends) {
  reconstruct_row(cells, count, [&](auto how, int i, bool smooth) RECOIL_INLINE {
    return reconstruct_pair<how()>(tau, u, std::sqrt(rho[i] * shear_modulus[i]), step, i, stress_scale,
                                   smooth, tau_ends, u_ends);
  });
}

RECOIL_MULTIVERSION
void reconstruct_turned(const double* xx, const double* yy, std::ptrdiff_t step, int count, SmoothCells cells,
                        RowEnds xx_ends, RowEnds yy_ends) {
  reconstruct_row(cells, count, [&](auto how, int i, bool smooth) RECOIL_INLINE {
    double rough_sum = 0, rough_difference = 0;
    const Ends sum = ends_of<how()>([&](std::ptrdiff_t k) { return xx[i + k] + yy[i + k]; }, step,
                                    stress_scale, smooth, rough_sum);
    const Ends difference = ends_of<how()>([&](std::ptrdiff_t k) { return xx[i + k] - yy[i + k]; }, step,
                                           stress_scale, smooth, rough_difference);
    xx_ends.low[i] = 0.5 * (sum.low + difference.low);
    yy_ends.low[i] = 0.5 * (sum.low - difference.low);
    xx_ends.high[i] = 0.5 * (sum.high + difference.high);
    yy_ends.high[i] = 0.5 * (sum.high - difference.high);
    return rough_sum + rough_difference;
  });
}

void reconstruct_crushed(double alpha0, double least, const double* rho, const double* crushed,
                         std::ptrdiff_t step, int count, RowEnds rho_ends, RowEnds ends) {
  for (int i = 0; i < count; ++i) {
    double rough = 0;  // not asked for
    const Ends solid = ends_of<How::weno>(
        [&](std::ptrdiff_t k) { return rho[i + k] * (alpha0 - crushed[i + k]); }, step, least, false, rough);
    const double most = alpha0 - 1, own = std::clamp(crushed[i], 0.0, most),
                 l = alpha0 - solid.low / rho_ends.low[i], h = alpha0 - solid.high / rho_ends.high[i],
                 smaller = std::min(l, h), larger = std::max(l, h);
    double part = smaller < 0 ? own / (own - smaller) : 1.0;
    if (larger > most) part = std::min(part, (most - own) / (larger - own));
    ends.low[i] = std::clamp(own + part * (l - own), 0.0, most);
    ends.high[i] = std::clamp(own + part * (h - own), 0.0, most);
  }
}

RECOIL_MULTIVERSION
void keep_positive(const double* q, int count, RowEnds ends) {
  int negative = 0;
#pragma omp simd reduction(+ : negative)
  for (int i = 0; i < count; ++i) negative += (ends.low[i] < 0) | (ends.high[i] < 0) ? 1 : 0;
  if (negative == 0) return;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const double own = q[i] > 0 ? q[i] : 0.0, l = ends.low[i], h = ends.high[i], least = l < h ? l : h;
    const double part = own / (own - least), drawn_l = own + part * (l - own),
                 drawn_h = own + part * (h - own);
    ends.low[i] = least < 0 ? (drawn_l > 0 ? drawn_l : 0.0) : l;
    ends.high[i] = least < 0 ? (drawn_h > 0 ? drawn_h : 0.0) : h;
  }
}

StateBounds::StateBounds(const AnyEos& eos)
    : least_rho(0.6 * density_range(eos).least * eos.rho0), least_c2(least_sound_squared(eos)) {}

AtRest::AtRest(const AnyEos& eos) {
  constexpr double part = 1e-12;
  const double c0 = bulk_sound_speed(eos);
  speed = part * c0;
  stress = part * eos.rho0 * c0 * c0;
}

RECOIL_MULTIVERSION
bool all_within(const double* values, int count, double most) {
  constexpr int stretch = 64;  // looked at together
  for (int from = 0; from < count; from += stretch) {
    const int n = count - from < stretch ? count - from : stretch;
    int beyond = 0;
#pragma omp simd reduction(| : beyond)
    for (int i = 0; i < n; ++i) beyond |= std::abs(values[from + i]) <= most ? 0 : 1;
    if (beyond != 0) return false;
  }
  return true;
}

RECOIL_MULTIVERSION
int find_longitudinal_speeds(const StateBounds& bounds, const double* rho, const double* own,
                             const double* shear_modulus, int count, double* sound) {
  int bad = 0;
#pragma omp simd reduction(+ : bad)
  for (int i = 0; i < count; ++i) {
    const double c2 = sound[i];
    sound[i] = bounds.longitudinal_speed(rho[i], c2, shear_modulus[i]);
    bad += bounds.admit(rho[i], own[i], c2) ? 0 : 1;
  }
  return bad;
}

namespace {

/// @param Pulled whether `pull` is there.
template <bool Pulled>
[[gnu::always_inline]] inline void normal_waves(int count, const AtRest& rest, const NormalSide& left,
                                                const NormalSide& right, const double* pull,
                                                const NormalWaves& out) {
  const double quiet_u = rest.speed, quiet_s = rest.stress;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const double rl = left.rho[i], rr = right.rho[i], ul = left.u[i], ur = right.u[i], sl = left.stress[i],
                 sr = right.stress[i], cl = left.sound[i], cr = right.sound[i];
    const double low = ul - cl < ur - cr ? ul - cl : ur - cr, high = ul + cl > ur + cr ? ul + cl : ur + cr;
    const double ml = rl * (low - ul), mr = rr * (high - ur);
    const double full = (sl - sr + ml * ul - mr * ur) / (ml - mr), stress_star = sl - ml * (full - ul);
    const double star = Pulled ? full - (1 - pull[i]) * (sl - sr) / (ml - mr) : full;
    const bool from_left = star >= 0;
    const double wave = from_left ? low : high, m = from_left ? ml : mr;
    const bool beyond = (from_left & (low >= 0)) | (!from_left & (high <= 0));
    const double rho = from_left ? rl : rr, u = from_left ? ul : ur, s = from_left ? sl : sr;
    const double mass = beyond ? rho * u : m / (wave - star) * star;
    const double out_u = beyond ? u : star, out_s = beyond ? s : stress_star;
    const double per_m = beyond ? 0.0 : 1 / m;
    out.rho_behind[i] = rho;
    out.p_behind[i] = from_left ? left.p[i] : right.p[i];
    out.kinetic[i] = 0.5 * u * u;
    out.work[i] = (stress_star * star - s * u) * per_m;
    out.inverse[i] = per_m;
    const bool still = (std::abs(ul) <= quiet_u) & (std::abs(ur) <= quiet_u) & (std::abs(sl) <= quiet_s) &
                       (std::abs(sr) <= quiet_s);  // false for NaN
    out.mass[i] = still ? 0.0 : mass;
    out.normal[i] = still ? 0.0 : mass * out_u - out_s;
    out.power[i] = still ? 0.0 : out_s * out_u;
    out.speed[i] = still ? 0.0 : out_u;
  }
}

}  // namespace

RECOIL_MULTIVERSION
void solve_normal_waves(int count, const AtRest& rest, const NormalSide& left, const NormalSide& right,
                        const double* pull, const NormalWaves& out) {
  if (pull)
    normal_waves<true>(count, rest, left, right, pull, out);
  else
    normal_waves<false>(count, rest, left, right, pull, out);
}

namespace {

template <bool Pulled>
[[gnu::always_inline]] inline void shear_waves(int count, const AtRest& rest, const ShearSide& left,
                                               const ShearSide& right, const double* pull,
                                               const CarryingFlow& flow, const AlongFace& out) {
  const double quiet_u = rest.speed, quiet_s = rest.stress;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const bool from_left = flow.speed[i] >= 0, beyond = flow.inverse[i] == 0;
    const double vl = left.v[i], vr = right.v[i], v = from_left ? vl : vr;
    const double tl = left.tau[i], tr = right.tau[i], tau = from_left ? tl : tr;
    const double zl = std::sqrt(left.rho[i] * left.modulus[i]),
                 zr = std::sqrt(right.rho[i] * right.modulus[i]);
    const double full = (zl * vl + zr * vr + tr - tl) / (zl + zr), tau_star = tl + zl * (full - vl);
    const double v_star = Pulled ? full - (1 - pull[i]) * (tr - tl) / (zl + zr) : full;
    const double v_out = beyond ? v : v_star, tau_out = beyond ? tau : tau_star;
    const double work = (tau_out * v_out - tau * v) / (from_left ? -zl : zr);
    const bool still = (flow.mass[i] == 0) & (std::abs(vl) <= quiet_u) & (std::abs(vr) <= quiet_u) &
                       (std::abs(tl) <= quiet_s) & (std::abs(tr) <= quiet_s);
    out.momentum[i] = still ? 0.0 : flow.mass[i] * v_out - tau_out;
    out.power[i] += still ? 0.0 : flow.mass[i] * (0.5 * v * v - work) - tau_out * v_out;
    out.speed[i] = still ? 0.0 : v_out;
  }
}

}  // namespace

RECOIL_MULTIVERSION
void solve_shear_waves(int count, const AtRest& rest, const ShearSide& left, const ShearSide& right,
                       const double* pull, const CarryingFlow& flow, const AlongFace& out) {
  if (pull)
    shear_waves<true>(count, rest, left, right, pull, flow, out);
  else
    shear_waves<false>(count, rest, left, right, pull, flow, out);
}

RECOIL_MULTIVERSION
void carry_velocity(int count, const double* left, const double* right, const CarryingFlow& flow,
                    const AlongFace& out) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const double v = flow.speed[i] >= 0 ? left[i] : right[i];
    out.momentum[i] = flow.mass[i] * v;
    out.power[i] += flow.mass[i] * (0.5 * v * v);
    out.speed[i] = v;
  }
}

RECOIL_MULTIVERSION
void carry(int count, const double* left, const double* right, const CarryingFlow& flow, double* flux) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) flux[i] = flow.mass[i] * (flow.speed[i] >= 0 ? left[i] : right[i]);
}

RECOIL_MULTIVERSION
void take_upwind(int count, const double* left, const double* right, const double* speed, double* to) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) to[i] = speed[i] >= 0 ? left[i] : right[i];
}

RECOIL_MULTIVERSION
void add_difference(int count, const double* low, const double* below, const double* high,
                    const double* above, double* out) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) out[i] += low[i] * below[i] - high[i] * above[i];
}

RECOIL_MULTIVERSION
void set_difference(int count, const double* low, const double* below, const double* high,
                    const double* above, double* out) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) out[i] = 0.0 + (low[i] * below[i] - high[i] * above[i]);
}

RECOIL_MULTIVERSION
void add_scaled(int count, double factor, const double* a, double* out) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) out[i] += factor * a[i];
}

RECOIL_MULTIVERSION
void add_rows(int count, const double* a, const double* b, double* out) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) out[i] = a[i] + b[i];
}

RECOIL_MULTIVERSION
void mix(int count, double weight, const double* old, double* now) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) now[i] += weight * (old[i] - now[i]);
}

RECOIL_MULTIVERSION
void find_impedances(int count, const double* rho, double least, const double* shear_modulus,
                     double* impedance) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const double c2 = impedance[i];
    impedance[i] = rho[i] * std::sqrt((c2 > least ? c2 : least) + 4 * shear_modulus[i] / (3 * rho[i]));
  }
}

}  // namespace recoil::detail
