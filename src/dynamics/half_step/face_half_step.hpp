#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "core/multiversion.hpp"
#include "dynamics/face_values.hpp"
#include "dynamics/half_step/half_step.hpp"
#include "dynamics/half_step/loading.hpp"

/// The values of cells at their faces in the middle of a step of one stage (theory: one stage a step).
namespace recoil::detail {

/// In 1-D cells that yield stay with their waves, at the speed of the plastic tangent: with the whole step
/// along the one axis that keeps the front of a plastic shock steep and quiet behind. In more dimensions,
/// where a step is shared between the axes, they move by their own differences.
template <int Dim>
inline constexpr bool yields_by_waves = Dim == 1;

/// Mean over a step of what crosses a face out of a cell: a parabola with the values `near` the face and
/// `far` from it and the mean `mean`, moved towards the face by the part `passed` of the cell (Colella &
/// Woodward 1984).
[[gnu::always_inline]] inline double mean_leaving(double near, double far, double mean, double passed) {
  const double bulge = 6 * (mean - 0.5 * (near + far));
  return near - 0.5 * passed * ((near - far) - (1 - 2.0 / 3 * passed) * bulge);
}

[[gnu::always_inline]] inline double part_passed(double speed) {
  return speed > 0 ? (speed < 1 ? speed : 1.0) : 0.0;
}

/// How far the waves of a row of cells move in a step, in cells: out of the high face and out of the low one.
struct Passed {
  alignas(64) double high[row_room], low[row_room];
};

/// `speed(i)` [cells per step] of the waves to both sides, `ride(i)` of the matter.
template <class Speed, class Ride>
[[gnu::always_inline]] inline void find_passed(int count, const Speed& speed, const Ride& ride, Passed& out) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const double c = speed(i), u = ride(i);
    out.high[i] = part_passed(c + u);
    out.low[i] = part_passed(c - u);
  }
}

/// The same of the waves that run against the matter and are swept out with it, where it is faster than
/// sound: stress + Z u out of the high face, stress - Z u out of the low one.
/// @returns whether any is.
template <class Speed, class Ride>
[[gnu::always_inline]] inline bool find_swept(int count, const Speed& speed, const Ride& ride, Passed& out) {
  double most = 0;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const double c = speed(i), u = ride(i);
    out.high[i] = part_passed(u - c);
    out.low[i] = part_passed(-u - c);
    most += out.high[i] + out.low[i];
  }
  return most > 0;
}

/// What rides with the matter: both ends, where it flows out through them.
inline void move_riding(int count, const Passed& passed, const double* mean, double* low, double* high) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const double l = low[i], h = high[i];
    high[i] = mean_leaving(h, l, mean[i], passed.high[i]);
    low[i] = mean_leaving(l, h, mean[i], passed.low[i]);
  }
}

/// The waves stress -+ Z u of a row: stress - Z u runs up the axis, stress + Z u down it; each end gets what
/// leaves the cell there: the one that runs that way, and, in matter faster than sound, the other one too.
template <bool Swept, class Impedance>
[[gnu::always_inline]] inline void move_waves(int count, const Passed& passed, const Passed& swept,
                                              const Impedance& impedance, const double* stress,
                                              const double* u, double* stress_low, double* stress_high,
                                              double* u_low, double* u_high) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const double z = impedance(i), half = 0.5 / z;
    const double sl = stress_low[i], sh = stress_high[i], ul = z * u_low[i], uh = z * u_high[i];
    const double up_mean = stress[i] - z * u[i], down_mean = stress[i] + z * u[i];
    const double up_low = sl - ul, up_high = sh - uh, down_low = sl + ul, down_high = sh + uh;
    const double up = mean_leaving(up_high, up_low, up_mean, passed.high[i]);
    const double down = mean_leaving(down_low, down_high, down_mean, passed.low[i]);
    double kept_down = down_high, kept_up = up_low;
    if constexpr (Swept) {
      kept_down = mean_leaving(down_high, down_low, down_mean, swept.high[i]);
      kept_up = mean_leaving(up_low, up_high, up_mean, swept.low[i]);
    }
    stress_high[i] = 0.5 * (kept_down + up);
    u_high[i] = (kept_down - up) * half;
    stress_low[i] = 0.5 * (down + kept_up);
    u_low[i] = (down - kept_up) * half;
  }
}

