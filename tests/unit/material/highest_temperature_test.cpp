#include "material/highest_temperature.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "samples.hpp"

namespace recoil::highest_temperature_test {
namespace {

Thermal thermal_by(Thermal::Rule rule) {
  Thermal thermal;
  thermal.rule = rule;
  thermal.specific_heat = 383.5;
  return thermal;
}

TEST(HighestTemperature, NoStateIsHotter) {
  int known = 0;
  samples::for_each<Eos>([&](const auto& eos) {
    for (const auto rule : {Thermal::Rule::energy, Thermal::Rule::plastic_work}) {
      const TemperatureLaw law(thermal_by(rule), eos);
      const HighestTemperature highest(thermal_by(rule), eos);
      for (const double part : {0.7, 0.9, 0.99, 1.0, 1.01, 1.1, 1.3, 1.6, 2.2})
        for (const double e : {-1e4, 0.0, 1e3, 1e5, 1e6, 1e7})
          for (const double heat : {0.0, 0.3, 50.0}) {
            const double rho = part * eos.rho0, t = law(rho, e, heat), most = highest(rho, e, heat);
            EXPECT_GE(most, t - 1e-9 * std::abs(t)) << eos.kind << " " << part << " " << e;
            known += std::isfinite(most) ? 1 : 0;
          }
    }
  });
  EXPECT_GT(known, 500);
}

TEST(HighestTemperature, IsThatAtRest) {
  const Eos copper = MieGruneisen{8930, 3940, 1.49, 2.0};
  EXPECT_NEAR(HighestTemperature(thermal_by(Thermal::Rule::energy), copper)(8930, 0, 7), 298, 1e-9);
  EXPECT_NEAR(HighestTemperature(thermal_by(Thermal::Rule::plastic_work), copper)(9500, 1e5, 7), 305, 1e-9);
}

}  // namespace
}  // namespace recoil::highest_temperature_test
