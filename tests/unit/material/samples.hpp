#pragma once

#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include "material/material.hpp"

/// Instances of every model in the variant lists; a new model does not compile here until it has some.
namespace recoil::samples {

inline std::vector<MieGruneisen> of(const MieGruneisen&) {
  return {{8930, 3940, 1.49, 2.0},
          {2700, 5386, 1.339, 1.99},
          {17600, 4030, 1.24, 1.43},
          {7830, 3574, 1.92, 1.69}};
}
inline std::vector<LinearEos> of(const LinearEos&) { return {{8930, 130e9}, {1000, 2.2e9}}; }

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

inline std::vector<NoDamage> of(const NoDamage&) { return {{}}; }
inline std::vector<TensileDamage> of(const TensileDamage&) { return {{1e9, 1, 20e-9}, {1.5e9, 2, 50e-9}}; }
inline std::vector<JohnsonCookDamage> of(const JohnsonCookDamage&) {
  return {{0.05, 3.44, -2.12, 0.002, 0.61, 1793, 294}, {-0.77, 1.45, -0.47, 0, 1.6, 925, 294}};
}
inline std::vector<VoidGrowth> of(const VoidGrowth&) { return {{0.3e9, 0.04e9, 3e15, 1e-6, 0.3e9, 40}}; }
inline std::vector<MinimumPressure> of(const MinimumPressure&) { return {{1e9}}; }

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
