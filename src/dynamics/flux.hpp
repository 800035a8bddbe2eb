#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "dynamics/face_half_step.hpp"
#include "dynamics/face_values.hpp"
#include "dynamics/primitives.hpp"
#include "dynamics/reconstruction.hpp"
#include "material/eos/any_eos.hpp"

namespace recoil {

namespace detail {

/// Smallest differences that count, squared: of stresses [Pa2] and velocities [m2/s2].
inline constexpr double stress_scale = 1e8, velocity_scale = 1e-2;

/// The five cells about cell i of a row.
template <class Value>
[[gnu::always_inline]] inline Ends ends_of(const Value& value, std::ptrdiff_t step, double least) {
  return weno5z(value(-2 * step), value(-step), value(0), value(step), value(2 * step), least);
}

/// WENO5-Z of one array.
inline void reconstruct_plain(const double* q, std::ptrdiff_t step, int count, double least, double* low,
                              double* high) {
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const Ends at = ends_of([&](std::ptrdiff_t k) { return q[i + k]; }, step, least);
    low[i] = at.low;
    high[i] = at.high;
  }
}

/// What porous matter has lost of its distension, by the density of its solid, alpha rho, at the faces: where
/// pores are crushed the latter hardly changes, while alpha and rho do. Both values of a cell are drawn
/// towards its own, as by keep_positive(), until they are within bounds.
inline void reconstruct_crushed(double alpha0, double least, const double* rho, const double* crushed,
                                std::ptrdiff_t step, int count, const double* rho_low, const double* rho_high,
                                double* low, double* high) {
  for (int i = 0; i < count; ++i) {
    const Ends solid =
        ends_of([&](std::ptrdiff_t k) { return rho[i + k] * (alpha0 - crushed[i + k]); }, step, least);
    const double most = alpha0 - 1, own = std::clamp(crushed[i], 0.0, most),
                 l = alpha0 - solid.low / rho_low[i], h = alpha0 - solid.high / rho_high[i],
                 least = std::min(l, h), largest = std::max(l, h);
    double part = least < 0 ? own / (own - least) : 1.0;
    if (largest > most) part = std::min(part, (most - own) / (largest - own));
    low[i] = std::clamp(own + part * (l - own), 0.0, most);
    high[i] = std::clamp(own + part * (h - own), 0.0, most);
  }
}

/// Draws both face values of a cell towards its own, by the same part, until neither of a quantity that
/// cannot be negative is (Zhang & Shu, J. Comput. Phys. 229 (2010) 3091). Cells without a negative face value
/// keep their bits. @param q of the cells, adjacent in memory.
inline void keep_positive(const double* q, int count, double* low, double* high) {
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const double own = q[i] > 0 ? q[i] : 0.0, l = low[i], h = high[i], least = l < h ? l : h;
    const double part = own / (own - least), drawn_l = own + part * (l - own),
                 drawn_h = own + part * (h - own);
    low[i] = least < 0 ? (drawn_l > 0 ? drawn_l : 0.0) : l;
    high[i] = least < 0 ? (drawn_h > 0 ? drawn_h : 0.0) : h;
  }
}

/// WENO5-Z of the characteristic-like stress + Z u and stress - Z u with the cell's own Z; then back to
/// stress and u. `impedance(i)`: of cell i.
template <class Impedance>
void reconstruct_waves(const double* stress, const double* u, const Impedance& impedance, std::ptrdiff_t step,
                       int count, double* stress_low, double* stress_high, double* u_low, double* u_high) {
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const double z = impedance(i), half = 0.5 / z;
    const Ends plus =
        ends_of([&](std::ptrdiff_t k) { return mul_add(z, u[i + k], stress[i + k]); }, step, stress_scale);
    const Ends minus =
        ends_of([&](std::ptrdiff_t k) { return mul_add(-z, u[i + k], stress[i + k]); }, step, stress_scale);
    stress_low[i] = 0.5 * (plus.low + minus.low);
    stress_high[i] = 0.5 * (plus.high + minus.high);
    u_low[i] = (plus.low - minus.low) * half;
    u_high[i] = (plus.high - minus.high) * half;
  }
}

