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

}  // namespace recoil
