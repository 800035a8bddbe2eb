#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/vec.hpp"

namespace recoil {

/// A detonation that runs through an explosive as prescribed, whatever the matter does: from lighting points
/// in all directions, or as a plane, with the measured velocity (programmed burn: Wilkins, Computer
/// Simulation of Dynamic Phenomena, 1999). Contents hold the part that has detonated in the place of the
/// plastic strain, which a fluid has no use for.
template <int Dim>
struct DetonationFront {
  std::vector<Vec<Dim>> points;  // m, where it is lit
  Vec<Dim> direction;            // of a plane front through the first point; 0: spherical fronts
  double time = 0;               // s, of lighting
  double velocity = 0;           // m/s
  double energy = 0;             // J/kg that the explosive sets free
  Vec<Dim> period;               // m, of the domain; 0: none
  Vec<Dim> middle;               // m, of the explosive, where it does not reach across the period
  Vec<Dim> across;               // 1 along axes where it does: the front runs both ways around

  /// When the front reaches x [s].
  double arrival(const Vec<Dim>& x) const {
    if (dot(direction, direction) > 0) return time + std::abs(dot(way(points[0], x), direction)) / velocity;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec<Dim>& p : points) nearest = std::min(nearest, norm(way(p, x)));
    return time + nearest / velocity;
  }

 private:
  /// From a lighting point to x [m]: both as they lie in the explosive, of which a part may have come in
  /// again across a periodic edge.
  Vec<Dim> way(const Vec<Dim>& from, const Vec<Dim>& x) const {
    Vec<Dim> w = x - from;
    for (int d = 0; d < Dim; ++d) {
      if (period[d] == 0) continue;
      w[d] = across[d] != 0 ? std::remainder(w[d], period[d])
                            : std::remainder(x[d] - middle[d], period[d]) -
                                  std::remainder(from[d] - middle[d], period[d]);
    }
    return w;
  }
};

/// Over how many cells the front sets its energy free.
inline constexpr double front_cells = 3;

}  // namespace recoil
