#pragma once

#include <cmath>

namespace recoil {

/// Third-order convex ENO (Liu & Osher 1998, J. Comput. Phys. 141): the value at the face between c and d
/// from means over five cells, seen from c; a and b lie behind, e beyond. Of the three parabolas through
/// three of the cells the one is taken whose value is nearest to that of the minmod line, provided that all
/// three lie on the same side of it; otherwise the line. Third order where the data are smooth and bend.
[[gnu::always_inline]] inline double convex_eno3(double a, double b, double c, double d, double e) {
  const double back = c - b, ahead = d - c;
  const double slope = back * ahead > 0 ? (std::fabs(back) < std::fabs(ahead) ? back : ahead) : 0;
  const double line = 0.5 * slope;  // from c on
  const double p0 = (2 * (a - c) - 7 * (b - c)) / 6 - line;
  const double p1 = (2 * ahead - (b - c)) / 6 - line;
  const double p2 = (5 * ahead - (e - c)) / 6 - line;
  const double least = std::fmin(std::fmin(p0, p1), p2), most = std::fmax(std::fmax(p0, p1), p2);
  return c + line + (least > 0 ? least : most < 0 ? most : 0);
}

}  // namespace recoil
