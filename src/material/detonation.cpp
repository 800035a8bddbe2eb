#include "material/detonation.hpp"

#include <cmath>

namespace recoil {

ChapmanJouguet chapman_jouguet(const Jwl& products) {
  const double rho0 = products.rho0, start = products.detonated_energy();
  const auto state = [&](double compression) {
    ChapmanJouguet s;
    s.density = rho0 * compression;
    const double dv = 1 / rho0 - 1 / s.density;
    const double p = products.pressure(s.density, start), slope = products.omega * s.density;
    s.pressure = p / (1 - 0.5 * slope * dv);
    s.velocity = std::sqrt(s.pressure / dv) / rho0;
    s.particle = std::sqrt(s.pressure * dv);
    return s;
  };
  const double ratio = 0.5 * (std::sqrt(5.0) - 1);  // golden section
  double low = 1.01, high = 2.2;
  while (high - low > 1e-9) {
    const double a = high - ratio * (high - low), b = low + ratio * (high - low);
    (state(a).velocity < state(b).velocity ? high : low) = state(a).velocity < state(b).velocity ? b : a;
  }
  return state(0.5 * (low + high));
}

}  // namespace recoil
