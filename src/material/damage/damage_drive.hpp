#pragma once

#include <array>
#include <cstddef>

#include "material/damage/damage_point.hpp"

namespace recoil {

/// What is averaged of a DamagePoint: its components in Field::damage_drive, and the first of them, how full
/// the cell is.
struct DamageDrive {
  enum : int { fullness, principal, pressure, equivalent, strain_growth, temperature, components };
  using Values = std::array<double, static_cast<std::size_t>(components)>;

  static Values of(const DamagePoint& p, double full) {
    return {full, p.principal, p.pressure, p.equivalent, p.strain_growth, p.temperature};
  }
  /// @param v the sums of weights, and of what they weigh.
  static DamagePoint mean(const Values& v, double damage, double dt) {
    const double total = v[fullness];
    return {.damage = damage,
            .principal = v[principal] / total,
            .pressure = v[pressure] / total,
            .equivalent = v[equivalent] / total,
            .strain_growth = v[strain_growth] / total,
            .temperature = v[temperature] / total,
            .dt = dt};
  }
};

}  // namespace recoil
