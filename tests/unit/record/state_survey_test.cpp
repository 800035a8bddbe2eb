#include "record/state_survey.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../cutcell/bodies.hpp"
#include "material/starting_state.hpp"

namespace recoil::state_survey_test {
namespace {

constexpr auto heat_component = static_cast<std::size_t>(Components<2>::temperature_rise);

Material copper_with(const Strength& strength, Thermal::Rule rule) {
  Material m = samples::copper();
  m.strength = strength;
  m.thermal.rule = rule;
  return m;
}

/// A domain full of matter at rest, `extra` J/kg warm, under the mean tension `tension` [Pa] where it is
/// cold.
State<2> full_of(const Material& m, double extra, double tension = 0) {
  auto state = make_test_state<2>(make_test_grid<2>(4, 4, Edge::outflow, true),
                                  {[](const Vec<2>&) { return -100.0; }}, m);
  cut_all(state);
  const auto& eos = std::get<MieGruneisen>(m.eos);
  const double rho = eos.rho0 - tension / (eos.c0 * eos.c0);
  Contents<2> q{};
  q[0] = rho;
  q[Components<2>::energy] = rho * extra;
  fill_body(state, 0, q);
  state.step = 20;
  return state;
}

BodyEvidence seen(const State<2>& state, const config::Limits& limits = {}, double closing_speed = 0) {
  StateSurvey<2> survey(state, limits, closing_speed);
  survey.look(state, nullptr);
  return survey.own_evidence(state, nullptr).at(0);
}

std::int64_t count(const BodyEvidence& e, StateCheck check) {
  return e.states[static_cast<std::size_t>(check)].count;
}

constexpr double hot = 500e3;  // J/kg: 1300 K above the start in copper

TEST(StateSurvey, AModelThatSoftensToldOfMeltingIsMolten) {
  const auto e = seen(full_of(copper_with(samples::copper().strength, Thermal::Rule::energy), hot));
  EXPECT_EQ(count(e, StateCheck::molten), static_cast<std::int64_t>(e.looked_at));
  EXPECT_EQ(count(e, StateCheck::melting), 0);
  EXPECT_TRUE(e.by_energy);
  const auto& found = e.states[static_cast<std::size_t>(StateCheck::molten)];
  EXPECT_NEAR(found.worst, 298 + hot / 383.5, 1e-6);
  EXPECT_EQ(found.bound, 1358);
}

TEST(StateSurvey, HeatOfShocksThatAModelDoesNotSeeIsMelting) {
  auto state = full_of(copper_with(samples::copper().strength, Thermal::Rule::plastic_work), hot);
  EXPECT_GT(count(seen(state), StateCheck::melting), 0);
  for (BodyBlock<2>& b : state.bodies[0].blocks) {
    const std::size_t n = b.volume.size();
    for (std::size_t k = 0; k < n; ++k) b.contents[heat_component * n + k] = 1200 * b.contents[k];
  }
  EXPECT_GT(count(seen(state), StateCheck::molten), 0) << "it does: its own temperature is 1498 K";
  EXPECT_EQ(count(seen(state), StateCheck::melting), 0);
}

TEST(StateSurvey, OtherModelsMeltWhereTheMaterialDoes) {
  Material m = copper_with(PerfectlyPlastic{43e9, 0.4e9}, Thermal::Rule::energy);
  EXPECT_EQ(count(seen(full_of(m, 1.5 * hot)), StateCheck::molten), 0) << "nobody knows";
  m.melting.temperature = 1358;
  EXPECT_EQ(count(seen(full_of(m, 1.5 * hot)), StateCheck::melting), 0);
  EXPECT_GT(count(seen(full_of(m, 1.5 * hot)), StateCheck::molten), 0);
  EXPECT_EQ(count(seen(full_of(m, 0.5 * hot)), StateCheck::molten), 0);
  m.thermal.rule = Thermal::Rule::plastic_work;
  EXPECT_GT(count(seen(full_of(m, 1.5 * hot)), StateCheck::melting), 0)
      << "which its own temperature does not show";
}

TEST(StateSurvey, MatterThatHasTakenUpPartOfItsLatentHeatIsMolten) {
  Material m = copper_with(PerfectlyPlastic{43e9, 0.4e9}, Thermal::Rule::energy);
  m.melting = {.temperature = 1358, .heat = 208.7e3};
  const double at = temperature_law(m).melting_at(density(m)), c = m.thermal.specific_heat;
  const BodyEvidence e = seen(full_of(m, (at - m.thermal.initial_temperature) * c + 100e3));
  const auto& found = e.states[static_cast<std::size_t>(StateCheck::molten)];
  EXPECT_GT(found.count, 0);
  EXPECT_NEAR(found.worst, at, 1e-6);
}

TEST(StateSurvey, MatterWithoutStrengthHasNoneToLose) {
  Material m = copper_with(NoStrength{}, Thermal::Rule::energy);
  m.melting.temperature = 1358;
  EXPECT_EQ(count(seen(full_of(m, 1.5 * hot)), StateCheck::melting), 0);
  EXPECT_GT(count(seen(full_of(m, 1.5 * hot)), StateCheck::molten), 0);
  EXPECT_EQ(count(seen(full_of(m, 0.5 * hot)), StateCheck::molten), 0);
}

TEST(StateSurvey, TensionIsHeldAgainstTheMaterialsOwnSpallStrength) {
  Material m = copper_with(Elastic{43e9}, Thermal::Rule::energy);
  const double bulk = 8930.0 * 3940 * 3940;  // Pa; bears 5 %, 6.9 GPa
  EXPECT_EQ(count(seen(full_of(m, 0, 0.045 * bulk)), StateCheck::tension), 0);
  EXPECT_GT(count(seen(full_of(m, 0, 0.055 * bulk)), StateCheck::tension), 0);
  m.facts.spall_strength = 1.5e9;
  EXPECT_EQ(count(seen(full_of(m, 0, 1.4e9)), StateCheck::tension), 0);
  EXPECT_GT(count(seen(full_of(m, 0, 1.6e9)), StateCheck::tension), 0);
  config::Limits limits;
  limits.spall_strength = 2;
  EXPECT_EQ(count(seen(full_of(m, 0, 2.9e9), limits), StateCheck::tension), 0);
  EXPECT_GT(count(seen(full_of(m, 0, 3.1e9), limits), StateCheck::tension), 0);
}

TEST(StateSurvey, ColderThanTheIsentropeIsCounted) {
  const Material m = copper_with(Elastic{43e9}, Thermal::Rule::energy);
  EXPECT_EQ(count(seen(full_of(m, 0)), StateCheck::negative_heat), 0);
  EXPECT_EQ(count(seen(full_of(m, -900)), StateCheck::negative_heat), 0) << "noise";
  EXPECT_GT(count(seen(full_of(m, -3e3)), StateCheck::negative_heat), 0);
}

TEST(StateSurvey, MatterThatStartsColdIsHeldAgainstItsOwnIsentrope) {
  const Material m = copper_with(Elastic{43e9}, Thermal::Rule::energy);
  const TemperatureLaw law = temperature_law(m);
  const StartingState start = state_at_start(m, 1e9, 150, "plate");
  const double ratio = over_isentrope(law, start);
  EXPECT_NEAR(ratio * law.on_isentrope(start.density), 150, 1e-9);
  EXPECT_EQ(over_isentrope(law, state_at_start(m, {}, {}, "plate")), 1);
  auto state = full_of(m, 0);
  Contents<2> q{};
  q[0] = start.density;
  q[Components<2>::energy] = start.density * start.energy;
  fill_body(state, 0, q);
  const auto cold = [&](const std::vector<double>& over) {
    StateSurvey<2> survey(state, {}, 0, over);
    survey.look(state, nullptr);
    return count(survey.own_evidence(state, nullptr).at(0), StateCheck::negative_heat);
  };
  EXPECT_GT(cold({}), 0);
  EXPECT_EQ(cold({ratio}), 0);
  EXPECT_GT(cold({1.1 * ratio}), 0);
}

TEST(StateSurvey, MissingHeatAndMatterWithoutRoomAreMeasured) {
  const Material m = copper_with(Elastic{43e9}, Thermal::Rule::energy);
  const auto amount = [](const BodyEvidence& e, StateCheck check) {
    return e.states[static_cast<std::size_t>(check)].amount;
  };
  const State<2> state_of_cold = full_of(m, -3e3);
  double mass = 0;  // kg
  for (const BodyBlock<2>& b : state_of_cold.bodies[0].blocks)
    for (std::size_t k = 0; k < b.volume.size(); ++k) mass += b.contents[k];
  const auto steps = static_cast<double>(state_of_cold.step);
  EXPECT_EQ(amount(seen(full_of(m, hot)), StateCheck::negative_heat), 0);
  EXPECT_NEAR(amount(seen(state_of_cold), StateCheck::negative_heat) / (steps * mass * 3e3), 1, 1e-6);
  auto state = full_of(m, 0);
  state.bodies[0].at(0).volume[5] *= 1.3;
  const BodyEvidence crowded = seen(state);
  EXPECT_EQ(count(crowded, StateCheck::overfilled), state.step);
  EXPECT_NEAR(amount(crowded, StateCheck::overfilled), 0.3 * static_cast<double>(state.step), 1e-9);
}

// One per cent of the way to melting, at the density at rest.
TEST(StateSurvey, NoiseOfTheTemperatureIsSmallBesideTheWayToMelting) {
  Material m = copper_with(PerfectlyPlastic{43e9, 0.4e9}, Thermal::Rule::energy);
  m.melting.temperature = 1358;
  const double way = temperature_law(m).melting_at(density(m)) - m.thermal.initial_temperature,
               heat = m.thermal.specific_heat;
  EXPECT_EQ(count(seen(full_of(m, -0.009 * way * heat)), StateCheck::negative_heat), 0);
  EXPECT_GT(count(seen(full_of(m, -0.011 * way * heat)), StateCheck::negative_heat), 0);
}

// Copper at 1 km/s: half a per cent of rho c V/2 = 17.6 GPa, over Gamma rho c_v, is 12.7 K.
TEST(StateSurvey, NoiseOfTheTemperatureGoesWithTheImpact) {
  const Material m = copper_with(samples::copper().strength, Thermal::Rule::energy);
  EXPECT_EQ(count(seen(full_of(m, -4e3), {}, 1000), StateCheck::negative_heat), 0);
  EXPECT_GT(count(seen(full_of(m, -6e3), {}, 1000), StateCheck::negative_heat), 0);
}

}  // namespace
}  // namespace recoil::state_survey_test
