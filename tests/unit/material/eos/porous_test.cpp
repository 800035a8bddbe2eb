#include "material/eos/porous.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <exception>
#include <optional>
#include <string>
#include <variant>

#include "../samples.hpp"
#include "config/document.hpp"
#include "material/eos/any_eos.hpp"
#include "material/hugoniot.hpp"
#include "material/library.hpp"
#include "material/lint.hpp"
#include "material/starting_state.hpp"

namespace recoil::eos_porous_test {
namespace {

/// Pressed copper powder (materials/copper/pressed-powder.toml), without strength.
Porous copper_powder() {
  return samples::porous(MieGruneisen{8930, 3940, 1.489, 2.02}, 6400, 0.14e9, 3.56e9, 8);
}
Material powder_material() {
  Material m;
  m.name = "powder";
  m.eos = copper_powder();
  m.thermal.specific_heat = 383;
  return m;
}

/// Pressure on the crush curve of what is left of the distension.
double crush_pressure(const Porous& eos, double alpha) {
  return eos.compaction -
         (eos.compaction - eos.elastic_limit) * std::pow((alpha - 1) / (eos.alpha0 - 1), 1 / eos.exponent);
}

/// At any fixed distension pressure and energy are inverse, and c^2 is the slope of the isentrope.
TEST(Porous, IsAnEquationOfStateAtEveryDistension) {
  for (const Porous& eos : samples::of(Porous{}))
    for (const double part : {0.0, 0.3, 0.9, 1.0}) {
      const PorousState at = eos.frozen(part * (eos.alpha0 - 1));
      EXPECT_NEAR(at.rho0 * at.alpha, eos.rho0_solid, 1e-12 * eos.rho0_solid);
      EXPECT_EQ(at.pressure(at.rho0, 0), 0);
      const bool knows_energy = at.pressure(at.rho0, 1e5) != 0;
      for (const double x : {0.9, 0.97, 1.04, 1.3})
        for (const double e : {0.0, 1e5, 1e6}) {
          const double rho = x * at.rho0, p = at.pressure(rho, e), c2 = at.sound_speed_squared(rho, p);
          if (knows_energy) {
            EXPECT_NEAR(at.energy(rho, p), e, 1e-9 * (e + std::fabs(p) / rho)) << at.alpha << " " << x;
          }
          const double h = 1e-5 * rho, de = p / (rho * rho) * h;
          const double curve = 0.5 * h * (c2 - 2 * p / rho) / (rho * rho) * h;
          const double slope =
              (at.pressure(rho + h, e + de + curve) - at.pressure(rho - h, e - de + curve)) / (2 * h);
          EXPECT_NEAR(slope, c2, 2e-6 * std::fabs(c2) + 1e-6 * std::fabs(p / rho)) << at.alpha << " " << x;
        }
    }
}

/// Without pores left it is the solid.
TEST(Porous, IsTheSolidOnceItIsCompacted) {
  const MieGruneisen solid{8930, 3940, 1.489, 2.02};
  const PorousState at = copper_powder().frozen(copper_powder().alpha0 - 1);
  EXPECT_EQ(at.alpha, 1);
  for (const double rho : {8800.0, 9000.0, 11000.0}) {
    const double p = solid.pressure(rho, 2e5);
    EXPECT_NEAR(copper_powder().frozen(1).pressure(rho, 2e5), p, 1e-12 * std::fabs(p));
  }
}

/// Compressed in small steps along an isentrope: below the elastic limit nothing is crushed, then pressure
/// and distension lie on the curve, then all pores are gone.
TEST(Porous, FollowsTheCrushCurve) {
  for (const Porous& eos : samples::of(Porous{})) {
    double crushed = 0, e = 0;
    bool elastic = false, crushing = false, compacted = false;
    const double step = 2e-4 * eos.rho0;
    for (double rho = eos.rho0; rho < 2 * eos.rho0_solid && !compacted; rho += step) {
      const double before = crushed;
      e += eos.frozen(crushed).pressure(rho, e) / (rho * rho) * step;
      crushed = eos.crush(rho, e, crushed);
      ASSERT_GE(crushed, before);
      const double p = eos.frozen(crushed).pressure(rho, e), alpha = eos.distension(crushed);
      if (crushed == 0) {
        elastic = true;
        EXPECT_LE(p, eos.elastic_limit);
      } else if (alpha > 1) {
        crushing = true;
        EXPECT_NEAR(p, crush_pressure(eos, alpha), 1e-9 * eos.compaction) << alpha;
      } else {
        compacted = true;
        EXPECT_GE(p, eos.compaction * (1 - 1e-12));
      }
    }
    EXPECT_TRUE(elastic && crushing && compacted);
  }
}

TEST(Porous, UnloadsAndReloadsWithoutCrushing) {
  const Porous eos = copper_powder();
  const double rho = 7000, half = eos.crush(rho, 3000, 0);
  ASSERT_GT(half, 0.05);
  ASSERT_LT(half, eos.alpha0 - 1);
  const double top = eos.frozen(half).pressure(rho, 3000);
  for (const double x : {0.9, 0.98, 0.999, 1.0 - 1e-9}) EXPECT_EQ(eos.crush(x * rho, 3000, half), half);
  const double more = eos.crush(1.01 * rho, 3100, half);
  EXPECT_GT(more, half);
  EXPECT_GT(eos.frozen(more).pressure(1.01 * rho, 3100), top);
  // The way does not matter, only where it ends.
  EXPECT_NEAR(eos.crush(1.01 * rho, 3100, 0), more, 1e-12);
  EXPECT_EQ(eos.crush(2 * rho, 1e6, half), eos.alpha0 - 1);
}

/// The Hugoniot of compacted matter in closed form: with x = V0 - V, g = Gamma0 rho0, a first front to p1, V1
/// and e1, and p_H of the solid,
///   p = (p_H (1 - g x/2) + g (e1 + p1 (V1 - V)/2))/(1 - g (V1 - V)/2).
TEST(Porous, HasTheHugoniotOfCompactedMatter) {
  const Material m = powder_material();
  for (const double u : {450.0, 800.0, 1200.0, 2000.0}) {
    const ShockState s = shock_at_velocity(m, u);
    const double v = 1 / s.density, x = 1 / 8930.0 - v, g = 2.02 * 8930;
    const double own = 3940.0 * 3940.0 * x / std::pow(1 / 8930.0 - 1.489 * x, 2);
    const double v1 = s.has_precursor ? (1 - s.precursor_velocity / s.precursor_speed) / 6400 : 1 / 6400.0;
    const double e1 = 0.5 * s.precursor_velocity * s.precursor_velocity, p1 = s.precursor_stress;
    const double p = (own * (1 - 0.5 * g * x) + g * (e1 + 0.5 * p1 * (v1 - v))) / (1 - 0.5 * g * (v1 - v));
    EXPECT_NEAR(s.pressure, p, 1e-9 * p) << u;
    EXPECT_NEAR(s.energy, 0.5 * (p + p1) * (v1 - v) + e1, 1e-6 * s.energy);
  }
  // Compaction heats: at 1 km/s solid copper is far from melting, the powder beyond (1358 K).
  EXPECT_GT(shock_at_velocity(m, 1000).temperature, 1400);
  EXPECT_LT(shock_at_velocity(samples::hydro(samples::copper()), 1000).temperature, 600);
}

/// A third of the density of copper: behind stronger shocks it is thinner, for the heat grows faster than the
/// pressure. The jump conditions hold, at pressures above compaction with the solid's own equation of state.
TEST(Porous, HasAHugoniotThatTurnsBackInDensity) {
  const MieGruneisen solid{8930, 3940, 1.489, 2.02};
  Material m = powder_material();
  m.eos = samples::porous(solid, 3000, 0.14e9, 3.56e9, 8);
  double density = 1e9;
  for (const double u : {900.0, 1500.0, 2500.0}) {
    const ShockState s = shock_at_velocity(m, u);
    const double u1 = s.precursor_velocity, rho1 = u1 > 0 ? 3000 / (1 - u1 / s.precursor_speed) : 3000;
    EXPECT_NEAR(solid.pressure(s.density, s.energy), s.pressure, 1e-9 * s.pressure);
    EXPECT_NEAR(s.precursor_stress + rho1 * (s.shock_speed - u1) * (u - u1), s.pressure, 1e-9 * s.pressure);
    EXPECT_NEAR(rho1 * (s.shock_speed - u1), s.density * (s.shock_speed - u),
                1e-9 * s.density * s.shock_speed);
    EXPECT_LT(s.density, density);
    density = s.density;
  }
  EXPECT_LT(density, 8930);
}

TEST(Porous, SendsAPrecursorAheadUntilTheShockOvertakesIt) {
  const Material m = powder_material();
  const ShockState weak = shock_at_velocity(m, 100), strong = shock_at_velocity(m, 2000);
  ASSERT_TRUE(weak.has_precursor);
  EXPECT_NEAR(weak.precursor_stress, 0.14e9, 1e-6 * 0.14e9);
  EXPECT_NEAR(weak.precursor_speed, 3940, 20);
  EXPECT_NEAR(weak.precursor_stress, 6400 * weak.precursor_speed * weak.precursor_velocity, 1e-9 * 0.14e9);
  EXPECT_FALSE(strong.has_precursor);
  EXPECT_FALSE(shock_at_velocity(m, 4).has_precursor);
}

/// Boade, J. Appl. Phys. 41 (1970) 4542, of copper powder pressed to 6.4 g/cm3: Hugoniot states from the
/// precursor, P1 = 0.14 GPa, to 3.5 GPa obey alpha = 1 + (alpha1 - 1) exp(-(P - P1) 2.54/GPa), with alpha the
/// density of solid copper over that of the powder. The exponent and p_s of the material are fitted to that:
/// 0.0065 in alpha.
TEST(Porous, MatchesMeasuredHugoniotOfCopperPowder) {
  const Material m = powder_material();
  for (const double u : {40.0, 100.0, 150.0, 200.0, 300.0, 380.0}) {
    const ShockState s = shock_at_velocity(m, u);
    ASSERT_LT(s.pressure, 3.5e9);
    const double alpha = 1 + (8930.0 / 6400 - 1) * std::exp(-2.54e-9 * (s.pressure - 0.14e9));
    EXPECT_NEAR(crushed_by(m.eos, s.density, s.energy), 8930.0 / 6400 - alpha, 0.0075) << u;
  }
}

constexpr const char* written = R"text(
title = "powder"
[eos]
kind = "porous"
density = "6.4 g/cm3"
elastic-limit = "0.14 GPa"
compaction-pressure = "3.56 GPa"
exponent = 8
solid = { kind = "mie-gruneisen", density = "8.93 g/cm3", c0 = "3940 m/s", s = 1.489, gamma0 = 2.02 }
[strength]
kind = "none"
[thermal]
specific-heat = "383 J/(kg K)"
)text";

struct Read {
  std::optional<Material> material;
  config::Diagnostics out;
};

/// The text with one part of it replaced.
Read read(std::string from = {}, const std::string& to = {}, std::string text = written) {
  Read r;
  if (!from.empty()) text.replace(text.find(from), from.size(), to);
  const config::Document document = config::parse_document(text, "powder.toml", r.out);
  r.material = read_material("powder", document.root, r.out);
  return r;
}
bool says(const Read& r, const std::string& word) {
  return !r.material && r.out.text().find(word) != std::string::npos;
}

TEST(Porous, IsReadAndWrittenWithItsSolid) {
  const Read r = read();
  ASSERT_TRUE(r.material) << r.out.text();
  const Porous &eos = std::get<Porous>(r.material->eos), expected = copper_powder();
  EXPECT_EQ(eos.rho0, expected.rho0);
  EXPECT_EQ(eos.alpha0, expected.alpha0);
  EXPECT_EQ(std::get<MieGruneisen>(eos.solid).s, 1.489);
  EXPECT_EQ(eos.exponent, 8);
  const std::string text = to_toml(*r.material);
  EXPECT_NE(text.find("solid.kind = \"mie-gruneisen\""), std::string::npos) << text;
  const Read again = read({}, {}, text);
  ASSERT_TRUE(again.material) << again.out.text();
  EXPECT_EQ(to_toml(*again.material), text);
  EXPECT_TRUE(lint(*r.material).empty());
}

TEST(Porous, RefusesWhatContradictsItself) {
  EXPECT_TRUE(says(read("6.4 g/cm3", "9 g/cm3"), "below that of its solid"));
  EXPECT_TRUE(says(read("3.56 GPa", "0.1 GPa"), "must exceed elastic-limit"));
  EXPECT_TRUE(says(read("specific-heat", "temperature = \"plastic-work\"\nspecific-heat"), "porous matter"));
  EXPECT_TRUE(says(read("kind = \"mie-gruneisen\"", "kind = \"porous\""), "kind"));
  EXPECT_TRUE(says(read("solid =", "solide ="), "solid"));
}

TEST(Porous, SaysWhatIsSuspiciousOfItsSolid) {
  const Read r = read("s = 1.489", "s = 4.5");
  ASSERT_TRUE(r.material) << r.out.text();
  const auto found = lint(*r.material);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].key, "eos.solid.s");
}

/// A start under pressure keeps its pores up to the elastic limit, and is refused beyond.
TEST(Porous, StartsUnderPressure) {
  const Material m = powder_material();
  const StartingState s = state_at_start(m, 0.1e9, std::nullopt, "target");
  EXPECT_NEAR(pressure(m.eos, s.density, s.energy), 0.1e9, 1);
  EXPECT_EQ(s.heat, 0);
  EXPECT_THROW(state_at_start(m, 0.2e9, std::nullopt, "target"), std::exception);
  const StartingState hot = state_at_start(m, std::nullopt, 500, "target");
  EXPECT_NEAR(TemperatureLaw(m.thermal, m.eos)(hot.density, hot.energy, 0), 500, 1e-6);
}

}  // namespace
}  // namespace recoil::eos_porous_test
