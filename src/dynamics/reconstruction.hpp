#pragma once

#include <cmath>

namespace recoil {

/// WENO5-Z (Borges et al. 2008): the value at the face between c and d, seen from c; a and b lie behind, e
/// beyond. Written as c plus a correction, so that a constant stays constant to the last bit, and with the
/// smoothness ratios multiplied out, so that there is one division. `least` sets the scale below which data
/// count as smooth.
[[gnu::always_inline]] inline double weno5z(double a, double b, double c, double d, double e, double least) {
  const double a2 = a - 2 * b + c, b2 = b - 2 * c + d, c2 = c - 2 * d + e;
  const double a1 = a - 4 * b + 3 * c, b1 = b - d, c1 = 3 * c - 4 * d + e;
  const double s0 = 13.0 / 12 * a2 * a2 + 0.25 * a1 * a1 + least;
  const double s1 = 13.0 / 12 * b2 * b2 + 0.25 * b1 * b1 + least;
  const double s2 = 13.0 / 12 * c2 * c2 + 0.25 * c1 * c1 + least;
  const double t = (s0 - s2) * (s0 - s2);
  const double q0 = s0 * s0, q1 = s1 * s1, q2 = s2 * s2;
  const double w0 = (q0 + t) * q1 * q2, w1 = 6 * (q1 + t) * q0 * q2, w2 = 3 * (q2 + t) * q0 * q1;
  const double right = d - c;
  return c + (w0 * (2 * (a - c) - 7 * (b - c)) + w1 * (2 * right - (b - c)) + w2 * (5 * right - (e - c))) /
                 (6 * (w0 + w1 + w2));
}

}  // namespace recoil
