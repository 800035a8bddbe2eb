#include "material/tabulate.hpp"

#include <algorithm>
#include <cmath>

#include "material/temperature.hpp"

namespace recoil {

RawEosTable tabulate(const Material& m, const TableExtent& extent) {
  const TemperatureLaw law = temperature_law(m);
  const double rho0 = density(m);
  RawEosTable table;
  const double most = std::min(extent.most, 0.999 * largest_density(m.eos) / rho0);
  const int below =
      static_cast<int>(std::lround((1 - extent.least) / (most - extent.least) * (extent.densities - 1)));
  for (int i = 0; i < extent.densities; ++i)
    table.density.push_back(rho0 * (i < below
                                        ? extent.least + (1 - extent.least) * i / below
                                        : 1 + (most - 1) * (i - below) / (extent.densities - 1 - below)));
  const double ratio = extent.hottest / extent.coldest;
  for (int j = 0; j < extent.temperatures; ++j)
    table.temperature.push_back(extent.coldest *
                                std::pow(ratio, static_cast<double>(j) / (extent.temperatures - 1)));
  for (const double rho : table.density)
    for (const double t : table.temperature) {
      const double e = law.energy_at(rho, t);
      table.energy.push_back(e);
      table.pressure.push_back(pressure(m.eos, rho, e));
    }
  return table;
}

}  // namespace recoil
