#pragma once

#include <array>

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
};

}  // namespace recoil