/// S_nn of a 3-d axis 2 is not stored: it follows from the trace.
template <int Dim, int Axis, class Values>
[[gnu::always_inline]] inline double normal_deviator(const Values& w, std::ptrdiff_t i) {
  using C = Components<Dim>;
  if constexpr (Dim == 3 && Axis == 2)
    return -(w[C::s][i] + w[C::s + 1][i]);
  else
    return w[C::s + C::stress(Axis, Axis)][i];
}

/// Across axis 2 in 3-d S_zz and S_xx - S_yy are reconstructed, so that a wave along z is one along x turned.
inline void reconstruct_turned(const Row<3>& in, int to, FaceValues<3>& low, FaceValues<3>& high) {
  using C = Components<3>;
  const double *xx = in.primitive + C::s * in.cells + in.first, *yy = xx + in.cells;
  const std::ptrdiff_t step = in.step;
  const auto back = [](double sum, double difference, double& s, double& t) {
    s = 0.5 * (sum + difference);
    t = 0.5 * (sum - difference);
  };
#pragma omp simd
  for (int i = 0; i < in.count; ++i) {
    const Ends sum = ends_of([&](std::ptrdiff_t k) { return xx[i + k] + yy[i + k]; }, step, stress_scale);
    const Ends difference =
        ends_of([&](std::ptrdiff_t k) { return xx[i + k] - yy[i + k]; }, step, stress_scale);
    back(sum.low, difference.low, low.value[C::s][i + to], low.value[C::s + 1][i + to]);
    back(sum.high, difference.high, high.value[C::s][i + to], high.value[C::s + 1][i + to]);
  }
}

}  // namespace detail

/// Values of a row of cells at their low and high faces across `Axis`: WENO5-Z of the characteristic-like
/// sigma +- Z u and tau +- Z_s v and of the remaining primitives, written from place `to` on, moved to the
/// middle of the step where it has one stage (Row::ahead). p is left to solve_faces().
/// @param Shear false for fluids: no shear waves at all.
template <int Dim, int Axis, bool Shear>
void reconstruct(const AnyEos& eos, double shear_modulus, const Row<Dim>& in, int to, FaceValues<Dim>& low,
                 FaceValues<Dim>& high) {
  using C = Components<Dim>;
  const auto of = [&](int c) { return in.primitive + c * in.cells + in.first; };
  const auto plain = [&](int c, double least) {
    detail::reconstruct_plain(of(c), in.step, in.count, least, low.value[c] + to, high.value[c] + to);
  };
  plain(C::rho, 1e-6 * eos.rho0 * eos.rho0);
  plain(C::ep, 1e-12);
  if (eos.porous)
    detail::reconstruct_crushed(eos.porous->alpha0, 1e-6 * eos.rho0 * eos.rho0, of(C::rho), of(C::crushed),
                                in.step, in.count, low.value[C::rho] + to, high.value[C::rho] + to,
                                low.value[C::crushed] + to, high.value[C::crushed] + to);
  else
    plain(C::temperature_rise, 1e-6);
  if (in.fails) plain(C::damage, 1e-12);
  if (eos.barotropic) plain(C::extra, 1e-2);

  const double* z = in.impedance + in.first;
  detail::reconstruct_waves(
      in.stress + in.first, of(C::u + Axis), [z](int i) { return z[i]; }, in.step, in.count, low.stress + to,
      high.stress + to, low.value[C::u + Axis] + to, high.value[C::u + Axis] + to);
  const double* rho = of(C::rho);
  for (int t = 0; t < Dim; ++t) {
    if (t == Axis) continue;
    const int u = C::u + t, tau = C::s + C::stress(Axis, t);
    if constexpr (Shear)
      detail::reconstruct_waves(
          of(tau), of(u), [=](int i) { return std::sqrt(rho[i] * shear_modulus); }, in.step, in.count,
          low.value[tau] + to, high.value[tau] + to, low.value[u] + to, high.value[u] + to);
    else
      plain(u, detail::velocity_scale);
  }

  for (int c = C::s; c < C::ep; ++c) {
    bool sheared = false;
    for (int t = 0; t < Dim; ++t) sheared = sheared || (t != Axis && c == C::s + C::stress(Axis, t));
    const bool from_trace = Dim == 3 && Axis == 2 && c < C::s + 2;
    if (!(Shear && sheared) && !from_trace) plain(c, detail::stress_scale);
  }
  if constexpr (Dim == 3 && Axis == 2) detail::reconstruct_turned(in, to, low, high);
  if (in.ahead) detail::move_half_step<Dim, Axis, Shear>(shear_modulus, eos.barotropic, in, to, low, high);
  for (int c = C::ep; c < static_cast<int>(in.carried()); ++c)
    detail::keep_positive(of(c), in.count, low.value[c] + to, high.value[c] + to);
}

