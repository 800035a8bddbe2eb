#pragma once

#include <utility>
#include <variant>

#include "material/eos/density_range.hpp"
#include "material/eos/frozen.hpp"
#include "material/eos/ideal_gas.hpp"
#include "material/eos/jwl.hpp"
#include "material/eos/linear.hpp"
#include "material/eos/mie_gruneisen.hpp"
#include "material/eos/mie_gruneisen_cubic.hpp"
#include "material/eos/polynomial.hpp"
#include "material/eos/porous.hpp"
#include "material/eos/tabular.hpp"
#include "material/eos/tillotson.hpp"

namespace recoil {

/// Every equation of state, in the order that help and schema show. Adding one: a header beside
/// these, its name here; the generic tests then cover it.
using Eos = std::variant<MieGruneisen, LinearEos, MieGruneisenCubic, Tillotson, IdealGas, Jwl, PolynomialEos,
                         Tabular, Porous>;

/// Density at rest [kg/m3].
inline double density(const Eos& eos) {
  return std::visit([](const auto& model) { return model.rho0; }, eos);
}

/// Bulk sound speed at rest [m/s].
inline double bulk_sound_speed(const Eos& eos) {
  return std::visit([](const auto& model) { return bulk_sound_speed(model); }, eos);
}

/// Pressure [Pa] at density rho [kg/m3] and specific internal energy e [J/kg], 0 at rest. For single states:
/// loops over cells visit once.
/// @param crushed of porous matter: how much of its distension it has lost (Components::crushed), here and
/// below.
inline double pressure(const Eos& eos, double rho, double e, double crushed = 0) {
  return std::visit([=](const auto& model) { return frozen(model, crushed).pressure(rho, e); }, eos);
}

/// Specific internal energy [J/kg] at density rho and pressure p [Pa].
inline double energy(const Eos& eos, double rho, double p, double crushed = 0) {
  return std::visit([=](const auto& model) { return frozen(model, crushed).energy(rho, p); }, eos);
}

/// (dp/drho) at constant entropy [m2/s2].
inline double sound_speed_squared(const Eos& eos, double rho, double p, double crushed = 0) {
  return std::visit([=](const auto& model) { return frozen(model, crushed).sound_speed_squared(rho, p); },
                    eos);
}

/// Density [kg/m3] without pressure and energy.
inline double rest_density(const Eos& eos, double crushed) {
  return std::visit([=](const auto& model) { return frozen(model, crushed).rho0; }, eos);
}

/// How much of its distension porous matter has lost that was at rest and is brought to rho and e by
/// compression alone; 0 of any other.
inline double crushed_by(const Eos& eos, double rho, double e) {
  const auto* porous = std::get_if<Porous>(&eos);
  return porous ? porous->crush(rho, e, 0) : 0.0;
}

/// The table of a tabular equation of state, its own or that of its solid; null: there is none.
inline const Tabular* tabular(const Eos& eos) {
  const auto* porous = std::get_if<Porous>(&eos);
  return porous ? std::get_if<Tabular>(&porous->solid) : std::get_if<Tabular>(&eos);
}
inline Tabular* tabular(Eos& eos) { return const_cast<Tabular*>(tabular(std::as_const(eos))); }

/// The largest admissible density [kg/m3].
inline double largest_density(const Eos& eos) {
  return std::visit([](const auto& model) { return model.largest_density(); }, eos);
}

/// Densities, of that at rest, within which states are taken as they are.
inline DensityRange density_range(const Eos& eos) {
  return std::visit([](const auto& model) { return density_range(model); }, eos);
}

/// Whether matter holds together under tension at all. A gas does not: what is below its pressure at rest is
/// no tension.
inline bool has_tension(const Eos& eos) {
  const auto* gas = std::get_if<IdealGas>(&eos);
  return gas == nullptr || gas->p_inf > 0;
}

/// Whether the pressure does not depend on the energy, or may not: then `extra` is kept.
inline bool barotropic(const Eos& eos) {
  return std::visit([](const auto& model) { return model.barotropic; }, eos);
}

/// Whether matter of this kind never has strength: gases.
template <class Model>
constexpr bool is_fluid() {
  if constexpr (requires { Model::fluid; })
    return Model::fluid;
  else
    return false;
}
inline bool is_fluid(const Eos& eos) {
  return std::visit([]<class Model>(const Model&) { return is_fluid<Model>(); }, eos);
}

/// Least c^2 at walls [m2/s2]: their velocity has the pressure over the impedance in it, and a gas that has
/// hardly any pressure left must not run away by the errors of both.
template <class Model>
double least_wall_sound_squared(const Model& eos) {
  const double c0 = bulk_sound_speed(eos);
  return 0.05 * c0 * c0;
}

/// Whether matter of this kind goes on expanding where a solid would have broken: gases, and what evaporates.
template <class Model>
bool evaporates(const Model& eos) {
  if constexpr (requires { eos.evaporates(); })
    return eos.evaporates();
  else
    return is_fluid<Model>();
}

/// The c^2 that waves run with [m2/s2]: of what evaporates at least p/rho, that of an isothermal gas. With
/// hardly any impedance it would be thrown out at many times the speed of sound (docs/decisions/0072).
template <class Model>
double wave_speed_squared(const Model& eos, double rho, double p) {
  const double c2 = eos.sound_speed_squared(rho, p), free = p * (1 / rho);
  return evaporates(eos) & (c2 < free) & (rho > 0) ? free : c2;
}

/// Least c^2 that wave speeds use [m2/s2]; states below are counted. In a vapour that expands the speed of
/// sound falls with it.
template <class Model>
double least_sound_squared(const Model& eos) {
  const double c0 = bulk_sound_speed(eos);
  return (evaporates(eos) ? 1e-6 : 0.05) * c0 * c0;
}
inline double least_sound_squared(const Eos& eos) {
  return std::visit([](const auto& model) { return least_sound_squared(model); }, eos);
}

}  // namespace recoil
