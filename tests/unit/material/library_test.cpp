#include "material/library.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "material/hugoniot.hpp"

namespace recoil::library_test {
namespace {

const std::filesystem::path folder = std::filesystem::path(RECOIL_SOURCE_DIR) / "materials";

struct Found {
  std::optional<Material> material;
  config::Diagnostics out;
};

/// Looks a name up, beside the tables of a case given as text.
Found find(const std::string& name, const std::string& text = "format = 1") {
  Found found;
  const config::Document own = config::parse_document(text, "case.toml", found.out);
  found.material = find_material(name, &own, {folder}, found.out, {"case.toml", 1, 1, 1});
  return found;
}

bool says(const Found& found, const std::string& word) {
  return !found.material && found.out.text().find(word) != std::string::npos;
}

TEST(Library, EveryFileLoadsAndIsCited) {
  std::ifstream file(folder / "references.bib");
  std::stringstream references;
  references << file.rdbuf();
  const std::vector<std::string> names = list_materials({folder});
  EXPECT_GE(names.size(), 40u);
  for (const std::string& name : names) {
    const Found found = find(name);
    ASSERT_TRUE(found.material) << name << "\n" << found.out.text();
    EXPECT_FALSE(found.material->title.empty()) << name;
    EXPECT_FALSE(found.material->cite.empty()) << name;
    for (const std::string& key : found.material->cite)
      EXPECT_NE(references.str().find("{" + key + ","), std::string::npos) << name << " cites " << key;
    EXPECT_TRUE(found.out.list().empty()) << found.out.text();
  }
}

/// One brace that is missing hides all entries behind it.
TEST(Library, EntriesOfTheBibliographyAreClosed) {
  std::ifstream file(folder / "references.bib");
  long depth = 0, entries = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('@')) {
      ++entries;
      EXPECT_EQ(depth, 0) << "before " << line;
    }
    depth += std::ranges::count(line, '{') - std::ranges::count(line, '}');
  }
  EXPECT_EQ(depth, 0);
  EXPECT_GE(entries, 50);
}

TEST(Library, ReadsValuesInSi) {
  const Found found = find("copper/seed");
  ASSERT_TRUE(found.material) << found.out.text();
  EXPECT_EQ(found.material->name, "copper/seed");
  const auto& eos = std::get<MieGruneisen>(found.material->eos);
  EXPECT_EQ(eos.rho0, 8930);
  EXPECT_EQ(eos.s, 1.49);
  const auto& jc = std::get<JohnsonCook>(found.material->strength);
  EXPECT_NEAR(jc.shear_modulus, 43.33e9, 1);
  EXPECT_NEAR(jc.b, 177e6, 1e-3);
  EXPECT_EQ(jc.reference_temperature, 298);
  EXPECT_EQ(found.material->thermal.specific_heat, 383.5);
  EXPECT_EQ(found.material->thermal.rule, Thermal::Rule::plastic_work);
  EXPECT_NEAR(found.material->facts.molar_mass, 0.063546, 1e-9);
}

TEST(Library, CaseChangesSingleValues) {
  const Found found = find("mine",
                           "[material.mine]\nbase = \"copper/seed\"\nstrength.c = 0\n"
                           "thermal.temperature = \"energy\"\n");
  ASSERT_TRUE(found.material) << found.out.text();
  const auto& jc = std::get<JohnsonCook>(found.material->strength);
  EXPECT_EQ(jc.c, 0);
  EXPECT_NEAR(jc.a, 400e6, 1e-3);
  EXPECT_EQ(found.material->thermal.rule, Thermal::Rule::energy);
  EXPECT_EQ(found.material->cite, std::vector<std::string>{"seed"});
}

TEST(Library, HeatIsByEnergyUnlessTheMaterialSaysOtherwise) {
  EXPECT_EQ(find("copper/ofhc-johnson-cook").material->thermal.rule, Thermal::Rule::energy);
  EXPECT_EQ(find("steel/hzb").material->thermal.rule, Thermal::Rule::plastic_work);
  const char* half = "[material.mine]\nbase = \"steel/4340\"\nthermal.taylor-quinney = 0.9\n";
  const Found wrong = find("mine", half);
  EXPECT_FALSE(wrong.material);
  EXPECT_NE(wrong.out.text().find("taylor-quinney must be 1"), std::string::npos) << wrong.out.text();
  EXPECT_TRUE(find("mine", std::string(half) + "thermal.temperature = \"plastic-work\"\n").material);
}