/// Density and deviator at one end follow the stress `to` from what has ridden there, `stress`, along the
/// isentrope: d rho = -d sigma/c^2, dS_nn = (4/3 G/(rho c_L^2)) d sigma, 0 where the cell yields; p follows
/// from the two. `speed` c(i) [m/s] of the waves.
template <int Dim, int Axis, class Speed>
[[gnu::always_inline]] inline void follow_stress(int count, const double* g, const double* rho_mean,
                                                 const double* loading, const Speed& speed,
                                                 const double* ridden, FaceValues<Dim>& w, int to) {
  using C = Components<Dim>;
  double* rho = w.value[C::rho] + to;
  const double* stress = w.stress + to;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const double c = speed(i), strain = (stress[i] - ridden[i]) / (rho_mean[i] * c * c);
    const double stiffness = loading[i] > 0 ? 0.0 : g[i];
    rho[i] -= rho_mean[i] * strain;
    for (int d = 0; d < Dim; ++d) {
      const int c = C::stress(d, d);
      if (c >= 0) w.value[C::s + c][i + to] += (d == Axis ? 4.0 / 3 : -2.0 / 3) * stiffness * strain;
    }
  }
}

/// Shear stress and the velocity along the face take half a step by central differences along this axis too.
/// Shear waves are slow, and so a body that turns stays free of stress: limited differences would brake it,
/// by a torque of G times what they miss.
template <int Dim, int Axis>
void move_shear(const Row<Dim>& in, int to, FaceValues<Dim>& low, FaceValues<Dim>& high) {
  using C = Components<Dim>;
  for (int t = 0; t < Dim; ++t) {
    if (t == Axis) continue;
    for (const int c : {C::u + t, C::s + C::stress(Axis, t)}) {
      const double* change = in.ahead->change[Axis] + c * in.cells + in.first;
      double *l = low.value[c] + to, *h = high.value[c] + to;
#pragma GCC ivdep
      for (int i = 0; i < in.count; ++i) {
        l[i] += change[i];
        h[i] += change[i];
      }
    }
  }
}

/// The values of one row of cells at both faces: waves averaged over the step.
template <int Dim, int Axis, bool Shear>
[[gnu::flatten]] RECOIL_MULTIVERSION void move_by_waves(bool has_extra, const Row<Dim>& in, int to,
                                                        FaceValues<Dim>& low, FaceValues<Dim>& high) {
  using C = Components<Dim>;
  const auto of = [&](int c) { return in.primitive + c * in.cells + in.first; };
  const double *rho = of(C::rho), *u = of(C::u + Axis), *z = in.impedance + in.first,
               *stress = in.stress + in.first, *g = in.shear + in.first;
  const double per_dx = in.ahead->per_dx;
  Passed passed;
  const auto ride = [=](int i) { return per_dx * u[i]; };
  find_passed(
      in.count, [](int) { return 0.0; }, ride, passed);
  const auto plain = [&](int c) {
    move_riding(in.count, passed, of(c), low.value[c] + to, high.value[c] + to);
  };
  plain(C::rho);
  const bool only_normal = !Shear;
  for (int c = C::s; c < static_cast<int>(in.carried()); ++c) {
    bool sheared = false;
    for (int t = 0; t < Dim; ++t) sheared = sheared || (t != Axis && c == C::s + C::stress(Axis, t));
    if (only_normal || !sheared) plain(c);
  }
  if (has_extra) plain(C::extra);
  if constexpr (!Shear)
    for (int t = 0; t < Dim; ++t)
      if (t != Axis) plain(C::u + t);

  alignas(64) double ridden_low[row_room], ridden_high[row_room];
#pragma GCC ivdep
  for (int i = 0; i < in.count; ++i) {
    const double l = low.stress[i + to], h = high.stress[i + to];
    ridden_high[i] = mean_leaving(h, l, stress[i], passed.high[i]);
    ridden_low[i] = mean_leaving(l, h, stress[i], passed.low[i]);
  }
  const double* loading = in.ahead->loading + in.first;
  const auto speed = [=](int i) {
    const double c = z[i] / rho[i];
    if constexpr (!yields_by_waves<Dim>) return c;
    return loading[i] > 0 ? std::sqrt(c * c - 4.0 / 3 * g[i] / rho[i]) : c;
  };
  const auto pace = [=](int i) { return per_dx * speed(i); };
  find_passed(in.count, pace, ride, passed);
  Passed swept;
  const auto move = [&]<bool Swept>() {
    move_waves<Swept>(
        in.count, passed, swept, [z](int i) { return z[i]; }, stress, u, low.stress + to, high.stress + to,
        low.value[C::u + Axis] + to, high.value[C::u + Axis] + to);
  };
  if (find_swept(in.count, pace, ride, swept))
    move.template operator()<true>();
  else
    move.template operator()<false>();
  follow_stress<Dim, Axis>(in.count, g, rho, loading, speed, ridden_low, low, to);
  follow_stress<Dim, Axis>(in.count, g, rho, loading, speed, ridden_high, high, to);
}

