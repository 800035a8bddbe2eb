#include "material/eos/isentrope.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace recoil {

std::optional<IsentropePoint> gas_isentrope(const Eos& eos, double rho, double p, double to) {
  const auto* gas = std::get_if<IdealGas>(&eos);
  if (!gas || gas->p_inf != 0 || !(rho > 0 && p + gas->p0 > 0)) return std::nullopt;
  const double whole = p + gas->p0, c = std::sqrt(gas->gamma * whole / rho);
  const double wanted = to + gas->p0 > 0 ? std::pow((to + gas->p0) / whole, 1 / gas->gamma) : 0.0;
  const double part = std::clamp(wanted, 1 / most_expansion, most_expansion);
  const double exponent = 0.5 * (gas->gamma - 1);
  const bool reached = part == wanted;
  return IsentropePoint{part * rho, reached ? to : whole * std::pow(part, gas->gamma) - gas->p0,
                        c / exponent * (1 - std::pow(part, exponent)), reached};
}

}  // namespace recoil
