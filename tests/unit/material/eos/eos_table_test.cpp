#include "material/eos/eos_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "../../support/scratch_folder.hpp"
#include "../samples.hpp"
#include "material/hugoniot.hpp"
#include "material/library.hpp"

namespace recoil::eos_table_test {
namespace {

Material copper_by_energy() {
  Material m = samples::hydro(samples::copper());
  m.thermal.rule = Thermal::Rule::energy;
  return m;
}

Material tabulated_copper(int densities, double least = 0.8) {
  Material m = copper_by_energy();
  m.eos = samples::tabulated(m, {.least = least, .most = 1.9, .densities = densities});
  return m;
}

/// What is wrong with the table of copper that `change` has spoilt.
template <class F>
std::string fault_of(const F& change, const EosTable::Limits& limits = {}) {
  RawEosTable raw = tabulate(copper_by_energy(), {.least = 0.8, .most = 1.5, .densities = 20});
  change(raw);
  std::string problem, help;
  const EosTable table(raw, limits, problem, help);
  EXPECT_EQ(problem.empty(), help.empty());
  return problem + " | " + help;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Two densities and two temperatures as SESAME's own files write them: five numbers of 15 characters and
/// five digits a line, numbers that touch, other tables before and after.
TEST(EosTableFile, ReadsTheLayoutOfSesame) {
  const std::string text =
      "# comment\n"
      " 0  3333  201   5   r  22079 22079 1\n"
      " 1.00000000E+00 2.00000000E+00 3.00000000E+00 4.00000000E+00 5.00000000E+0011111\n"
      " 1  3333  301  14   r  22079 22079 1\n"
      " 2.00000000E+00 2.00000000E+00 8.93000000E+00 9.00000000E+00 2.98000000E+0211111\n"
      " 4.00000000E+02-1.00000000E+00-2.00000000E+00 3.00000000E+00 4.00000000E+0011111\n"
      " 5.00000000E-01 6.00000000E-01+7.00000000E-01 8.00000000E-01                11110\n"
      " 2  3333  401   2   r  22079 22079 1\n"
      " 1.00000000E+00 2.00000000E+00\n";
  const EosTableFile file = parse_eos_table(text);
  ASSERT_EQ(file.problem, "");
  const auto near = [](const std::vector<double>& got, const std::vector<double>& want) {
    ASSERT_EQ(got.size(), want.size());
    for (std::size_t k = 0; k < got.size(); ++k) EXPECT_NEAR(got[k], want[k], 1e-12 * std::abs(want[k]));
  };
  near(file.table.density, {8930, 9000});
  near(file.table.temperature, {298, 400});
  near(file.table.pressure, {-1e9, 3e9, -2e9, 4e9});
  near(file.table.energy, {0.5e6, 0.7e6, 0.6e6, 0.8e6});
}

TEST(EosTableFile, ReadsWhatItWrites) {
  const RawEosTable raw = tabulate(copper_by_energy(), {.densities = 12, .temperatures = 3});
  const EosTableFile again = parse_eos_table(to_text(raw, "copper"));
  ASSERT_EQ(again.problem, "");
  ASSERT_EQ(again.table.pressure.size(), raw.pressure.size());
  for (std::size_t k = 0; k < raw.pressure.size(); ++k) {
    EXPECT_NEAR(again.table.pressure[k], raw.pressure[k], 1e-14 * std::abs(raw.pressure[k]));
    EXPECT_NEAR(again.table.energy[k], raw.energy[k], 1e-14 * std::abs(raw.energy[k]));
  }
}

TEST(EosTableFile, SaysWhatIsWrong) {
  EXPECT_TRUE(has(parse_eos_table("2 2 1 2\n298 4oo\n").problem, "line 2"));
  EXPECT_TRUE(has(parse_eos_table("2 2 1 2 298 400 1 2 3").problem, "has 9 words"));
  EXPECT_TRUE(has(parse_eos_table("2.5 2 1 2").problem, "2.5"));
  EXPECT_TRUE(has(parse_eos_table("").problem, "no table 301"));
  EXPECT_TRUE(has(read_eos_table("/nowhere/x.sesame").problem, "/nowhere/x.sesame"));
}

TEST(EosTable, ChecksThermodynamics) {
  const auto keep = [](RawEosTable&) {};
  EXPECT_EQ(fault_of(keep), " | ");
  EXPECT_TRUE(has(fault_of([](RawEosTable& t) { t.energy[21] = t.energy[20]; }), "the energy does not rise"));
  EXPECT_TRUE(has(fault_of([](RawEosTable& t) { t.pressure[21] = t.pressure[20]; }), "least-density"));
  EXPECT_TRUE(has(fault_of([](RawEosTable& t) { std::swap(t.density[3], t.density[4]); }), "densities"));
  EXPECT_TRUE(has(fault_of(keep, {.temperature = 20}), "not the initial temperature"));
  EXPECT_TRUE(has(fault_of(keep, {.least = 9500}), "free of pressure"));
  EXPECT_TRUE(has(fault_of(keep, {.least = 11000, .most = 11500}), "fewer than four"));
  const auto soft = [](RawEosTable& t) {  // the same pressure at all high densities
    for (std::size_t k = t.pressure.size() / 2; k < t.pressure.size(); ++k)
      t.pressure[k] -= (t.density[k / 20] - 10300) * 6e7;
  };
  EXPECT_TRUE(has(fault_of(soft), "sound speed")) << fault_of(soft);
}

/// The state at rest is the one without pressure at the temperature of rest, wherever rows and isotherms are.
TEST(EosTable, FindsRestBetweenItsStates) {
  RawEosTable raw = tabulate(copper_by_energy(), {.least = 0.81, .most = 1.47, .densities = 61});
  raw.density.erase(raw.density.begin() + 17);  // rest itself
  for (auto* values : {&raw.pressure, &raw.energy})
    values->erase(values->begin() + 17 * 20, values->begin() + 18 * 20);
  std::string problem, help;
  const EosTable table(raw, {}, problem, help);
  ASSERT_EQ(problem, "");
  EXPECT_NEAR(table.rest_density(), 8930, 2);
  EXPECT_EQ(table.pressure(table.rest_density(), 0), 0);
  EXPECT_EQ(table.energy(table.rest_density(), 0), 0);
  EXPECT_NEAR(table.temperature(table.rest_density(), 0), 298, 1e-9);
}

/// Pressure, temperature and sound speed against the analytic ones: errors fall faster than the square of the
/// spacing.
TEST(EosTable, ConvergesToWhatItTabulates) {
  const Material exact = copper_by_energy();
  const TemperatureLaw law(exact.thermal, exact.eos);
  double before_p = 0, before_t = 0;
  for (const int n : {56, 111, 221}) {
    const Material m = tabulated_copper(n);
    const TemperatureLaw own(m.thermal, m.eos);
    double worst_p = 0, worst_t = 0;
    for (int k = 0; k < 423; ++k)
      for (const double e : {1e5, 1e6}) {
        const double rho = (1.021 + 0.00137 * k) * 8930, hot = law.isentrope(rho) + e;
        worst_p = std::max(worst_p, std::abs(pressure(m.eos, rho, hot) - pressure(exact.eos, rho, hot)));
        worst_t = std::max(worst_t, std::abs(own.by_energy(rho, hot) - law.by_energy(rho, hot)));
      }
    if (before_p > 0) {
      EXPECT_LT(worst_p, before_p / 5) << n;
      EXPECT_LT(worst_t, std::max(before_t / 4, 1e-3)) << n;
    }
    before_p = worst_p, before_t = worst_t;
  }
  EXPECT_LT(before_p, 2e6);
  EXPECT_LT(before_t, 2e-3) << "K; the isentrope itself is tabulated to about that";
}

TEST(EosTable, HasTheHugoniotOfWhatItTabulates) {
  const Material exact = copper_by_energy(), table = tabulated_copper(111);
  for (const double u : {100.0, 300.0, 1000.0, 2500.0}) {
    const ShockState a = shock_at_velocity(exact, u), b = shock_at_velocity(table, u);
    EXPECT_NEAR(b.stress / a.stress, 1, 1e-3) << u;
    EXPECT_NEAR(b.temperature / a.temperature, 1, 2e-3) << u;
    EXPECT_NEAR(b.density / a.density, 1, 1e-3) << u;
  }
}

/// A table that ends just below rest: straight on in tension, and as cold as the work of expansion makes it.
TEST(EosTable, GoesOnBelowItsLeastDensity) {
  const Material whole = tabulated_copper(111), cut = tabulated_copper(111, 0.985);
  const auto& eos = std::get<Tabular>(cut.eos);
  EXPECT_NEAR(eos.range.least, 0.5, 1e-9);
  EXPECT_NEAR(eos.rho0, 8930, 1);
  const TemperatureLaw a(whole.thermal, whole.eos), b(cut.thermal, cut.eos);
  for (const double x : {0.97, 0.95, 0.92}) {
    const double rho = x * 8930, p = pressure(cut.eos, rho, b.isentrope(rho));
    EXPECT_NEAR(p / pressure(whole.eos, rho, a.isentrope(rho)), 1, 0.08) << x;
    EXPECT_GT(sound_speed_squared(cut.eos, rho, p), 0);
  }
}

/// Beyond its temperatures and densities it stays finite, and goes straight on.
TEST(EosTable, GoesStraightOnBeyondItsEdges) {
  const Material m = tabulated_copper(56);
  const auto& eos = std::get<Tabular>(m.eos);
  const double rho = 9500, p = eos.pressure(rho, -5e5), q = eos.pressure(rho, -6e5),
               r = eos.pressure(rho, -7e5);
  EXPECT_NEAR(p - q, q - r, 1e-9 * std::abs(p));
  for (const double far : {1e-3, 1.0, 1e5}) {
    EXPECT_TRUE(std::isfinite(eos.pressure(far, 1e5)));
    EXPECT_TRUE(std::isfinite(eos.sound_speed_squared(far, 1e9)));
  }
  EXPECT_FALSE(eos.admissible(1.001 * eos.largest_density()));
}

struct Found {
  std::optional<Material> material;
  config::Diagnostics out;
};

Found read_lines(const std::filesystem::path& folder, const std::string& more, const std::string& lines) {
  Found found;
  const std::string text = "[material.mine]\neos = { kind = \"tabular\", file = \"cu.sesame\"" + more +
                           " }\nstrength = { kind = \"none\" }\n" + lines;
  const config::Document own = config::parse_document(text, (folder / "case.toml").string(), found.out);
  found.material = find_material("mine", &own, {}, found.out, {});
  return found;
}

Found read_from(const std::filesystem::path& folder, const std::string& thermal,
                const std::string& more = {}) {
  return read_lines(folder, more, "thermal = { " + thermal + " }\n");
}

TEST(Tabular, IsReadFromAFileBesideTheCase) {
  const ScratchFolder scratch;
  const Material exact = copper_by_energy();
  std::ofstream(scratch.path() / "cu.sesame") << to_text(tabulate(exact, {}), "copper");
  const Found found = read_from(scratch.path(), "");
  ASSERT_TRUE(found.material) << found.out.text();
  EXPECT_NEAR(density(*found.material), 8930, 1e-3);
  EXPECT_NEAR(found.material->thermal.specific_heat, 383.5, 0.5);
  const std::string text = to_toml(*found.material);
  EXPECT_TRUE(has(text, "file = \"cu.sesame\"")) << text;
  EXPECT_FALSE(has(text, "specific-heat")) << text;
  EXPECT_TRUE(read_from(scratch.path(), "initial-temperature = \"400 K\"").material);
  const Found without = read_lines(scratch.path(), "", "");  // all of [thermal] is the table's
  ASSERT_TRUE(without.material) << without.out.text();
  EXPECT_EQ(without.material->thermal.specific_heat, found.material->thermal.specific_heat);
  const auto mistake = [&](const std::string& thermal, const std::string& more) {
    return read_from(scratch.path(), thermal, more).out.text();
  };
  EXPECT_TRUE(has(mistake("specific-heat = \"380 J/(kg K)\"", ""), "leave specific-heat out"));
  EXPECT_TRUE(has(mistake("temperature = \"plastic-work\"", ""), "has the temperature"));
  EXPECT_TRUE(has(mistake("", ", least-density = \"9.5 g/cm3\""), "case.toml:2"));
  EXPECT_TRUE(has(read_from("/nowhere", "").out.text(), "there is no file /nowhere/cu.sesame"));
}

}  // namespace
}  // namespace recoil::eos_table_test