namespace detail {

/// Which reconstructed states are used, and their longitudinal sound speed.
struct StateBounds {
  double least_rho, least_c2;  // kg/m3, m2/s2
  double stiffness;            // 4/3 G [Pa]

  StateBounds(const AnyEos& eos, double shear_modulus)
      : least_rho(0.6 * density_range(eos).least * eos.rho0),
        least_c2(least_sound_squared(eos)),
        stiffness(4.0 / 3 * shear_modulus) {}

  /// @param own density of the average of the cell that the state belongs to.
  [[gnu::always_inline]] bool admit(double rho, double own, double c2) const {
    return (rho > 0.5 * own) & (rho < 2 * own) & (rho > least_rho) & (c2 >= least_c2);
  }
  [[gnu::always_inline]] double longitudinal_speed(double rho, double c2) const {
    return std::sqrt((c2 > least_c2 ? c2 : least_c2) + stiffness / rho);
  }
};

/// The states on one side of a row of faces, from place `from` of `values` on.
template <int Dim>
struct FaceSide {
  FaceValues<Dim>& values;
  int from = 0;
  const double* sound = nullptr;  // c_L [faces]

  const double* of(std::size_t c) const { return values.value[c] + from; }
  const double* stress() const { return values.stress + from; }
};

/// Completes one side: p from the stress, and c_L into `sound`. States out of bounds are replaced by the
/// average of their cell. @param shift distance in memory from a face's upper cell to the one on this side.
/// @returns how many states were replaced.
template <int Dim, int Axis>
int complete_side(const AnyEos& eos, StateBounds bounds, const Row<Dim>& in, std::ptrdiff_t shift,
                  FaceValues<Dim>& w, int from, double* sound) {
  using C = Components<Dim>;
  const double *own = in.primitive + C::rho * in.cells + in.first + shift, *rho = w.value[C::rho] + from,
               *stress = w.stress + from, *crushed = w.value[C::crushed] + from;
  double* p = w.value[C::p] + from;
#pragma omp simd
  for (int i = 0; i < in.count; ++i) p[i] = normal_deviator<Dim, Axis>(w.value, i + from) - stress[i];
  eos.sound_speeds_squared(rho, p, crushed, static_cast<std::size_t>(in.count), sound);
  int bad = 0;
#pragma omp simd reduction(+ : bad)
  for (int i = 0; i < in.count; ++i) {
    const double c2 = sound[i];
    sound[i] = bounds.longitudinal_speed(rho[i], c2);
    bad += bounds.admit(rho[i], own[i], c2) ? 0 : 1;
  }
  if (bad == 0) return 0;
  for (int i = 0; i < in.count; ++i) {
    double* value = &w.value[0][i + from];
    if (bounds.admit(value[0], own[i], eos.sound_speed_squared(value[0], p[i], crushed[i]))) continue;
    if (in.failed && in.failed[in.first + i + shift] == with_void) --bad;  // left to solve_failed_faces()
    for (std::size_t c = 0; c < C::primitives; ++c)
      value[c * FaceValues<Dim>::room] = in.primitive[c * in.cells + in.first + i + shift];
    w.stress[i + from] = in.stress[in.first + i + shift];
    sound[i] = bounds.longitudinal_speed(value[0], eos.sound_speed_squared(value[0], p[i], crushed[i]));
  }
  return bad;
}

/// The waves along the axis: mass, normal momentum and energy, and the normal star velocity.
/// @param inverse out: 1/m of the side that the face looks at, 0 where the whole fan goes one way; m is the
/// mass per area and time that runs through that side's outer wave.
template <int Dim, int Axis>
[[gnu::always_inline]] inline void solve_normal_waves(const AnyEos& eos, int count, const FaceSide<Dim>& left,
                                                      const FaceSide<Dim>& right, const FaceFlux<Dim>& out,
                                                      double* inverse) {
  using C = Components<Dim>;
  constexpr std::size_t un = C::u + Axis;
  const double *rho_left = left.of(C::rho), *rho_right = right.of(C::rho), *u_left = left.of(un),
               *u_right = right.of(un), *s_left = left.stress(), *s_right = right.stress(),
               *p_left = left.of(C::p), *p_right = right.of(C::p), *c_left = left.sound,
               *c_right = right.sound;
  double *mass_flux = out.flux_of(C::rho), *normal = out.flux_of(un), *power = out.flux_of(C::energy),
         *speed = out.velocity_along(Axis);
  alignas(64) double rho_behind[longest_row], p_behind[longest_row], energy[longest_row],
      kinetic[longest_row], work[longest_row];  // of the side that the face looks at
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const double rl = rho_left[i], rr = rho_right[i], ul = u_left[i], ur = u_right[i], sl = s_left[i],
                 sr = s_right[i], cl = c_left[i], cr = c_right[i];
    const double low = ul - cl < ur - cr ? ul - cl : ur - cr, high = ul + cl > ur + cr ? ul + cl : ur + cr;
    const double ml = rl * (low - ul), mr = rr * (high - ur);
    const double star = (sl - sr + ml * ul - mr * ur) / (ml - mr), stress_star = sl - ml * (star - ul);
    const bool from_left = star >= 0;
    const double wave = from_left ? low : high, m = from_left ? ml : mr;
    const bool beyond = (from_left & (low >= 0)) | (!from_left & (high <= 0));
    const double rho = from_left ? rl : rr, u = from_left ? ul : ur, s = from_left ? sl : sr;
    const double mass = beyond ? rho * u : m / (wave - star) * star;
    const double out_u = beyond ? u : star, out_s = beyond ? s : stress_star;
    const double per_m = beyond ? 0.0 : 1 / m;
    rho_behind[i] = rho;
    p_behind[i] = from_left ? p_left[i] : p_right[i];
    kinetic[i] = 0.5 * u * u;
    work[i] = (stress_star * star - s * u) * per_m;
    inverse[i] = per_m;
    mass_flux[i] = mass;
    normal[i] = mass * out_u - out_s;
    power[i] = out_s * out_u;
    speed[i] = out_u;
  }
  alignas(64) double crushed_behind[longest_row];
  const double* crushed = left.of(C::crushed);
  if (eos.porous) {
    for (int i = 0; i < count; ++i) crushed_behind[i] = (speed[i] >= 0 ? left : right).of(C::crushed)[i];
    crushed = crushed_behind;
  }
  eos.energies(rho_behind, p_behind, crushed, static_cast<std::size_t>(count), energy);
#pragma omp simd
  for (int i = 0; i < count; ++i) energy[i] += kinetic[i];
  if (eos.barotropic) {
    const double *extra_left = left.of(C::extra), *extra_right = right.of(C::extra);
#pragma omp simd
    for (int i = 0; i < count; ++i) energy[i] += speed[i] >= 0 ? extra_left[i] : extra_right[i];
  }
#pragma omp simd
  for (int i = 0; i < count; ++i) power[i] = mass_flux[i] * (energy[i] - work[i]) - power[i];
}

