#pragma once

#include <cmath>

namespace recoil {

/// The root of a rising function in [lo, hi] by the Illinois variant of false position.
template <class F>
double rising_root(const F& f, double lo, double hi) {
  double flo = f(lo), fhi = f(hi);
  double x = lo;
  int kept = 0;
  for (int i = 0; i < 200 && hi - lo > 1e-15 * std::fabs(hi); ++i) {
    x = fhi > flo ? (lo * fhi - hi * flo) / (fhi - flo) : 0.5 * (lo + hi);
    if (!(x > lo && x < hi)) x = 0.5 * (lo + hi);
    const double fx = f(x);
    if (fx == 0) break;
    if (fx > 0) {
      hi = x, fhi = fx;
      if (kept == 1) flo *= 0.5;
      kept = 1;
    } else {
      lo = x, flo = fx;
      if (kept == -1) fhi *= 0.5;
      kept = -1;
    }
  }
  return x;
}

}  // namespace recoil
