#pragma once

#include <variant>

#include "material/eos/eos.hpp"
#include "material/temperature.hpp"

namespace recoil {

/// A temperature [K] that the one of a state is not above, without a power or a table, for loops over cells:
/// exp(x) <= 1/(1 - x) for x < 1, and no state of the isentrope has less energy than rest. Infinite where
/// nothing is known.
class HighestTemperature {
 public:
  HighestTemperature(const Thermal& thermal, const Eos& eos) : initial_(thermal.initial_temperature) {
    if (thermal.rule == Thermal::Rule::plastic_work) {
      by_heat_ = 1;
      return;
    }
    per_energy_ = 1 / thermal.specific_heat;
    if (const auto* m = std::get_if<MieGruneisen>(&eos)) {
      gamma0_ = m->gamma0;
      rho0_ = m->rho0;
      lowest_ = MieGruneisen::straight_to * rho0_;
    } else if (!std::holds_alternative<LinearEos>(eos)) {
      initial_ = infinite;
    }
  }

  /// Arguments of TemperatureLaw.
  [[gnu::always_inline]] double operator()(double rho, double e, double heat) const {
    const double x = gamma0_ * (1 - rho0_ / (rho > lowest_ ? rho : lowest_));
    double most = initial_ / (1 - x) + e * per_energy_ + heat * by_heat_;
    if (!(x < 1)) most = infinite;
    return most;
  }

 private:
  double initial_, per_energy_ = 0, by_heat_ = 0;  // K; kg K/J; 1 where plastic work alone heats
  double gamma0_ = 0, rho0_ = 1;  // of Mie and Grueneisen; gamma0 = 0: the isentrope stays at T0
  double lowest_ = 0;             // kg/m3, where its closed form ends; below it the isentrope is colder
};

}  // namespace recoil