TEST(Library, CaseChangesTheKindAndKeepsWhatBothHave) {
  const Found fluid = find("wet", "[material.wet]\nbase = \"copper/seed\"\nstrength = { kind = \"none\" }\n");
  ASSERT_TRUE(fluid.material) << fluid.out.text();
  EXPECT_TRUE(std::holds_alternative<NoStrength>(fluid.material->strength));
  const Found stiff =
      find("stiff", "[material.stiff]\nbase = \"copper/seed\"\nstrength = { kind = \"elastic\" }\n");
  ASSERT_TRUE(stiff.material) << stiff.out.text();
  EXPECT_NEAR(std::get<Elastic>(stiff.material->strength).shear_modulus, 43.33e9, 1);
}

/// Melting of a library material, or of material `m` made from it with keys of its own.
Melting melting_of(const std::string& base, const std::string& keys = {}) {
  const Found found = keys.empty() ? find(base) : find("m", "[material.m]\nbase = \"" + base + "\"\n" + keys);
  EXPECT_TRUE(found.material) << base << "\n" << keys << found.out.text();
  return found.material.value_or(Material{}).melting;
}

TEST(Library, MeltingGoesWithTheStrength) {
  EXPECT_EQ(melting_of("copper/steinberg").temperature, 1790);  // the model's
  EXPECT_EQ(melting_of("copper/steinberg").slope, 1.5);
  EXPECT_EQ(melting_of("copper/zerilli-armstrong").temperature, 1357.77);
  EXPECT_FALSE(melting_of("copper/seed").melts());
  const char* plastic = "strength = { kind = \"perfectly-plastic\", yield = \"0.1 GPa\" }\n";
  const char* johnson_cook =
      "strength = { kind = \"johnson-cook\", a = \"90 MPa\", b = \"292 MPa\", n = 0.31, c = 0.025, m = 1.09, "
      "melting-temperature = \"1356 K\" }\n";
  EXPECT_FALSE(melting_of("copper/steinberg", plastic).melts());
  EXPECT_EQ(melting_of("copper/zerilli-armstrong", plastic).temperature, 1357.77);
  EXPECT_EQ(melting_of("copper/zerilli-armstrong", johnson_cook).temperature, 1356);
  EXPECT_EQ(melting_of("copper/zerilli-armstrong", johnson_cook).heat, 208.7e3);
}

TEST(Library, MeltingThatContradictsItsMaterialIsRefused) {
  const auto wrong = [](const char* base, const char* keys, const char* word) {
    EXPECT_TRUE(says(find("m", std::string("[material.m]\nbase = \"") + base + "\"\n" + keys), word)) << keys;
  };
  wrong("copper/seed", "melting = { temperature = \"1358 K\" }\n",
        "the strength model has the melting temperature");
  wrong("copper/steinberg", "melting = { slope = 1.5, gamma0 = 2 }\n",
        "the strength model has the melting curve");
  wrong("copper/zerilli-armstrong", "melting.slope = 1.5\n", "belong together");
  wrong("aluminium/6061-t6", "strength = { kind = \"none\" }\nmelting = { heat = \"397 kJ/kg\" }\n",
        "needs a temperature");
  wrong("copper/zerilli-armstrong", "thermal.initial-temperature = \"1400 K\"\n", "molten at the start");
  wrong("copper/zerilli-armstrong", "melting.heat = \"208.7 J\"\n", "J/kg");
}

