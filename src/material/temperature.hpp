#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <variant>
#include <vector>

#include "material/eos/eos.hpp"
#include "material/melting.hpp"
#include "material/parameter.hpp"

namespace recoil {

/// How the temperature is found. energy: from density and internal energy, see TemperatureLaw; all plastic
/// work heats. plastic_work: T = T0 + temperature rise, a state variable [K] that grows by plastic_heating();
/// compression and shocks do not heat.
struct Thermal {
  enum class Rule { plastic_work, energy };
  Rule rule = Rule::energy;
  double specific_heat = unset;      // J/(kg K)
  double initial_temperature = 298;  // K, T0
  double taylor_quinney = 1;         // part of the plastic work that heats

  static constexpr auto parameters() {
    using P = Parameter<Thermal>;
    return std::array{
        P{"specific-heat", "J/(kg K)", &Thermal::specific_heat, 1, 2e4, "specific heat"},
        P{"initial-temperature", "K", &Thermal::initial_temperature, 1, 1e4, "temperature at the start"},
        P{"taylor-quinney", "1", &Thermal::taylor_quinney, 0, 1,
          "part of the plastic work that heats; 1 with temperature = \"energy\""}};
  }
};

/// Rise of temperature [K] of a plastic increment dep at the yield stress [Pa] it ends on:
/// rho c dT = chi yield dep.
inline double plastic_heating(const Thermal& thermal, double yield, double dep, double rho) {
  return thermal.taylor_quinney * yield * dep / (rho * thermal.specific_heat);
}

/// Energy of elastic distortion, S:S/(4 G rho) [J/kg], of the equivalent stress squared [Pa2]. It is part of
/// the internal energy, but no heat. 0 for a fluid.
inline double distortion_energy(double equivalent_stress_squared, double shear_modulus, double rho) {
  return shear_modulus > 0 ? equivalent_stress_squared / (6 * shear_modulus * rho) : 0.0;
}

/// The temperature of one material, with the isentrope through the state at rest tabulated once. e: specific
/// internal energy without that of elastic distortion [J/kg].
///   energy rule: T = T_s(rho) + (e - e_s(rho))/c_v,  d ln T_s/d rho = Gamma/rho,  d e_s/d rho = p/rho^2
///   Mie-Grueneisen: T_s = T0 exp(Gamma0 (1 - rho0/rho)); linear: T_s = T0; ideal gas: T_s = T0 x^(gamma -
///   1), x = rho/rho0, and e_s = P_inf/rho0 ((x^(gamma - 1) - 1)/(gamma - 1) + 1/x - 1); the others:
///   tabulated as e_s
/// A tabular equation of state has the temperature itself: T(rho, e) of its table, on the isentrope as well.
/// Exact for a constant c_v where Gamma depends on density alone: for all but Tillotson's, whose Gamma falls
/// with energy.
/// Matter that melts takes up its latent heat at T_m(rho): the molten part grows from 0 to 1 meanwhile, and
/// beyond it the temperature is lower by the latent heat over c_v. Pressure knows nothing of it.
class TemperatureLaw {
 public:
  TemperatureLaw() = default;
  TemperatureLaw(const Thermal& thermal, const Eos& eos, const Melting& melting = {});

  /// Temperature [K] at density rho [kg/m3], energy e and temperature rise by plastic work `heat` [K]; of
  /// porous matter with what it has lost of its distension in place of `heat`. All else is of the solid.
  double operator()(double rho, double e, double heat) const {
    return melts() ? melt(rho, e, heat).temperature : unmelted(rho, e, heat);
  }

  /// The same without latent heat.
  double unmelted(double rho, double e, double heat) const {
    return thermal_.rule == Thermal::Rule::plastic_work ? thermal_.initial_temperature + heat
                                                        : by_energy(solid_density(rho, heat), e);
  }

  /// Molten part and temperature.
  Melt melt(double rho, double e, double heat) const {
    return melted(solid_density(rho, heat), unmelted(rho, e, heat));
  }
  /// Of solid density rho and a temperature without latent heat [K].
  Melt melted(double rho, double unmelted) const {
    return melts() ? recoil::melt(unmelted, melting_at(rho), melting_.heat / thermal_.specific_heat)
                   : Melt{0, unmelted, infinite, unmelted};
  }
  bool melts() const { return melting_at_rest_ < infinite; }

  /// Melting temperature [K] at a solid density [kg/m3]; infinite: it does not melt. By Lindemann's law with
  /// the Grueneisen coefficient of the isentrope, d ln T_s/d ln rho = Gamma, it is T_m0 (T_s/T0)^2 x^(-2/3);
  /// constant where that coefficient is zero.
  double melting_at(double rho) const {
    if (!melts()) return infinite;
    const double x = rho / rho0_;
    if (melting_.has_own_curve()) return melting_at_rest_ * melting_.growth(x);
    if (!follows_isentrope()) return melting_at_rest_;
    const double growth = on_isentrope(rho) / on_isentrope(rho0_), root = std::cbrt(x);
    return melting_at_rest_ * growth * growth / (root * root);
  }

