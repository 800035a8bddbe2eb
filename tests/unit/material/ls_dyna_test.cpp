#include "material/ls_dyna.hpp"

#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "core/error.hpp"

namespace recoil::ls_dyna_test {
namespace {

/// OFHC copper of Johnson & Cook (1983), in g, cm, us and K: pressures in Mbar.
const std::string copper = R"(*KEYWORD
$ a comment
*MAT_JOHNSON_COOK_TITLE
OFHC copper
$      mid        ro         g         e        pr
         1      8.96     0.477     1.287      0.35
      9e-4   2.92e-3      0.31     0.025      1.09      1356       298      1e-6
   3.83e-6     -1.e9       2.0       0.0      0.54      4.89     -3.03     0.014
      1.12
*EOS_GRUNEISEN
1,0.394,1.489,0,0,2.02,0.47,0
*END
)";

const CardUnits& units(const std::string& name) {
  for (const CardUnits& u : card_units())
    if (name == u.name) return u;
  throw InternalError("no such units");
}

TEST(LsDyna, ReadsCopperInSi) {
  const ImportedMaterial got = import_cards(copper, units("g-cm-us"), "copper.k");
  const auto& jc = std::get<JohnsonCook>(got.material.strength);
  EXPECT_NEAR(jc.shear_modulus, 47.7e9, 1);
  EXPECT_NEAR(jc.a, 90e6, 1e-3);
  EXPECT_NEAR(jc.b, 292e6, 1e-3);
  EXPECT_EQ(jc.n, 0.31);
  EXPECT_EQ(jc.melting_temperature, 1356);
  EXPECT_NEAR(jc.reference_rate, 1, 1e-12);
  const auto& eos = std::get<MieGruneisenCubic>(got.material.eos);
  EXPECT_NEAR(eos.rho0, 8960, 1e-9);
  EXPECT_NEAR(eos.c0, 3940, 1e-9);
  EXPECT_EQ(eos.a, 0.47);
  EXPECT_NEAR(got.material.thermal.specific_heat, 383, 1e-9);
  ASSERT_EQ(got.left_out.size(), 1U) << "the cutoff";
  EXPECT_EQ(got.material.title, "OFHC copper");
  EXPECT_EQ(eos.c0, 3940) << "with the digits of the card";
}

/// D1 to D4 are in the third card, D5 and the least strain in a fourth one that may be missing.
TEST(LsDyna, ReadsDamage) {
  const auto damage_of = [](const std::string& text) {
    return import_cards(text, units("g-cm-us"), "copper.k").material.damage;
  };
  const auto all = std::get<JohnsonCookDamage>(damage_of(copper));
  EXPECT_EQ(all.d1, 0.54);
  EXPECT_EQ(all.d2, 4.89);
  EXPECT_EQ(all.d3, -3.03);
  EXPECT_EQ(all.d4, 0.014);
  EXPECT_EQ(all.d5, 1.12);
  EXPECT_EQ(all.melting_temperature, 1356);
  EXPECT_EQ(all.reference_temperature, 298);
  EXPECT_NEAR(all.reference_rate, 1, 1e-12);
  EXPECT_EQ(all.problem(), nullptr);
  std::string text = copper;
  const std::string last = "      1.12\n";
  text.replace(text.find(last), last.size(), "1.12,0,0,0.01\n");
  EXPECT_EQ(std::get<JohnsonCookDamage>(damage_of(text)).least_strain, 0.01);
  text.erase(text.find("1.12,0"), 14);
  EXPECT_EQ(std::get<JohnsonCookDamage>(damage_of(text)).d5, 0);
  const std::string constants = "0.54      4.89     -3.03     0.014";
  text.replace(text.find(constants), constants.size(), "   0         0         0         0");
  EXPECT_TRUE(std::holds_alternative<NoDamage>(damage_of(text)));
}

TEST(LsDyna, UnitsAreCoherent) {
  EXPECT_NEAR(units("g-mm-ms").pressure(), 1e6, 1e-3);
  EXPECT_NEAR(units("kg-mm-ms").pressure(), 1e9, 1);
  EXPECT_NEAR(units("t-mm-s").pressure(), 1e6, 1e-3);
  EXPECT_NEAR(units("g-cm-us").pressure(), 1e11, 100);
  EXPECT_NEAR(units("g-mm-ms").velocity(), 1, 1e-12);
}

TEST(LsDyna, SaysWhatIsWrong) {
  const auto message = [](const std::string& text) {
    try {
      import_cards(text, units("SI"), "cards.k");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(message("*KEYWORD\n").find("no *MAT_JOHNSON_COOK"), std::string::npos);
  EXPECT_NE(message("*MAT_015\n1,8960\n").find("needs 3 cards"), std::string::npos);
  EXPECT_NE(message("*MAT_015\n1,eight\n")
                .find("'eight' in *MAT_JOHNSON_COOK, field 2, is no number\n  --> cards.k:2"),
            std::string::npos);
  EXPECT_NE(message("*MAT_015\n$\n         1  x\n").find("columns 11 to 20, is no number\n  --> cards.k:3"),
            std::string::npos);
  std::string cold = copper;
  cold.replace(cold.find("1356"), 4, "   0");
  EXPECT_NE(message(cold).find("TM"), std::string::npos);
}

}  // namespace
}  // namespace recoil::ls_dyna_test