/// Where sound speeds fell: McQueen, Fritz & Morris (1984), Hayes, Hixson & McQueen (2000), Brown & Shaner
/// (1984).
TEST(Library, ShockMeltsMetalsWithinAFifthOfWhereItWasSeen) {
  const auto expect = [](const char* name, double measured, double part) {
    const Found found = find(name);
    ASSERT_TRUE(found.material) << name;
    double low = 1000, high = 6000;  // m/s
    while (high - low > 1) {
      const double middle = 0.5 * (low + high);
      (shock_at_velocity(*found.material, middle).molten > 0 ? high : low) = middle;
    }
    const ShockState begins = shock_at_velocity(*found.material, high),
                     beyond = shock_at_velocity(*found.material, 1.1 * high);
    EXPECT_NEAR(begins.stress / measured, 1, part) << name;
    EXPECT_GT(beyond.molten, 0.5) << name;
    EXPECT_EQ(beyond.yield, 0) << name;
  };
  expect("copper/steinberg", 232e9, 0.06);
  expect("tantalum/steinberg", 295e9, 0.1);
  expect("copper/zerilli-armstrong", 232e9, 0.17);
  expect("aluminium/1100-o", 125e9, 0.17);
}

/// The length over which damage averages belongs to every damage model, and is none of a model's constants.
TEST(Library, TheLengthOfDamageStaysWithAnotherModel) {
  const std::string weak =
      "[material.weak]\nbase = \"copper/seed\"\n"
      "damage = { kind = \"minimum-pressure\", tension = \"1 GPa\", length = \"0.06 mm\" }\n";
  const Found first = find("weak", weak);
  ASSERT_TRUE(first.material) << first.out.text();
  EXPECT_DOUBLE_EQ(first.material->damage_average.length, 6e-5);
  EXPECT_TRUE(averages_damage(*first.material));
  const Found again = find("again", to_toml(*first.material, "material.again"));
  ASSERT_TRUE(again.material) << again.out.text();
  EXPECT_DOUBLE_EQ(again.material->damage_average.length, 6e-5);
  const Found other =
      find("slow", weak +
                       "[material.slow]\nbase = \"weak\"\n"
                       "damage = { kind = \"tensile\", threshold = \"1 GPa\", time = \"1 us\" }\n");
  ASSERT_TRUE(other.material) << other.out.text();
  EXPECT_TRUE(std::holds_alternative<TensileDamage>(other.material->damage));
  EXPECT_DOUBLE_EQ(other.material->damage_average.length, 6e-5);
  EXPECT_FALSE(averages_damage(*find("copper/seed").material));
  EXPECT_TRUE(says(find("x", "[material.x]\nbase = \"weak\"\ndamage.length = \"3 Pa\"\n" + weak), "length"));
  EXPECT_TRUE(
      says(find("x", "[material.x]\nbase = \"weak\"\ndamage.lengthy = \"3 mm\"\n" + weak), "lengthy"));
}

TEST(Library, CaseDefinesAMaterialOfItsOwnAndABaseOfABase) {
  const std::string text = R"toml(
[material.goo]
eos = { kind = "linear", density = "1 g/cm3", bulk-modulus = "2.2 GPa" }
strength = { kind = "none" }
thermal = { specific-heat = "4180 J/(kg K)" }
[material.warm-goo]
base = "goo"
thermal.initial-temperature = "350 K"
[material."copper/seed"]
base = "copper/seed"
strength.c = 0
)toml";
  const Found warm = find("warm-goo", text);
  ASSERT_TRUE(warm.material) << warm.out.text();
  EXPECT_NEAR(density(*warm.material), 1000, 1e-9);
  EXPECT_EQ(warm.material->thermal.initial_temperature, 350);
  const Found shadow = find("copper/seed", text);
  ASSERT_TRUE(shadow.material) << shadow.out.text();
  EXPECT_EQ(std::get<JohnsonCook>(shadow.material->strength).c, 0);
}

