#include "material/lint.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <variant>

#include "material/library.hpp"
#include "samples.hpp"

namespace recoil::lint_test {
namespace {

bool finds(const Material& m, const std::string& word) {
  for (const Suspicion& s : lint(m))
    if (s.message.find(word) != std::string::npos && !s.help.empty()) return true;
  return false;
}

TEST(Lint, IsSilentOnTheLibrary) {
  const std::filesystem::path folder = std::filesystem::path(RECOIL_SOURCE_DIR) / "materials";
  for (const std::string& name : list_materials({folder})) {
    config::Diagnostics out;
    const auto m = find_material(name, nullptr, {folder}, out, {});
    ASSERT_TRUE(m) << out.text();
    for (const Suspicion& s : lint(*m)) ADD_FAILURE() << name << ": " << s.message << " (" << s.help << ")";
  }
}

TEST(Lint, FindsTheExchangedSpecificHeatsOfThePaper) {
  Material tungsten = samples::copper();
  tungsten.eos = MieGruneisen{17600, 4030, 1.24, 1.43};
  tungsten.strength = JohnsonCook{124e9, 1510e6, 177e6, .12, .016, 1.0, 1777};
  tungsten.thermal.specific_heat = 477;
  tungsten.facts.molar_mass = 0.165;
  EXPECT_TRUE(finds(tungsten, "Dulong"));
  tungsten.facts.molar_mass = unset;
  EXPECT_TRUE(finds(tungsten, "specific heat"));
  tungsten.thermal.specific_heat = 134;
  EXPECT_FALSE(finds(tungsten, "specific heat"));
}

TEST(Lint, FindsConstantsOfNoSolidAndNamesThem) {
  Material m = samples::copper();
  m.eos = MieGruneisen{8.93, 3940, 1.49, 2.0};
  ASSERT_EQ(lint(m).size(), 1U);
  EXPECT_EQ(lint(m)[0].key, "eos.density");
  EXPECT_TRUE(lint(m)[0].certain);
  m = samples::copper();
  std::get<JohnsonCook>(m.strength).a = 90e9;
  ASSERT_EQ(lint(m).size(), 1U);
  EXPECT_EQ(lint(m)[0].key, "strength.a");
  EXPECT_TRUE(lint(m)[0].certain);
}

TEST(Lint, FindsContradictingModuli) {
  Material m = samples::aluminium();
  m.facts.poisson_ratio = 0.30;  // the paper's, beside G = 26 GPa
  EXPECT_TRUE(finds(m, "poisson-ratio"));
  m.facts.poisson_ratio = 0.35;
  EXPECT_FALSE(finds(m, "poisson-ratio"));
  m.strength = PerfectlyPlastic{500e9, 1e9};
  EXPECT_TRUE(finds(m, "Poisson's ratio"));
}

/// The Hugoniot of iron above 13 GPa beside the shear modulus of steel.
TEST(Lint, FindsHugoniotsTooSoftForAMetal) {
  Material m = samples::copper();
  m.eos = MieGruneisen{7830, 3574, 1.92, 1.69};
  m.strength = PerfectlyPlastic{81.8e9, 1e9};
  EXPECT_TRUE(finds(m, "Poisson's ratio 0.17"));
  m.doubt = "Poisson's ratio is 0.18";
  EXPECT_FALSE(finds(m, "Poisson's ratio"));
  m.doubt.clear();
  m.strength = DruckerPrager{.shear_modulus = 81.8e9};
  EXPECT_FALSE(finds(m, "Poisson's ratio"));
}

TEST(Lint, FindsDuctilityThatGrowsWithTension) {
  Material m = samples::copper();
  m.damage = JohnsonCookDamage{.d1 = 0.05, .d2 = 3.44, .d3 = -2.12};
  EXPECT_FALSE(finds(m, "d3"));
  m.damage = JohnsonCookDamage{.d1 = 0.05, .d2 = 3.44, .d3 = 2.12};
  EXPECT_TRUE(finds(m, "d3 2.12 lets matter bear more strain"));
}

TEST(Lint, FindsYieldOfTheWrongOrder) {
  Material m = samples::copper();
  m.strength = PerfectlyPlastic{43.33e9, 40e9};  // 0.4 Mbar for 0.4 GPa
  EXPECT_TRUE(finds(m, "yield stress"));
  m.strength = PerfectlyPlastic{43.33e9, 0.4e9};
  EXPECT_FALSE(finds(m, "yield stress"));
}

TEST(Lint, FindsAMeltedStartAndOddHugoniots) {
  Material m = samples::copper();
  m.thermal.initial_temperature = 1400;
  EXPECT_TRUE(finds(m, "melting"));
  m.eos = MieGruneisen{8930, 3940, 3.2, 4.5};
  EXPECT_TRUE(finds(m, "slope"));
  EXPECT_TRUE(finds(m, "gamma0"));
}

/// An ideal gas: p = (gamma - 1) rho c_v T at rest.
TEST(Lint, FindsGasesThatContradictThemselves) {
  Material air;
  air.eos = IdealGas{1.2041, 1.4, 101325};
  air.strength = NoStrength{};
  air.thermal.specific_heat = 717.6;
  air.thermal.initial_temperature = 293.15;
  EXPECT_TRUE(lint(air).empty());
  air.thermal.specific_heat = 1005;  // that at constant pressure
  EXPECT_TRUE(finds(air, "specific heat"));
}

TEST(Lint, FindsADetonationVelocityOfAnotherExplosive) {
  Material tnt;
  Jwl jwl = samples::of(Jwl{})[0];
  tnt.eos = jwl;
  tnt.strength = NoStrength{};
  tnt.thermal.specific_heat = 1000;
  EXPECT_TRUE(lint(tnt).empty());
  jwl.detonation_velocity = 7980;
  tnt.eos = jwl;
  EXPECT_TRUE(finds(tnt, "detonation-velocity"));
}

TEST(Lint, LetsCeramicsBeHarderThanMetals) {
  Material m = samples::copper();
  m.eos = LinearEos{2510, 233e9};
  m.strength = PerfectlyPlastic{197e9, 15e9};
  m.thermal.specific_heat = 950;
  m.facts.molar_mass = unset;
  EXPECT_FALSE(finds(m, "yield stress"));
  m.strength = PerfectlyPlastic{197e9, 25e9};
  EXPECT_TRUE(finds(m, "yield stress"));
}

}  // namespace
}  // namespace recoil::lint_test
