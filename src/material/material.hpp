#pragma once

#include <array>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "material/damage/damage.hpp"
#include "material/damage/damage_average.hpp"
#include "material/eos/eos.hpp"
#include "material/strength/strength.hpp"
#include "material/temperature.hpp"

namespace recoil {

/// What the models do not use, but checks do. NaN where not given.
struct Facts {
  double molar_mass = unset;      // kg/mol, mean of the atoms
  double poisson_ratio = unset;   // as a handbook says it
  double spall_strength = unset;  // Pa, the tension at which it was measured to break

  static constexpr auto parameters() {
    using P = Parameter<Facts>;
    return std::array{
        P{"molar-mass", "kg/mol", &Facts::molar_mass, 1e-3, 0.3, "mean molar mass of the atoms"},
        P{"poisson-ratio", "1", &Facts::poisson_ratio, -1, 0.5, "Poisson's ratio"},
        P{"spall-strength", "Pa", &Facts::spall_strength, 1e5, 1e12,
          "tension at which plate impact breaks it; the verdict goes by it"}};
  }
};

/// What failed matter still bears: no tension, and under pressure a von Mises stress of at most
/// yield + friction p, nor more than it did before.
struct FailedMatter {
  double yield = 0;     // Pa
  double friction = 0;  // 1

  static constexpr auto parameters() {
    using P = Parameter<FailedMatter>;
    return std::array{
        P{"yield", "Pa", &FailedMatter::yield, 0, 1e13, "yield stress of failed matter"},
        P{"friction", "1", &FailedMatter::friction, 0, 10, "growth of that yield stress with the pressure"}};
  }

  double limit(double pressure) const { return yield + friction * (pressure > 0 ? pressure : 0); }
};

/// What one kind of matter does at a point.
struct Material {
  std::string name;               // "copper/seed", or the NAME of a case's [material.NAME]
  std::string title;              // one line for people
  std::vector<std::string> cite;  // sources: keys of the bibliography
  Eos eos;
  Strength strength;
  Damage damage;
  DamageAverage damage_average;
  FailedMatter failed;
  Thermal thermal;
  Melting melting;
  Facts facts;
  std::string doubt;  // what its constants may be wrong in; empty: no doubt is known
};

/// Temperature, and how much is molten.
inline TemperatureLaw temperature_law(const Material& m) { return {m.thermal, m.eos, m.melting}; }

/// Density at rest [kg/m3].
inline double density(const Material& m) { return density(m.eos); }

/// Density without pressure and without pores [kg/m3].
inline double solid_density(const Material& m) {
  const auto* porous = std::get_if<Porous>(&m.eos);
  return porous ? porous->rho0_solid : density(m);
}

/// Shear modulus [Pa]; 0 for a fluid.
inline double shear_modulus(const Material& m) { return shear_modulus(m.strength); }

/// Whether damage comes from the mean of the states around.
inline bool averages_damage(const Material& m) { return can_fail(m.damage) && m.damage_average.averages(); }

/// Bulk sound speed at rest [m/s].
inline double bulk_sound_speed(const Material& m) { return bulk_sound_speed(m.eos); }

/// Speed of longitudinal waves at rest [m/s]: c_L^2 = c0^2 + 4 G/(3 rho0).
inline double longitudinal_speed(const Material& m) {
  const double c = bulk_sound_speed(m);
  return std::sqrt(c * c + 4 * shear_modulus(m) / (3 * density(m)));
}

}  // namespace recoil