TEST(Library, MistakesNameTheirCure) {
  EXPECT_TRUE(says(find("coper/seed"), "copper/seed"));
  EXPECT_TRUE(says(find("coper/seed"), "unknown material 'coper/seed'"));
  EXPECT_TRUE(says(find("coper/ofhc"), "copper/ofhc-johnson-cook"));
  EXPECT_TRUE(says(find("al/6061"), "aluminium/6061-t6"));
  EXPECT_TRUE(says(find("steel/stainless"), "steel/304"));
  EXPECT_TRUE(says(find("kryptonite/pure"), "material list"));
  EXPECT_TRUE(says(find("x", "[material.x]\nbase = \"steel/4341\"\n"), "steel/4340"));
  EXPECT_TRUE(
      says(find("kryptonite", "[material.goo]\nbase = \"copper/seed\"\n"), "the case itself has 'goo'"));
  EXPECT_TRUE(says(find("x", "[material.x]\nbase = \"x\"\n"), "its own base"));
  EXPECT_TRUE(says(find("x", "[material.x]\nbase = \"y\"\n[material.y]\nbase = \"x\"\n"), "its own base"));
  EXPECT_TRUE(says(find("x", "[material.x]\nbase = \"copper/seed\"\nstrength.kind = \"jonson-cook\"\n"),
                   "johnson-cook"));
  EXPECT_TRUE(says(find("x", "[material.x]\nbase = \"copper/seed\"\nstrength.cc = 0\n"), "cc"));
  EXPECT_TRUE(says(find("x", "[material.x]\nbase = \"copper/seed\"\nstrength.a = \"3 m\"\n"), "pressure"));
  EXPECT_TRUE(says(find("x", "[material.x]\nbase = \"copper/seed\"\nstrength.a = 3\n"), "case.toml:3"));
  EXPECT_TRUE(says(find("x", "[material.x]\ntitle = \"nothing\"\n"), "eos"));
  EXPECT_TRUE(
      says(find("x", "[material.x]\nbase = \"copper/seed\"\nstrength.melting-temperature = \"250 K\"\n"),
           "reference-temperature"));
  EXPECT_TRUE(says(
      find(
          "x",
          "[material.x]\nbase = \"gas/air\"\nstrength = { kind = \"elastic\", shear-modulus = \"1 GPa\" }\n"),
      "no strength"));
  EXPECT_TRUE(says(find("x",
                        "[material.x]\nbase = \"copper/seed\"\n"
                        "strength = { kind = \"perfectly-plastic\" }\n"),
                   "yield"));
}

TEST(Library, WritesWhatItReads) {
  for (const std::string& name : list_materials({folder})) {
    const Found first = find(name);
    ASSERT_TRUE(first.material);
    const std::string text = to_toml(*first.material, "material.again");
    const Found second = find("again", text);
    ASSERT_TRUE(second.material) << second.out.text();
    EXPECT_EQ(to_toml(*second.material, "material.again"), text);
  }
}

TEST(Library, SectionsCoverEveryModel) {
  std::multiset<std::string> kinds;
  for (const config::Section& s : material_sections()) {
    EXPECT_FALSE(s.doc.empty());
    if (!s.kind.empty()) kinds.insert(s.kind);
    for (const config::Key& k : s.keys) EXPECT_FALSE(k.doc.empty()) << s.name << " " << k.name;
  }
  EXPECT_EQ(kinds.size(), std::variant_size_v<Eos> + std::variant_size_v<PorousSolid> +
                              std::variant_size_v<Strength> + std::variant_size_v<Damage>);
}

TEST(Library, MissingFolderHasNoMaterials) { EXPECT_TRUE(list_materials({folder / "nowhere"}).empty()); }

/// Of the same name in two folders the first counts, and it may have the library's as its base.
TEST(Library, OwnFoldersComeFirst) {
  const std::filesystem::path own = std::filesystem::path(testing::TempDir()) / "own_materials";
  std::filesystem::create_directories(own / "copper");
  std::ofstream(own / "copper" / "seed.toml")
      << "title = \"mine\"\neos = { kind = \"linear\", density = \"1 g/cm3\", bulk-modulus = \"1 GPa\" }\n"
         "strength = { kind = \"none\" }\nthermal = { specific-heat = \"900 J/(kg K)\" }\n";
  config::Diagnostics out;
  const auto mine = find_material("copper/seed", nullptr, {own, folder}, out, {});
  ASSERT_TRUE(mine) << out.text();
  EXPECT_EQ(mine->title, "mine");
  EXPECT_EQ(list_materials({own, folder}).size(), list_materials({folder}).size()) << "a name counts once";
  const auto theirs = find_material("copper/seed", nullptr, {folder, own}, out, {});
  EXPECT_NE(theirs->title, "mine");
  std::filesystem::remove_all(own);
}

}  // namespace
}  // namespace recoil::library_test
