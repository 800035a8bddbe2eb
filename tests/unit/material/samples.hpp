#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "material/material.hpp"
#include "material/tabulate.hpp"

/// Instances of every model in the variant lists; a new model does not compile here until it has some.
namespace recoil::samples {

inline std::vector<MieGruneisen> of(const MieGruneisen&) {
  return {{8930, 3940, 1.49, 2.0},
          {2700, 5386, 1.339, 1.99},
          {17600, 4030, 1.24, 1.43},
          {7830, 3574, 1.92, 1.69}};
}
inline std::vector<LinearEos> of(const LinearEos&) { return {{8930, 130e9}, {1000, 2.2e9}}; }

inline std::vector<MieGruneisenCubic> of(const MieGruneisenCubic&) {
  return {{8930, 3940, 1.489, 0, 0, 2.02, .47},         {11340, 2006, 1.429, .8506, -1.64, 2.74, .54},
          {2703, 5240, 1.40, 0, 0, 1.97, .48},          {998, 1480, 2.56, -1.986, .2268, .5, 0},
          {8930, 3940, 1.489, 0, 0, 2.02, .47, 5.31e6}, {998, 1480, 2.56, -1.986, .2268, .5, 0, 2.44e6, .33}};
}
inline std::vector<Tillotson> of(const Tillotson&) {
  return {{2700, .5, 1.63, 75.2e9, 65e9, 5e6, 5, 5, 3e6, 13.9e6},
          {7800, .5, 1.5, 128e9, 105e9, 9.5e6, 5, 5, 2.4e6, 8.67e6}};
}
inline std::vector<IdealGas> of(const IdealGas&) {
  return {{1.2, 1.4, 101325}, {0.1664, 5.0 / 3, 101325}, {998, 4.4, 101325, 4.92e8}};
}
inline std::vector<Jwl> of(const Jwl&) { return {{1630, 371.2e9, 3.231e9, 4.15, .95, .30, 7e9, 6930}}; }
inline std::vector<PolynomialEos> of(const PolynomialEos&) {
  return {{3890, 231e9, -160e9, 2774e9}, {2510, 233e9, -593e9, 2800e9}};
}
inline Tabular tabulated(const Material& material, const TableExtent& extent) {
  Tabular table;
  std::string help;
  const std::string problem =
      table.take(tabulate(material, extent), material.thermal.initial_temperature, help);
  if (!problem.empty()) throw std::runtime_error(problem);
  return table;
}
inline std::vector<Tabular> of(const Tabular&) {
  Material m;
  m.thermal.specific_heat = 383.5;
  m.eos = MieGruneisen{8930, 3940, 1.49, 2.0};
  return {tabulated(m, {.least = 0.447, .most = 1.9, .densities = 301})};
}

inline Porous porous(const PorousSolid& solid, double rho0, double elastic_limit, double compaction,
                     double exponent = 2) {
  Porous model{rho0, elastic_limit, compaction, exponent, solid};
  if (const char* problem = model.settle()) throw std::runtime_error(problem);
  return model;
}
inline std::vector<Porous> of(const Porous&) {
  std::vector<Porous> list;
  const auto add = [&](const auto& solids) {
    for (const auto& solid : solids) list.push_back(porous(solid, solid.rho0 / 1.3, 0.1e9, 1.5e9));
  };
  add(of(MieGruneisen{}));
  add(of(MieGruneisenCubic{}));
  add(of(Tillotson{}));
  add(of(LinearEos{}));
  add(of(PolynomialEos{}));
  add(of(Tabular{}));
  return list;
}

inline std::vector<NoStrength> of(const NoStrength&) { return {{}}; }
inline std::vector<Elastic> of(const Elastic&) { return {{43e9}}; }
inline std::vector<PerfectlyPlastic> of(const PerfectlyPlastic&) { return {{27.6e9, 0.3e9}, {27.6e9, 0}}; }
inline std::vector<LinearHardening> of(const LinearHardening&) { return {{43.3e9, 0.4e9, 0.1e9}}; }
inline std::vector<JohnsonCook> of(const JohnsonCook&) {
  return {{43.33e9, 400e6, 177e6, 1.0, .025, 1.09, 1358},
          {124e9, 1510e6, 177e6, .12, .016, 1.0, 1777},
          {47.7e9, 90e6, 292e6, .31, .025, 1.09, 1356},
          {77.3e9, 1500e6, 569e6, .22, 0, 1.17, 1723},
          {26e9, 0, 114e6, .42, .002, 1.34, 925}};
}
inline std::vector<ZerilliArmstrong> of(const ZerilliArmstrong&) {
  return {{47.7e9, 65e6, 0, 890e6, .0028, .000115}, {81.8e9, 65e6, 1033e6, 0, .00698, .000415, 266e6, .289}};
}
inline std::vector<SteinbergGuinan> of(const SteinbergGuinan&) {
  return {{47.7e9, .12e9, .64e9, 36, .45, 28.3e-12, .377e-3, 1790, 1.5, 2.02},
          {27.6e9, .29e9, .68e9, 125, .10, 65.2e-12, .616e-3, 1220, 1.5, 1.97}};
}
inline std::vector<PrestonTonksWallace> of(const PrestonTonksWallace&) {
  return {{51.8e9, 8900, .063546, 1357, .025, 2, .0085, .00055, .11, 1e-5, .0001, .0001, .094, .575, .25},
          {72.2e9, 16600, .18095, 3290, .01, 0, .012, .00325, .6, 4e-5, .01, .00123, .012, .4, .23}};
}
inline std::vector<DruckerPrager> of(const DruckerPrager&) { return {{10e9, 1e6, .6}, {10e9, 0, 1.2}}; }
inline std::vector<Lundborg> of(const Lundborg&) { return {{25e9, 50e6, 1.5, 2e9}}; }
inline std::vector<JohnsonHolmquist> of(const JohnsonHolmquist&) {
  return {{90.16e9, .93, .6, .31, .6, 0, .2e9, 2.79e9, 1.46e9},
          {197e9, .927, .67, .70, .85, .005, .26e9, 19e9, 8.71e9, .2}};
}

inline std::vector<NoDamage> of(const NoDamage&) { return {{}}; }
inline std::vector<TensileDamage> of(const TensileDamage&) { return {{1e9, 1, 20e-9}, {1.5e9, 2, 50e-9}}; }
inline std::vector<JohnsonCookDamage> of(const JohnsonCookDamage&) {
  return {{0.05, 3.44, -2.12, 0.002, 0.61, 1793, 294},
          {-0.77, 1.45, -0.47, 0, 1.6, 925, 294},
          {0.0705, 1.732, -0.54, -0.015, 0, 0, 298, 5e-4, 1e-3, 0.3}};
}
inline std::vector<CockcroftLatham> of(const CockcroftLatham&) { return {{1516e6}, {400e6, 0.5}}; }
inline std::vector<VoidGrowth> of(const VoidGrowth&) { return {{0.3e9, 0.04e9, 3e15, 1e-6, 0.3e9, 40}}; }
inline std::vector<MinimumPressure> of(const MinimumPressure&) { return {{1e9}}; }
inline std::vector<JohnsonHolmquistDamage> of(const JohnsonHolmquistDamage&) {
  return {{.005, 1, .2e9, 1.46e9}, {.001, .5, .26e9, 8.71e9}};
}

/// Calls f(model) for every sample of every model in the list.
template <class Variant, class F>
void for_each(const F& f) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (
        [&] {
          for (const auto& model : of(std::variant_alternative_t<I, Variant>{})) f(model);
        }(),
        ...);
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>{});
}

/// Copper, aluminium as in the paper.
inline Material copper() {
  Material m;
  m.name = "copper";
  m.eos = MieGruneisen{8930, 3940, 1.49, 2.0};
  m.strength = JohnsonCook{43.33e9, 400e6, 177e6, 1.0, .025, 1.09, 1358};
  m.thermal.rule = Thermal::Rule::plastic_work;
  m.thermal.specific_heat = 383.5;
  m.facts.molar_mass = 0.063546;
  return m;
}
inline Material aluminium() {
  Material m;
  m.name = "aluminium";
  m.eos = MieGruneisen{2700, 5386, 1.339, 1.99};
  m.strength = JohnsonCook{26e9, 324e6, 114e6, .42, .002, 1.34, 925};
  m.thermal.rule = Thermal::Rule::plastic_work;
  m.thermal.specific_heat = 896;
  m.facts.molar_mass = 0.02698;
  return m;
}
inline Material hydro(Material m) {
  m.strength = NoStrength{};
  return m;
}

}  // namespace recoil::samples
