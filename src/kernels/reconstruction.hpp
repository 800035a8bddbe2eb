#pragma once

#include "core/mul_add.hpp"

namespace recoil {

/// The values of a cell at its two faces across an axis.
struct Ends {
  double low, high;
};

/// WENO5-Z (Borges et al. 2008) from the means of five cells, a to e along the axis: the values of the middle
/// one at its low and its high face, which share their measures of smoothness. Written as c plus a
/// correction, so that a constant stays constant to the last bit; mirrored data give the mirrored result to
/// the last bit. The ratios of smoothness are multiplied out, so that there is one division a face. `least`
/// sets the scale below which data count as smooth.
[[gnu::always_inline]] inline Ends weno5z(double a, double b, double c, double d, double e, double least) {
  const double A = a - c, B = b - c, D = d - c, E = e - c;
  const double a2 = mul_add(-2, B, A), b2 = B + D, c2 = mul_add(-2, D, E);
  const double a1 = mul_add(-4, B, A), b1 = B - D, c1 = mul_add(-4, D, E);
  const double s0 = mul_add(13.0 / 12 * a2, a2, mul_add(0.25 * a1, a1, least));
  const double s1 = mul_add(13.0 / 12 * b2, b2, mul_add(0.25 * b1, b1, least));
  const double s2 = mul_add(13.0 / 12 * c2, c2, mul_add(0.25 * c1, c1, least));
  const double t = (s0 - s2) * (s0 - s2);
  const double q0 = s0 * s0, q1 = s1 * s1, q2 = s2 * s2;
  const double w0 = (q0 + t) * (q1 * q2), w1 = 6 * ((q1 + t) * (q0 * q2)), w2 = (q2 + t) * (q0 * q1);
  const auto towards = [&](double far, double near, double x2, double x1, double y1, double y2) {
    const double far_value = mul_add(-7, x1, 2 * x2), middle_value = mul_add(2, y1, -x1),
                 near_value = mul_add(5, y1, -y2);
    const double sum = mul_add(3 * near, near_value, mul_add(w1, middle_value, far * far_value));
    return sum / (6 * (mul_add(3, near, far) + w1));
  };
  return {c + towards(w2, w0, E, D, B, A), c + towards(w0, w2, A, B, D, E)};
}

/// The argument nearer to zero, where both have one sign; else 0.
[[gnu::always_inline]] inline double nearer_zero(double a, double b) {
  const double size_a = a < 0 ? -a : a, size_b = b < 0 ? -b : b;
  return a * b > 0 ? (size_a < size_b ? a : b) : 0;
}

/// The value of the middle one of five cells at the face towards d, less its mean, by the linear weights of
/// fifth order. A, B, D, E are the means of the others less that of the middle one.
[[gnu::always_inline]] inline double linear_towards(double A, double B, double D, double E) {
  return (mul_add(2, A, -13 * B) + mul_add(27, D, -3 * E)) * (1.0 / 60);
}
/// Whether MP5 looks further than the linear value (Suresh & Huynh, eq. 2.12).
[[gnu::always_inline]] inline bool needs_bounds(double linear, double B, double D, double least) {
  return !(linear * (linear - nearer_zero(D, -4 * B)) <= least);
}

/// The same within the bounds of MP5 (Suresh & Huynh, J. Comput. Phys. 136 (1997) 83, eqs. 2.1 and 2.12 to
/// 2.30 with alpha = 4).
[[gnu::always_inline]] inline double mp5_towards(double A, double B, double D, double E, double least) {
  const double linear = linear_towards(A, B, D, E);
  const double bend_low = mul_add(-2, B, A), bend = B + D, bend_high = mul_add(-2, D, E);
  const double above = nearer_zero(nearer_zero(mul_add(4, bend, -bend_high), mul_add(4, bend_high, -bend)),
                                   nearer_zero(bend, bend_high)),
               below = nearer_zero(nearer_zero(mul_add(4, bend, -bend_low), mul_add(4, bend_low, -bend)),
                                   nearer_zero(bend, bend_low));
  const double median = 0.5 * (D - above), steepest = -4 * B, curved = mul_add(4.0 / 3, below, -0.5 * B);
  const auto smaller = [](double a, double b) { return a < b ? a : b; };
  const auto larger = [](double a, double b) { return a > b ? a : b; };
  const double low = larger(smaller(smaller(0, D), median), smaller(smaller(0, steepest), curved)),
               high = smaller(larger(larger(0, D), median), larger(larger(0, steepest), curved));
  const double bounded = linear + nearer_zero(low - linear, high - linear);
  return needs_bounds(linear, B, D, least) ? bounded : linear;
}

/// MP5 in the place of weno5z(): the linear weights of fifth order wherever the five means are smooth, a
/// smooth extremum among them included, so that steep smooth data lose less; behind shocks it rings more.
[[gnu::always_inline]] inline Ends mp5(double a, double b, double c, double d, double e, double least) {
  const double A = a - c, B = b - c, D = d - c, E = e - c;
  return {c + mp5_towards(E, D, B, A, least), c + mp5_towards(A, B, D, E, least)};
}

/// The linear values alone, to which mp5() comes where neither needs bounds. @param rough out: 1 if one does.
[[gnu::always_inline]] inline Ends linear5(double a, double b, double c, double d, double e, double least,
                                           double& rough) {
  const double A = a - c, B = b - c, D = d - c, E = e - c;
  const double low = linear_towards(E, D, B, A), high = linear_towards(A, B, D, E);
  rough = needs_bounds(low, D, B, least) | needs_bounds(high, B, D, least) ? 1.0 : 0.0;
  return {c + low, c + high};
}

}  // namespace recoil
