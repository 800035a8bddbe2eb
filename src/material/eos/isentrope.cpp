#include "material/eos/isentrope.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

namespace recoil {

bool is_gas(const Eos& eos) {
  const auto* gas = std::get_if<IdealGas>(&eos);
  return gas ? gas->p_inf == 0 : std::holds_alternative<Jwl>(eos);
}

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

IsentropePoint follow_isentrope(const Eos& eos, double rho, double p, double crushed, double to) {
  constexpr double step = 0.02;  // of ln(rho)
  return std::visit(
      [&]<class Model>(const Model& model) {
        const bool into_nothing = std::is_same_v<Model, Jwl> && to <= 0;
        const auto& matter = frozen(model, crushed);
        const double least = least_wall_sound_squared(matter);
        const auto modulus = [&](double density, double pressure) {
          return density * std::max(matter.sound_speed_squared(density, pressure), least);
        };
        double left = to - p, now = p, density = rho, change = 0;
        for (bool last = false; !last;) {
          const double here = modulus(density, now);
          last = std::abs(left) <= step * here;
          const double dp = last ? left : std::copysign(step * here, left);
          const double half = density * std::exp(0.5 * dp / here);
          const double by = dp / modulus(half, now + 0.5 * dp);
          if (!(std::abs(change + by) <= most_change))  // or not a number
            return IsentropePoint{rho * std::exp(std::copysign(most_change, left)), to, 0, into_nothing};
          change += by;
          density = rho * std::exp(change);
          now += dp, left -= dp;
        }
        return IsentropePoint{density, to, 0, true};
      },
      eos);
}

}  // namespace recoil