/// The shear waves of a solid along axis t: its momentum and star velocity, and what they add to the energy.
template <int Dim, int Axis>
[[gnu::always_inline]] inline void solve_shear_waves(int t, double shear_modulus, int count,
                                                     const FaceSide<Dim>& left, const FaceSide<Dim>& right,
                                                     const FaceFlux<Dim>& out, const double* inverse) {
  using C = Components<Dim>;
  const std::size_t ut = C::u + t, at = C::s + C::stress(Axis, t);
  const double *mass = out.flux_of(C::rho), *normal_speed = out.velocity_along(Axis);
  const double *v_left = left.of(ut), *v_right = right.of(ut), *tau_left = left.of(at),
               *tau_right = right.of(at), *rho_left = left.of(C::rho), *rho_right = right.of(C::rho);
  double *momentum = out.flux_of(ut), *power = out.flux_of(C::energy), *speed = out.velocity_along(t);
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const bool from_left = normal_speed[i] >= 0, beyond = inverse[i] == 0;
    const double vl = v_left[i], vr = v_right[i], v = from_left ? vl : vr;
    const double tl = tau_left[i], tr = tau_right[i], tau = from_left ? tl : tr;
    const double zl = std::sqrt(rho_left[i] * shear_modulus), zr = std::sqrt(rho_right[i] * shear_modulus);
    const double v_star = (zl * vl + zr * vr + tr - tl) / (zl + zr), tau_star = tl + zl * (v_star - vl);
    const double v_out = beyond ? v : v_star, tau_out = beyond ? tau : tau_star;
    const double work = (tau_out * v_out - tau * v) / (from_left ? -zl : zr);
    momentum[i] = mass[i] * v_out - tau_out;
    power[i] += mass[i] * (0.5 * v * v - work) - tau_out * v_out;
    speed[i] = v_out;
  }
}

