#pragma once

#include "material/eos/eos_table.hpp"
#include "material/material.hpp"

namespace recoil {

/// What a table made of a material holds.
struct TableExtent {
  double least = 0.6, most = 1.6;        // densities, of that at rest; rest is one of them
  int densities = 100;                   // at equal steps
  double coldest = 100, hottest = 5000;  // K
  int temperatures = 20;                 // at equal ratios
};

/// Tabulates the equation of state and the temperature of a material (that of its energy): for tests, and for
/// programs that read SESAME's tables. Densities beyond what the material admits are left out.
RawEosTable tabulate(const Material& material, const TableExtent& extent);

}  // namespace recoil
