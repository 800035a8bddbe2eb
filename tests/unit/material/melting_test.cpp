#include "material/melting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "material/starting_state.hpp"
#include "samples.hpp"

namespace recoil::melting_test {
namespace {

constexpr double specific_heat = 383.5, heat = 208.7e3, melting_temperature_of_copper = 1357.77;

TemperatureLaw melting_law(const Eos& eos, const Melting& melting = {melting_temperature_of_copper, heat}) {
  Thermal thermal;
  thermal.specific_heat = specific_heat;
  return {thermal, eos, melting};
}

TEST(Melting, TakesUpItsHeatAtOneTemperature) {
  EXPECT_EQ(melt(900, 1000, 200).molten, 0);
  EXPECT_EQ(melt(900, 1000, 200).temperature, 900);
  EXPECT_EQ(melt(1000, 1000, 200).molten, 0);
  EXPECT_EQ(melt(1050, 1000, 200).molten, 0.25);
  EXPECT_EQ(melt(1050, 1000, 200).temperature, 1000);
  EXPECT_EQ(melt(1300, 1000, 200).molten, 1);
  EXPECT_EQ(melt(1300, 1000, 200).temperature, 1100);
  EXPECT_EQ(melt(1000, 1000, 0).molten, 1);
  EXPECT_EQ(melt(1300, infinite, 0).molten, 0);
}

TEST(Melting, MatterThatDoesNotMeltHasTheTemperatureOfItsEnergy) {
  const TemperatureLaw law = melting_law(MieGruneisen{8930, 3940, 1.49, 2.0}, {});
  EXPECT_FALSE(law.melts());
  EXPECT_EQ(law(9500, 3e6, 0), law.unmelted(9500, 3e6, 0));
  EXPECT_EQ(law.melt(9500, 3e6, 0).molten, 0);
}

/// The state that starts without pressure at the melting temperature is the one that begins to melt.
TEST(Melting, WithoutPressureItMeltsAtTheTemperatureGiven) {
  int hot = 0;
  samples::for_each<Eos>([&](const auto& eos) {
    if (is_fluid(eos) || !has_tension(Eos{eos})) return;
    Material m;
    m.name = eos.kind;
    m.eos = eos;
    m.thermal.specific_heat = specific_heat;
    m.melting = {800, 0};
    const TemperatureLaw law = temperature_law(m);
    const StartingState s = state_at_start(m, std::nullopt, 800, "plate");
    EXPECT_NEAR(law.melting_at(law.solid_density(s.density, 0)), 800, 0.5) << eos.kind;
    hot += s.density < 0.999 * density(m) ? 1 : 0;
  });
  EXPECT_GT(hot, 5);
}

/// d ln T_m/d ln rho = 2 (Gamma - 1/3), Gamma = dp/de/rho on the isentrope.
TEST(Melting, TheCurveIsLindemannsLaw) {
  for (const Eos& eos : {Eos{MieGruneisen{8930, 3940, 1.49, 2.0}}, Eos{samples::of(MieGruneisenCubic{})[2]},
                         Eos{samples::of(Tillotson{})[0]}}) {
    const TemperatureLaw law = melting_law(eos);
    for (const double x : {0.95, 1.1, 1.3, 1.6}) {
      const double rho = x * density(eos), h = 2e-3 * rho, e = law.isentrope(rho);
      const double slope =
          (std::log(law.melting_at(rho + h)) - std::log(law.melting_at(rho - h))) * rho / (2 * h);
      const double gamma = (pressure(eos, rho, e + 1e3) - pressure(eos, rho, e - 1e3)) / (2e3 * rho);
      EXPECT_NEAR(slope, 2 * (gamma - 1.0 / 3), 0.02) << x;
    }
  }
}

TEST(Melting, WithoutGrueneisensCoefficientTheCurveIsFlat) {
  const TemperatureLaw law = melting_law(LinearEos{8930, 130e9});
  EXPECT_EQ(law.melting_at(8930), melting_temperature_of_copper);
  EXPECT_EQ(law.melting_at(11000), melting_temperature_of_copper);
}

/// With a = gamma0 the constants are those of a Grueneisen coefficient that falls as 1/rho.
TEST(Melting, ConstantsOfItsOwnRule) {
  const Eos copper = MieGruneisen{8930, 3940, 1.49, 2.0};
  const TemperatureLaw by_eos = melting_law(copper),
                       own = melting_law(copper, {melting_temperature_of_copper, heat, 2.0, 2.0}),
                       steep = melting_law(copper, {melting_temperature_of_copper, heat, 1.5, 2.02});
  for (const double rho : {8500.0, 8930.0, 11000.0, 13000.0}) {
    EXPECT_NEAR(own.melting_at(rho) / by_eos.melting_at(rho), 1, 1e-9) << rho;
    EXPECT_NEAR(steep.melting_at(rho) / steep.melting_at(8930),
                std::exp(3 * (1 - 8930 / rho)) * std::pow(rho / 8930, 2 * (2.02 - 1.5 - 1.0 / 3)), 1e-9);
  }
}

TEST(Melting, EnergyAndTemperatureAreInverse) {
  const TemperatureLaw law = melting_law(MieGruneisen{8930, 3940, 1.49, 2.0});
  for (const double rho : {8600.0, 8930.0, 12000.0}) {
    const double at = law.melting_at(rho);
    for (const double t : {300.0, at - 1, at + 1, at + 900})
      EXPECT_NEAR(law(rho, law.energy_at(rho, t), 0), t, 1e-6) << rho << " " << t;
    const Melt half = law.melt(rho, law.energy_at(rho, at) + 0.5 * heat, 0);
    EXPECT_NEAR(half.molten, 0.5, 1e-9);
    EXPECT_EQ(half.temperature, at);
  }
}

TEST(Melting, NoStateMeltsBelowTheBound) {
  samples::for_each<Eos>([](const auto& eos) {
    if (is_fluid(eos)) return;
    const TemperatureLaw law = melting_law(eos);
    const double rest = law.solid_density(eos.rho0, 0);
    for (int i = 0; i < 200; ++i) {
      const double x = TemperatureLaw::least_melting_part + 0.004 * i;
      EXPECT_LE(law.least_melting(), law.melting_at(x * rest)) << eos.kind << " " << x;
    }
    EXPECT_GT(law.least_melting(), 300);
  });
}

}  // namespace
}  // namespace recoil::melting_test
