#pragma once

#include <cstddef>

#include "dynamics/primitives.hpp"
#include "dynamics/reconstruction.hpp"

namespace recoil {

/// The longest row of faces that one call takes.
inline constexpr int longest_row = 96;

/// Where a row of faces reads. Face i of the row lies between cells `first + i - step` and `first + i` of
/// arrays that hold every component of every cell of a window.
template <int Dim>
struct FaceRow {
  const double* primitive = nullptr;   // [Components::primitives][cells]
  const double* stress = nullptr;      // [cells] sigma_nn = S_nn - p along the row's axis
  const double* impedance = nullptr;   // [cells] rho c_L
  std::size_t cells = 0;               // of the window
  std::ptrdiff_t first = 0, step = 1;  // step: distance in memory along the axis that the faces cross
  int count = 0;
};

/// Flux per area along the axis, and the star velocities.
template <int Dim>
struct FaceFlux {
  double* flux = nullptr;      // [Components::contents][faces]
  double* velocity = nullptr;  // [Dim][faces]
  std::size_t faces = 0;       // distance between components
  std::ptrdiff_t first = 0;    // place of the row's first face
};

/// Fluxes through one row of faces across `Axis`: WENO5-Z of the characteristic-like sigma +- Z u and tau +-
/// Z_s v and of the remaining primitives, then an HLLC solver whose wave speeds are elastic, with acoustic
/// shear waves. Unphysical reconstructions fall back to the cell's own state.
/// @param shear false for fluids: no shear waves at all.
/// @returns how many states fell back.
template <int Dim, int Axis, bool Shear, class EosModel>
int face_fluxes(const EosModel& eos, double shear_modulus, const FaceRow<Dim>& in, const FaceFlux<Dim>& out) {
  using C = Components<Dim>;
  constexpr auto P = static_cast<std::size_t>(C::primitives);
  constexpr std::size_t un = C::u + Axis;
  const std::ptrdiff_t st = in.step;
  const int count = in.count;
  alignas(64) double left[P][longest_row], right[P][longest_row], stress_left[longest_row],
      stress_right[longest_row];
  const auto of = [&](std::size_t c) { return in.primitive + c * in.cells + in.first; };

  const auto plain = [&](std::size_t c, double least) {
    const double* q = of(c);
    double *l = left[c], *r = right[c];
#pragma omp simd
    for (int i = 0; i < count; ++i) {
      const double a = q[i - 3 * st], b = q[i - 2 * st], x = q[i - st], y = q[i], d = q[i + st],
                   e = q[i + 2 * st];
      l[i] = weno5z(a, b, x, y, d, least);
      r[i] = weno5z(e, d, y, x, b, least);
    }
  };
  const double velocity_scale = 1e-2, stress_scale = 1e8;
  plain(C::rho, 1e-6 * eos.rho0 * eos.rho0);
  for (std::size_t c = C::s; c < C::ep; ++c) {
    bool sheared = false;
    for (int t = 0; t < Dim; ++t)
      sheared = sheared || (t != Axis && static_cast<int>(c) == C::s + C::stress(Axis, t));
    if (!(Shear && sheared)) plain(c, stress_scale);
  }
  plain(C::ep, 1e-12);
  plain(C::heat, 1e-6);
  if constexpr (EosModel::barotropic) plain(C::extra, 1e-2);

  // sigma + Z u and sigma - Z u, back to sigma and u on both sides
  {
    const double *s = in.stress + in.first, *u = of(un), *z = in.impedance + in.first;
    double *ul = left[un], *ur = right[un];
#pragma omp simd
    for (int i = 0; i < count; ++i) {
      const double Z = 0.5 * (z[i - st] + z[i]), half = 0.5 / Z;
      const double sa = s[i - 3 * st], sb = s[i - 2 * st], sx = s[i - st], sy = s[i], sd = s[i + st],
                   se = s[i + 2 * st];
      const double ua = Z * u[i - 3 * st], ub = Z * u[i - 2 * st], ux = Z * u[i - st], uy = Z * u[i],
                   ud = Z * u[i + st], ue = Z * u[i + 2 * st];
      const double al = weno5z(sa + ua, sb + ub, sx + ux, sy + uy, sd + ud, stress_scale);
      const double ar = weno5z(se + ue, sd + ud, sy + uy, sx + ux, sb + ub, stress_scale);
      const double bl = weno5z(sa - ua, sb - ub, sx - ux, sy - uy, sd - ud, stress_scale);
      const double br = weno5z(se - ue, sd - ud, sy - uy, sx - ux, sb - ub, stress_scale);
      stress_left[i] = 0.5 * (al + bl);
      stress_right[i] = 0.5 * (ar + br);
      ul[i] = (al - bl) * half;
      ur[i] = (ar - br) * half;
    }
  }
  for (int t = 0; t < Dim; ++t) {
    if (t == Axis) continue;
    const auto ut = static_cast<std::size_t>(C::u + t),
               tau = static_cast<std::size_t>(C::s + C::stress(Axis, t));
    if constexpr (!Shear) {
      plain(ut, velocity_scale);
      continue;
    }
    const double *s = of(tau), *u = of(ut), *rho = of(C::rho);
    double *ul = left[ut], *ur = right[ut], *sl = left[tau], *sr = right[tau];
#pragma omp simd
    for (int i = 0; i < count; ++i) {
      const double Z = 0.5 * (std::sqrt(rho[i - st] * shear_modulus) + std::sqrt(rho[i] * shear_modulus)),
                   half = 0.5 / Z;
      const double sa = s[i - 3 * st], sb = s[i - 2 * st], sx = s[i - st], sy = s[i], sd = s[i + st],
                   se = s[i + 2 * st];
      const double ua = Z * u[i - 3 * st], ub = Z * u[i - 2 * st], ux = Z * u[i - st], uy = Z * u[i],
                   ud = Z * u[i + st], ue = Z * u[i + 2 * st];
      const double al = weno5z(sa + ua, sb + ub, sx + ux, sy + uy, sd + ud, stress_scale);
      const double ar = weno5z(se + ue, sd + ud, sy + uy, sx + ux, sb + ub, stress_scale);
      const double bl = weno5z(sa - ua, sb - ub, sx - ux, sy - uy, sd - ud, stress_scale);
      const double br = weno5z(se - ue, sd - ud, sy - uy, sx - ux, sb - ub, stress_scale);
      sl[i] = 0.5 * (al + bl);
      sr[i] = 0.5 * (ar + br);
      ul[i] = (al - bl) * half;
      ur[i] = (ar - br) * half;
    }
  }

  // S_nn of a 3-d axis 2 is not stored: it follows from the trace.
  const auto normal_stress = [](const auto& w, int i) {
    if constexpr (Dim == 3 && Axis == 2)
      return -(w[C::s][i] + w[C::s + 1][i]);
    else
      return w[C::s + C::stress(Axis, Axis)][i];
  };
  const double c0 = bulk_sound_speed(eos), least_c2 = least_sound * c0 * c0, least_rho = 0.3 * eos.rho0;
  int fallen = 0;
  const auto mend = [&](double(*w)[longest_row], double* stress, std::ptrdiff_t shift) {
    const double* rho = of(C::rho) + shift;
#pragma omp simd reduction(+ : fallen)
    for (int i = 0; i < count; ++i) {
      const double r = w[C::rho][i], p = normal_stress(w, i) - stress[i];
      w[C::p][i] = p;
      const bool good = (r > 0.5 * rho[i]) & (r < 2 * rho[i]) & (r > least_rho) &
                        (eos.sound_speed_squared(r, p) >= least_c2);
      fallen += good ? 0 : 1;
    }
  };
  mend(left, stress_left, -st);
  mend(right, stress_right, 0);
  if (fallen > 0) {
    const auto restore = [&](double(*w)[longest_row], double* stress, std::ptrdiff_t shift) {
      for (int i = 0; i < count; ++i) {
        const double r = w[C::rho][i], rho = of(C::rho)[i + shift];
        if ((r > 0.5 * rho) & (r < 2 * rho) & (r > least_rho) &
            (eos.sound_speed_squared(r, w[C::p][i]) >= least_c2))
          continue;
        for (std::size_t c = 0; c < P; ++c) w[c][i] = of(c)[i + shift];
        stress[i] = in.stress[in.first + i + shift];
      }
    };
    restore(left, stress_left, -st);
    restore(right, stress_right, 0);
  }

  double *flux = out.flux + out.first, *velocity = out.velocity + out.first;
  const std::size_t nf = out.faces;
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const auto c_long = [&](double rho, double p) {
      const double c2 = eos.sound_speed_squared(rho, p);
      return std::sqrt((c2 > least_c2 ? c2 : least_c2) + 4 * shear_modulus / (3 * rho));
    };
    const double rl = left[C::rho][i], rr = right[C::rho][i], ul = left[un][i], ur = right[un][i];
    const double sl = stress_left[i], sr = stress_right[i];
    const double cl = c_long(rl, left[C::p][i]), cr = c_long(rr, right[C::p][i]);
    const double low = ul - cl < ur - cr ? ul - cl : ur - cr, high = ul + cl > ur + cr ? ul + cl : ur + cr;
    const double ml = rl * (low - ul), mr = rr * (high - ur);
    const double star = (sl - sr + ml * ul - mr * ur) / (ml - mr), stress_star = sl - ml * (star - ul);
    const bool from_left = star >= 0;
    const double wave = from_left ? low : high, m = from_left ? ml : mr;
    const bool beyond = from_left ? low >= 0 : high <= 0;  // the whole fan goes one way
    const double rho = from_left ? rl : rr, u = from_left ? ul : ur, s = from_left ? sl : sr,
                 p = from_left ? left[C::p][i] : right[C::p][i];
    double energy = eos.energy(rho, p) + 0.5 * u * u;
    if constexpr (EosModel::barotropic) energy += from_left ? left[C::extra][i] : right[C::extra][i];
    double star_energy = energy - (stress_star * star - s * u) / m;
    const double mass = beyond ? rho * u : m / (wave - star) * star;
    const double out_u = beyond ? u : star, out_s = beyond ? s : stress_star;
    double work = out_s * out_u;
    for (int t = 0; t < Dim; ++t) {
      if (t == Axis) continue;
      const auto ut = static_cast<std::size_t>(C::u + t);
      const double vl = left[ut][i], vr = right[ut][i], v = from_left ? vl : vr;
      double v_out = v, tau_out = 0;
      energy += 0.5 * v * v;
      star_energy += 0.5 * v * v;
      if constexpr (Shear) {
        const auto at = static_cast<std::size_t>(C::s + C::stress(Axis, t));
        const double tl = left[at][i], tr = right[at][i], tau = from_left ? tl : tr;
        const double zl = std::sqrt(rl * shear_modulus), zr = std::sqrt(rr * shear_modulus);
        const double v_star = (zl * vl + zr * vr + tr - tl) / (zl + zr), tau_star = tl + zl * (v_star - vl);
        star_energy -= (tau_star * v_star - tau * v) / (from_left ? -zl : zr);
        v_out = beyond ? v : v_star;
        tau_out = beyond ? tau : tau_star;
      }
      flux[ut * nf + static_cast<std::size_t>(i)] = mass * v_out - tau_out;
      velocity[static_cast<std::size_t>(t) * nf + static_cast<std::size_t>(i)] = v_out;
      work += tau_out * v_out;
    }
    flux[C::rho * nf + static_cast<std::size_t>(i)] = mass;
    flux[un * nf + static_cast<std::size_t>(i)] = mass * out_u - out_s;
    flux[C::energy * nf + static_cast<std::size_t>(i)] = mass * (beyond ? energy : star_energy) - work;
    velocity[static_cast<std::size_t>(Axis) * nf + static_cast<std::size_t>(i)] = out_u;
    for (std::size_t c = C::s; c < C::contents; ++c)
      flux[c * nf + static_cast<std::size_t>(i)] = mass * (from_left ? left[c][i] : right[c][i]);
  }
  return fallen;
}

}  // namespace recoil