/// A fluid carries its velocity along axis t with it.
template <int Dim, int Axis>
[[gnu::always_inline]] inline void carry_velocity(int t, int count, const FaceSide<Dim>& left,
                                                  const FaceSide<Dim>& right, const FaceFlux<Dim>& out) {
  using C = Components<Dim>;
  const std::size_t ut = C::u + t;
  const double *mass = out.flux_of(C::rho), *normal_speed = out.velocity_along(Axis);
  const double *v_left = left.of(ut), *v_right = right.of(ut);
  double *momentum = out.flux_of(ut), *power = out.flux_of(C::energy), *speed = out.velocity_along(t);
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const double v = normal_speed[i] >= 0 ? v_left[i] : v_right[i];
    momentum[i] = mass[i] * v;
    power[i] += mass[i] * (0.5 * v * v);
    speed[i] = v;
  }
}

}  // namespace detail

/// Fluxes through a row of faces across `Axis`, from the values on their left (from place `left_from` of its
/// row) and on their right: an HLLC solver whose wave speeds are elastic, with acoustic shear waves.
/// Unphysical values fall back to the cell's own state, for which `in` is read.
/// @returns how many values fell back.
template <int Dim, int Axis, bool Shear>
int solve_faces(const AnyEos& eos, double shear_modulus, const Row<Dim>& in, FaceValues<Dim>& left_values,
                int left_from, FaceValues<Dim>& right_values, int right_from, const FaceFlux<Dim>& out) {
  using C = Components<Dim>;
  const int count = in.count;
  const detail::StateBounds bounds(eos, shear_modulus);
  alignas(64) double sound_left[longest_row], sound_right[longest_row], inverse[longest_row];
  const int fallen =
      detail::complete_side<Dim, Axis>(eos, bounds, in, -in.step, left_values, left_from, sound_left) +
      detail::complete_side<Dim, Axis>(eos, bounds, in, 0, right_values, right_from, sound_right);

  const detail::FaceSide<Dim> left{left_values, left_from, sound_left},
      right{right_values, right_from, sound_right};
  detail::solve_normal_waves<Dim, Axis>(eos, count, left, right, out, inverse);
  for (int t = 0; t < Dim; ++t) {
    if (t == Axis) continue;
    if constexpr (Shear)
      detail::solve_shear_waves<Dim, Axis>(t, shear_modulus, count, left, right, out, inverse);
    else
      detail::carry_velocity<Dim, Axis>(t, count, left, right, out);
  }
  const double *mass = out.flux_of(C::rho), *normal_speed = out.velocity_along(Axis);
  for (std::size_t c = C::s; c < in.carried(); ++c) {
    const double *l = left.of(c), *r = right.of(c);
    double* f = out.flux_of(c);
#pragma omp simd
    for (int i = 0; i < count; ++i) f[i] = mass[i] * (normal_speed[i] >= 0 ? l[i] : r[i]);
  }
  return fallen;
}

/// reconstruct() and solve_faces() for a row of faces that stands alone. @returns how many values fell back.
template <int Dim, int Axis, bool Shear>
int face_fluxes(const AnyEos& eos, double shear_modulus, const Row<Dim>& in, const FaceFlux<Dim>& out) {
  FaceValues<Dim> left, right, beyond;
  Row<Dim> cells = in;
  cells.first = in.first - in.step;
  reconstruct<Dim, Axis, Shear>(eos, shear_modulus, cells, 0, beyond, left);
  cells.first = in.first;
  reconstruct<Dim, Axis, Shear>(eos, shear_modulus, cells, 0, right, beyond);
  return solve_faces<Dim, Axis, Shear>(eos, shear_modulus, in, left, 0, right, 0, out);
}

}  // namespace recoil
