#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "core/constants.hpp"
#include "core/vec.hpp"
#include "field/components.hpp"

namespace recoil {

/// Of the squared yield stress: from here on a state that loads yields.
inline constexpr double at_yield = 0.96;

/// What the rates of a state need to know of its material and of whether it yields.
struct Response {
  double bulk = 0;     // rho c_b^2 [Pa]
  double shear = 0;    // G [Pa]
  double loading = 0;  // 1/|S| where the state is at yield and goes on loading, 0 where it is elastic [1/Pa]
};

/// S_ij of a state or of a difference, S_zz in 3-D from the trace.
template <int Dim, class Values>
[[gnu::always_inline]] constexpr double deviator(const Values& w, int i, int j) {
  using C = Components<Dim>;
  const int c = C::stress(i, j);
  return c >= 0 ? w[C::s + c] : -(w[C::s] + w[C::s + 1]);
}

/// The same with indices that are constants (core/constants.hpp).
template <int Dim, int i, int j, class Values>
RECOIL_INLINE constexpr double deviator(const Values& w, std::integral_constant<int, i>,
                                        std::integral_constant<int, j>) {
  using C = Components<Dim>;
  constexpr int c = C::stress(i, j);
  if constexpr (c >= 0)
    return w[C::s + c];
  else
    return -(w[C::s] + w[C::s + 1]);
}

/// Rates of the primitives at a fixed place in the frame of `speed` by their derivatives along one axis:
/// -(u_a - speed) dw/dx_a and what the gradient does,
///   rho_t = -rho du_a/dx_a, u_i,t = (dS_ia/dx_a - delta_ia dp/dx_a)/rho, p_t = -rho c_b^2 du_a/dx_a,
///   S_t = 2 G dev D + W S - S W, less 2 G n (n:D) with n = S/|S| where the state yields.
/// Growth of plastic strain and temperature is left to the return to yield.
/// @param slope d/dx_a of all primitives. @param ride u_a - speed [m/s].
template <int Dim, int a>
[[gnu::always_inline]] inline Primitives<Dim> rate_along(const Primitives<Dim>& w,
                                                         const Primitives<Dim>& slope, double ride,
                                                         const Response& m) {
  using C = Components<Dim>;
  constexpr std::integral_constant<int, a> axis;
  Primitives<Dim> r;
  for_each_constant<C::primitives>([&](auto c) RECOIL_INLINE { r[c] = -ride * slope[c]; });
  const double stretch = slope[C::u + a], per_rho = 1 / w[C::rho];
  r[C::rho] -= w[C::rho] * stretch;
  r[C::p] -= m.bulk * stretch;
  for_each_axis<Dim>([&](auto i) RECOIL_INLINE {
    r[C::u + i] += (deviator<Dim>(slope, i, axis) - (i == a ? slope[C::p] : 0.0)) * per_rho;
  });
  // L has the one column a: D_ij = (delta_ja L_i + delta_ia L_j)/2, W_ij = (delta_ja L_i - delta_ia L_j)/2.
  double flow = 0;  // n:D/|S|
  for_each_axis<Dim>([&](auto i) RECOIL_INLINE { flow += deviator<Dim>(w, i, axis) * slope[C::u + i]; });
  flow *= m.loading * m.loading;
  for_each_axis<Dim>([&](auto i) RECOIL_INLINE {
    for_each_axis<Dim>([&](auto j) RECOIL_INLINE {
      constexpr int c = C::stress(i, j);
      if constexpr (j >= i && c >= 0) {
        const double li = slope[C::u + i], lj = slope[C::u + j];
        double sum = m.shear * ((j == a ? li : 0.0) + (i == a ? lj : 0.0) -
                                (i == j ? 2.0 / 3 * stretch : 0.0) - 2 * flow * w[C::s + c]);
        for_each_axis<Dim>([&](auto k) RECOIL_INLINE {
          const double lk = slope[C::u + k];
          const double w_ik = 0.5 * ((k == a ? li : 0.0) - (i == a ? lk : 0.0)),
                       w_kj = 0.5 * ((j == a ? lk : 0.0) - (k == a ? lj : 0.0));
          sum += w_ik * deviator<Dim>(w, k, j) - deviator<Dim>(w, i, k) * w_kj;
        });
        r[C::s + c] += sum;
      }
    });
  });
  return r;
}

/// |A| times a difference of the primitives along one axis, A the matrix of the waves along it: those of
/// compression with c_L, of shear with sqrt(G/rho), and all that rides with |u_a|.
/// @param bend the difference that waves of compression take.
template <int Dim, int a>
[[gnu::always_inline]] inline Primitives<Dim> times_speeds(const Primitives<Dim>& w,
                                                           const Primitives<Dim>& difference,
                                                           const Primitives<Dim>& bend, const Response& m) {
  using C = Components<Dim>;
  constexpr std::integral_constant<int, a> axis;
  const double per_rho = 1 / w[C::rho], stiffness = m.bulk + 4.0 / 3 * m.shear,
               sound = std::sqrt(stiffness * per_rho), shear_sound = std::sqrt(m.shear * per_rho),
               ride = std::abs(w[C::u + a]);
  const double strain = sound * (deviator<Dim>(bend, axis, axis) - bend[C::p]) / stiffness;
  Primitives<Dim> r;
  for_each_constant<C::primitives>([&](auto c) RECOIL_INLINE { r[c] = ride * difference[c]; });
  r[C::rho] -= w[C::rho] * strain;
  r[C::p] -= m.bulk * strain;
  for_each_axis<Dim>([&](auto i) RECOIL_INLINE {
    r[C::u + i] += i == a ? sound * bend[C::u + i] : shear_sound * difference[C::u + i];
    constexpr int on = C::stress(i, i), beside = C::stress(i, a);
    if constexpr (on >= 0) r[C::s + on] += (i == a ? 4.0 / 3 : -2.0 / 3) * m.shear * strain;
    if constexpr (i != a) r[C::s + beside] += shear_sound * difference[C::s + beside];
  });
  return r;
}

/// Rates by the widening of rings, where axisymmetric: hoop strain rate D_tt = u_r/r; of shells, where
/// spherical, twice that. `turn` 0 leaves out what the hoop stress does to the velocity (theory:
/// axisymmetry).
template <int Dim>
[[gnu::always_inline]] inline void add_widening(const Primitives<Dim>& w, double widening, double turn,
                                                const Response& m, Primitives<Dim>& r) {
  using C = Components<Dim>;
  constexpr int hoops = Dim == 1 ? 2 : 1;
  double hoop = -0.5 * w[C::s];
  if constexpr (Dim == 2) hoop = -(w[C::s] + w[C::s + 1]);
  const double flow = hoops * hoop * widening * m.loading * m.loading;
  r[C::rho] -= hoops * w[C::rho] * widening;
  r[C::p] -= hoops * m.bulk * widening;
  r[C::u] += hoops * turn * (w[C::s] - hoop) / w[C::rho];
  for (int c = 0; c < Dim; ++c) r[C::s + c] -= 2 * m.shear * (hoops * widening / 3 + flow * w[C::s + c]);
  if constexpr (Dim == 2) {
    r[C::u + 1] += turn * w[C::s + 2] / w[C::rho];
    r[C::s + 2] -= 2 * m.shear * flow * w[C::s + 2];
  }
}

/// S:D of a state by the derivatives along one axis.
template <int Dim, int Axis>
[[gnu::always_inline]] inline double working_along(const Primitives<Dim>& w, const Primitives<Dim>& slope) {
  double sum = 0;
  for_each_axis<Dim>([&](auto i) RECOIL_INLINE {
    sum += deviator<Dim>(w, i, std::integral_constant<int, Axis>{}) * slope[Components<Dim>::u + i];
  });
  return sum;
}

}  // namespace recoil
