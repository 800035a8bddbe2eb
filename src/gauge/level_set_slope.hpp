#pragma once

#include "state/body.hpp"

namespace recoil {

/// Slope of a body's level set at cell i of a window of halo 1, over `dx`: central differences, also across
/// the edges of blocks; one-sided at the edges of the domain.
template <int Dim>
Vec<Dim> level_set_slope(const Window<Dim>& window, const Body<Dim>& body, const Index<Dim>& i, double dx,
                         double far) {
  const auto phi = [&](const Index<Dim>& j, bool& inside) {
    const auto from = window.source_inside(j);
    inside = from.slot >= 0;
    return inside && body.present(from.slot) ? body.at(from.slot).phi[from.cell] : far;
  };
  Vec<Dim> slope;
  for (int d = 0; d < Dim; ++d) {
    Index<Dim> lo = i, hi = i;
    --lo[d], ++hi[d];
    bool has_low = false, has_high = false, here = false;
    const double own = phi(i, here), low = phi(lo, has_low), high = phi(hi, has_high);
    const int cells = (has_low ? 1 : 0) + (has_high ? 1 : 0);
    if (cells > 0) slope[d] = ((has_high ? high : own) - (has_low ? low : own)) / (cells * dx);
  }
  return slope;
}

}  // namespace recoil