  /// A temperature [K] that matter of at least `least_melting_part` of its density at rest does not melt
  /// below.
  double least_melting() const { return least_melting_; }
  static constexpr double least_melting_part = 0.9;

  /// Energy e [J/kg] of a temperature [K] at a solid density; at the melting temperature that of the solid.
  double energy_at(double rho, double temperature) const {
    if (own_) return own_->energy_at(rho, temperature);
    return solid_energy_at(rho, temperature) + (temperature > melting_at(rho) ? melting_.heat : 0.0);
  }

  /// Density of the solid [kg/m3] of porous matter that has lost `crushed` of its distension; of other matter
  /// its own.
  double solid_density(double rho, double crushed) const {
    return has_pores() ? rho * std::clamp(distension_ - crushed, 1.0, distension_) : rho;
  }
  bool has_pores() const { return distension_ > 0; }

  /// That of the energy rule, whichever rule the material has, without latent heat.
  double by_energy(double rho, double e) const {
    if (own_) return own_->temperature(rho, e);
    return on_isentrope(rho) + (e - isentrope(rho)) / thermal_.specific_heat;
  }

  /// Temperature [K] on the isentrope through rest.
  double on_isentrope(double rho) const {
    if (own_) return own_->temperature(rho, isentrope(rho));
    if (gas_power_ > 0) return thermal_.initial_temperature * std::pow(rho / rho0_, gas_power_);
    if (!growth_.empty() && rho < closed_from_)
      return thermal_.initial_temperature * std::exp(interpolated(growth_, rho));
    return thermal_.initial_temperature * std::exp(gamma0_ * (1 - rho0_ / rho));
  }

  /// e_s [J/kg] on the isentrope through rest: where it is a table, linear between its points, and beyond it.
  double isentrope(double rho) const {
    if (gas_power_ == 0) return interpolated(table_, rho);
    const double x = rho / rho0_;
    return gas_energy_ * ((std::pow(x, gas_power_) - 1) / gas_power_ + 1 / x - 1);
  }

  const Thermal& thermal() const { return thermal_; }

 private:
  /// Whether the temperature of the isentrope depends on density.
  bool follows_isentrope() const { return own_ || gas_power_ > 0 || !growth_.empty() || gamma0_ > 0; }

  double solid_energy_at(double rho, double temperature) const {
    if (own_) return own_->energy_at(rho, temperature);
    return isentrope(rho) + thermal_.specific_heat * (temperature - on_isentrope(rho));
  }

  double interpolated(const std::vector<double>& values, double rho) const {
    const double x = (rho - lowest_) / spacing_;
    const double last = static_cast<double>(values.size()) - 2;
    const double k = std::clamp(std::floor(x), 0.0, last);
    const auto i = static_cast<std::size_t>(k);
    return values[i] + (x - k) * (values[i + 1] - values[i]);
  }

  // How the tables are made; in temperature.cpp, the only place that calls them.
  template <class Model>
  void tabulate(const Model& eos);
  void tabulate(const MieGruneisen& eos);
  void tabulate(const IdealGas& eos);
  void tabulate(const LinearEos& eos);
  void tabulate(const PolynomialEos& eos);
  void tabulate(const Porous& eos);
  void tabulate(const Tabular& eos);
  template <class Model>
  void fill(const Model& eos);
  template <class Model>
  void tabulate_growth(const Model& eos);
  template <class Model>
  void advance(const Model& eos, int k, int direction);
  template <class Model>
  void find_melting_at_rest(const Model& eos);
  void find_melting_at_rest(const Porous& eos);
  template <class Model>
  double density_without_pressure(const Model& eos) const;
  void find_least_melting(double last);

  Thermal thermal_;
  Melting melting_;
  double melting_at_rest_ = infinite;      // K, at rest density
  double least_melting_ = infinite;        // K
  double rho0_ = 1, gamma0_ = 0;           // kg/m3, 1
  double gas_power_ = 0, gas_energy_ = 0;  // of an ideal gas: gamma - 1, P_inf/rho0 [J/kg]
  double distension_ = 0;                  // of porous matter at rest; 0: of other
  double lowest_ = 0, spacing_ = 1;        // kg/m3
  int rest_ = 0;                           // place of rest in the table
  std::vector<double> table_{0.0, 0.0};    // J/kg
  std::vector<double> growth_;             // ln(T_s/T0) ...
  double closed_from_ = 0;                 // kg/m3; ... below this density; from there on by gamma0_
  std::shared_ptr<const EosTable> own_;    // a table that has the temperature; null: none
};

}  // namespace recoil
