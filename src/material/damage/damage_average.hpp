#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "material/parameter.hpp"

namespace recoil {

/// Over what the state is averaged that damage grows by (Pijaudier-Cabot & Bazant, J. Eng. Mech. 113 (1987)
/// 1512): the cells of the body within a length R, weighted by how full they are and by the bell-shaped
///   (1 - r^2/R^2)^2
/// of Bazant & Ozbolt (J. Eng. Mech. 116 (1990) 2485).
struct DamageAverage {
  double length = 0;  // m, R; 0: a cell by its own state

  static constexpr int most_cells = 8;  // of R on each side: as far as blocks read around themselves

  static constexpr auto parameters() {
    using P = Parameter<DamageAverage>;
    return std::array{P{"length", "m", &DamageAverage::length, 0, 1,
                        "radius over which the state is averaged that damage grows by; 0: not at all"}};
  }

  bool averages() const { return length > 0; }
  /// Weight of what is at a distance [m].
  double weight(double distance) const {
    const double part = 1 - distance * distance / (length * length);
    return part > 0 ? part * part : 0.0;
  }
  /// The part of a cell's own tension that its damage grows by at least. At the tip of a crack tension falls
  /// with the square root of the distance (Irwin, J. Appl. Mech. 24 (1957) 361), so that of a cell is
  /// sqrt(2 R/dx) times that at R; more than that is no stress of the matter around, but a gap that the cell
  /// cannot show. 1 where nothing is averaged.
  /// @param dx width of the cell [m].
  double own_part(double dx) const { return averages() ? std::min(1.0, std::sqrt(0.5 * dx / length)) : 1.0; }
};

}  // namespace recoil