/// The waves along an axis of a cell that yields and goes on loading, by its plastic tangent.
template <int Dim, int Axis>
struct PlasticWaves {
  const Primitives<Dim>& mean;
  const Response& matter;
  double normal;         // n_nn, n = S/|S|
  double tangent, c, z;  // d sigma/d strain along the axis [Pa], speed [m/s], impedance

  [[gnu::always_inline]] PlasticWaves(const Primitives<Dim>& w, const Response& m)
      : mean(w),
        matter(m),
        normal(deviator<Dim>(w, axis, axis) * m.loading),
        tangent(m.bulk + 2 * m.shear * (2.0 / 3 - normal * normal)),
        c(std::sqrt(tangent / w[Components<Dim>::rho])),
        z(w[Components<Dim>::rho] * c) {}

  /// What leaves through the end `near` beyond what a straight line through both ends gives: the parabola's
  /// share in mean_leaving(). @param sign 1 up the axis, -1 down it. @param pace of the step, over dx [s/m].
  [[gnu::always_inline]] double beyond_line(double sign, double pace, const Primitives<Dim>& near,
                                            const Primitives<Dim>& far) const {
    const double passed = part_passed(pace * (c + sign * mean[u]));
    return passed * (1 - 2.0 / 3 * passed) * 3 *
           (wave(sign, mean) - 0.5 * (wave(sign, near) + wave(sign, far)));
  }

  /// Adds a change of the wave that runs to the side `sign` to a state, along the tangent.
  [[gnu::always_inline]] void add(double change, double sign, Primitives<Dim>& v) const {
    using C = Components<Dim>;
    const double strain = 0.5 * change / tangent, shear = 2 * matter.shear * strain;
    v[u] -= sign * 0.5 * change / z;
    v[C::rho] -= mean[C::rho] * strain;
    v[C::p] -= matter.bulk * strain;
    for_each_constant<C::ep - C::s>(
        [&](auto k) RECOIL_INLINE { v[C::s + k] -= shear * normal * matter.loading * mean[C::s + k]; });
    for_each_axis<Dim>([&](auto d) RECOIL_INLINE {
      constexpr int k = C::stress(d, d);
      if constexpr (k >= 0) v[C::s + k] += (d == Axis ? 2.0 / 3 : -1.0 / 3) * shear;
    });
  }

 private:
  static constexpr std::integral_constant<int, Axis> axis{};
  static constexpr int u = Components<Dim>::u + Axis;

  [[gnu::always_inline]] double wave(double sign, const Primitives<Dim>& v) const {
    return deviator<Dim>(v, axis, axis) - v[Components<Dim>::p] - sign * z * v[u];
  }
};

/// One cell of a row that yields and goes on loading: both ends move by the cell's own differences with the
/// plastic tangent, and those of its waves that leave by their parabolas. `low` and `high` hold the ends of
/// the start of the step, and get those of the middle.
/// @param half of the step, over dx [s/m].
template <int Dim, int Axis>
[[gnu::always_inline]] inline void move_yielding(const Row<Dim>& in, int i, double half, Primitives<Dim>& low,
                                                 Primitives<Dim>& high) {
  using C = Components<Dim>;
  const std::ptrdiff_t k = in.first + i;
  Primitives<Dim> w, slope;
  for (std::size_t c = 0; c < w.size(); ++c) {
    w[c] = in.primitive[c * in.cells + k];
    slope[c] = high[c] - low[c];
  }
  const double z = in.impedance[k], g = in.shear[k];
  const Response m{z * z / w[C::rho] - 4.0 / 3 * g, g, in.ahead->loading[k]};
  const PlasticWaves<Dim, Axis> waves(w, m);
  const double up = waves.beyond_line(1, 2 * half, high, low),
               down = waves.beyond_line(-1, 2 * half, low, high);
  const auto rate = rate_along<Dim, Axis>(w, slope, w[C::u + Axis], m);
  for (std::size_t c = 0; c < w.size(); ++c) {
    low[c] += half * rate[c];
    high[c] += half * rate[c];
  }
  waves.add(up, 1, high);
  waves.add(down, -1, low);
}

/// Takes the ends of one cell out of a row, p from the stress.
template <int Dim, int Axis>
[[gnu::always_inline]] inline Primitives<Dim> end_of(const FaceValues<Dim>& w, int at) {
  using C = Components<Dim>;
  Primitives<Dim> v;
  for (std::size_t c = 0; c < v.size(); ++c) v[c] = w.value[c][at];
  v[C::p] = deviator<Dim>(v, Axis, Axis) - w.stress[at];
  return v;
}

/// Adds what the other axes change, and puts an end of a cell that yields back into its row, at yield.
/// @param before the end at the start of the step.
template <int Dim, int Axis>
[[gnu::always_inline]] inline void put_end(const Row<Dim>& in, int i, const Primitives<Dim>& before,
                                           Primitives<Dim> v, FaceValues<Dim>& w, int at) {
  using C = Components<Dim>;
  const std::ptrdiff_t k = in.first + i;
  if (const double* across = in.ahead->across)
    for (std::size_t c = 0; c < v.size(); ++c) v[c] += across[c * in.cells + k];
  Primitives<Dim> mean;
  for (std::size_t c = 0; c < v.size(); ++c) mean[c] = in.primitive[c * in.cells + k];
  keep_at_yield<Dim>(before, mean, v);
  for (std::size_t c = 0; c < v.size(); ++c) w.value[c][at] = v[c];
  w.stress[at] = deviator<Dim>(v, Axis, Axis) - v[C::p];
}

/// Adds what half a step by the other axes changes to a row of values.
template <int Dim, int Axis>
[[gnu::flatten]] RECOIL_MULTIVERSION void add_across(const Row<Dim>& in, int to, FaceValues<Dim>& w) {
  using C = Components<Dim>;
  const auto of = [&](std::size_t c) { return in.ahead->across + c * in.cells + in.first; };
  for (std::size_t c = 0; c < C::primitives; ++c) {
    if (c == C::p || (c >= in.carried() && c < C::contents)) continue;
    const double* t = of(c);
    double* v = w.value[c] + to;
#pragma GCC ivdep
    for (int i = 0; i < in.count; ++i) v[i] += t[i];
  }
  const double* p = of(C::p);
  double* stress = w.stress + to;
  if constexpr (Dim == 3 && Axis == 2) {
    const double *xx = of(C::s), *yy = of(C::s + 1);
#pragma GCC ivdep
    for (int i = 0; i < in.count; ++i) stress[i] -= xx[i] + yy[i] + p[i];
  } else {
    const double* s = of(C::s + C::stress(Axis, Axis));
#pragma GCC ivdep
    for (int i = 0; i < in.count; ++i) stress[i] += s[i] - p[i];
  }
}

/// Moves the values of a row of cells at their low and high faces, written from place `to` on, from the
/// start of the step to its middle.
/// @param has_extra the matter keeps energy beside its equation of state.
template <int Dim, int Axis, bool Shear>
void move_half_step(bool has_extra, const Row<Dim>& in, int to, FaceValues<Dim>& low, FaceValues<Dim>& high) {
  const double* loading = in.ahead->loading + in.first;
  struct Ends {
    Primitives<Dim> low, high;
    int cell;
  };
  std::array<Ends, row_room> yielding;
  int n = 0;
  // Shells of a sphere change by what has no waves, u_r/r.
  const bool by_differences = !yields_by_waves<Dim> || in.ahead->across;
  if constexpr (Shear)
    for (int i = 0; by_differences && i < in.count; ++i)
      if (loading[i] > 0)
        yielding[n++] = {end_of<Dim, Axis>(low, i + to), end_of<Dim, Axis>(high, i + to), i};
  if (n < in.count) {
    move_by_waves<Dim, Axis, Shear>(has_extra, in, to, low, high);
    if constexpr (Shear) move_shear<Dim, Axis>(in, to, low, high);
    if (in.ahead->across) {
      add_across<Dim, Axis>(in, to, low);
      add_across<Dim, Axis>(in, to, high);
    }
  }
  for (int k = 0; k < n; ++k) {
    Ends& e = yielding[k];
    const Primitives<Dim> low_before = e.low, high_before = e.high;
    move_yielding<Dim, Axis>(in, e.cell, 0.5 * in.ahead->per_dx, e.low, e.high);
    put_end<Dim, Axis>(in, e.cell, low_before, e.low, low, e.cell + to);
    put_end<Dim, Axis>(in, e.cell, high_before, e.high, high, e.cell + to);
  }
}

}  // namespace recoil::detail
