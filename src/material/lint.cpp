#include "material/lint.hpp"

#include <cmath>
#include <cstdio>
#include <variant>

#include "material/detonation.hpp"

namespace recoil {

namespace {

using Findings = std::vector<Suspicion>;

std::string number(double x, const char* unit) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.4g%s%s", x, *unit ? " " : "", unit);
  return buffer;
}

/// What follows no rule of solids and liquids.
bool is_gas(const Material& m) { return !has_tension(m.eos) || std::holds_alternative<Jwl>(m.eos); }

/// Dulong and Petit: 3 R per mole of atoms. Without a molar mass the heat per volume decides, which for
/// solids lies within a factor of about two of 3 MJ/(m3 K).
void check_heat(const Material& m, Findings& out) {
  const double c = m.thermal.specific_heat;
  const std::string value = "specific heat " + number(c, "J/(kg K)");
  if (m.facts.molar_mass > 0) {
    const double expected = 3 * 8.314462618 / m.facts.molar_mass;
    if (c < 0.6 * expected || c > 1.7 * expected)
      out.push_back({value + " is " + number(c / expected, "") + " times the rule of Dulong and Petit",
                     "3 R/M is " + number(expected, "J/(kg K)") + "; are two materials exchanged?",
                     "thermal.specific-heat"});
  } else if (const double volumetric = c * solid_density(m); volumetric < 1.1e6 || volumetric > 5.5e6) {
    out.push_back({value + " is unusual for " + number(solid_density(m), "kg/m3"),
                   "c rho is " + number(volumetric / 1e6, "MJ/(m3 K)") + "; solids have 1.1 to 5.5",
                   "thermal.specific-heat"});
  }
}

/// Ceramics are as stiff as no metal of their density is; beryllium is like them.
bool is_ceramic(const Material& m) { return shear_modulus(m) > 100e9 && density(m) < 6000; }

/// Whether the strength is one of rock, sand or ceramics, which grows with the pressure.
bool is_of_rock(const Strength& strength) {
  return std::holds_alternative<DruckerPrager>(strength) || std::holds_alternative<Lundborg>(strength) ||
         std::holds_alternative<JohnsonHolmquist>(strength);
}

/// The least ratio that makes no remark. What the doubt of a material names is not said twice.
double least_poisson(const Material& m) {
  const bool metal = !is_ceramic(m) && !is_of_rock(m.strength) && !std::holds_alternative<Porous>(m.eos);
  return metal && m.doubt.find("Poisson's ratio") == std::string::npos ? 0.2 : 0.05;
}

void check_moduli(const Material& m, Findings& out) {
  const double g = shear_modulus(m);
  if (!(g > 0)) return;
  const double c0 = bulk_sound_speed(m), k = density(m) * c0 * c0;
  const double implied = (3 * k - 2 * g) / (6 * k + 2 * g);
  const std::string values = "shear modulus " + number(g / 1e9, "GPa") + " and bulk modulus rho c0^2 " +
                             number(k / 1e9, "GPa") + " give Poisson's ratio " + number(implied, "");
  if (implied < least_poisson(m) || implied > 0.49) {
    out.push_back({values, "metals have 0.2 to 0.45", "strength.shear-modulus"});
    return;
  }
  const double nu = m.facts.poisson_ratio;
  if (std::isnan(nu)) return;
  const double from_nu = 1.5 * k * (1 - 2 * nu) / (1 + nu);
  if (std::fabs(from_nu - g) > 0.12 * g)
    out.push_back({values + ", but poisson-ratio is " + number(nu, ""),
                   "that would need a shear modulus of " + number(from_nu / 1e9, "GPa"),
                   "facts.poisson-ratio"});
}

/// What the yield stress at rest is called in the model's own table.
const char* yield_key(const Material& m) {
  return std::visit(
      [](const auto& model) {
        if constexpr (requires { model.a, model.c; }) return "strength.a";
        if constexpr (requires { model.c1; }) return "strength.c0";
        if constexpr (requires { model.y0; }) return "strength.y0";
        if constexpr (requires { model.cohesion; }) return "strength.cohesion";
        return "strength.yield";
      },
      m.strength);
}

/// The ideal strength of a crystal is about G/(2 pi) (Frenkel 1926): half of G is no yield stress.
void check_yield(const Material& m, Findings& out) {
  const double t = m.thermal.initial_temperature;
  const double y = yield(m.strength, {.temperature = t});
  const double g = shear_modulus(m);
  if (!(g > 0) || std::isinf(y)) return;
  const bool impossible = y > 0.5 * g;
  if (y > (is_ceramic(m) ? 20e9 : 5e9) || y > 0.1 * g)
    out.push_back({"yield stress " + number(y / 1e9, "GPa") + " is implausible beside the shear modulus " +
                       number(g / 1e9, "GPa"),
                   "no metal exceeds about 5 GPa, no ceramic 20, neither a tenth of its shear modulus" +
                       (impossible ? ": is it " + number(y / 1e9, "MPa") + "?" : std::string()),
                   yield_key(m), impossible});
}

/// Foams begin at some 100 kg/m3, osmium has 22590 kg/m3. Without strength it may be a powder.
void check_density(const Material& m, Findings& out) {
  const double rho = density(m);
  if (!has_tension(m.eos)) return;  // a gas
  if (rho >= 100 && rho <= 23000) return;
  const bool from_grams = rho < 25;
  out.push_back({"density " + number(rho, "kg/m3") + " is that of no solid",
                 from_grams ? "is it " + number(rho, "g/cm3") + "?" : "solids have 100 to 23000 kg/m3",
                 "eos.density", from_grams && shear_modulus(m) > 0});
}

/// With tension matter fails sooner: the strain to failure falls as the triaxiality grows.
void check_damage(const Material& m, Findings& out) {
  const auto* d = std::get_if<JohnsonCookDamage>(&m.damage);
  if (d && d->d2 * d->d3 > 0)
    out.push_back(
        {"d3 " + number(d->d3, "") + " lets matter bear more strain the more it is pulled",
         "with triaxiality positive in tension d3 is negative for metals, e.g. d3 = " + number(-d->d3, ""),
         "damage.d3"});
}

void check_melting(const Material& m, Findings& out) {
  const double melting = melting_temperature(m.strength, 1);
  if (m.thermal.initial_temperature >= melting)
    out.push_back({"initial temperature " + number(m.thermal.initial_temperature, "K") +
                       " is not below the melting temperature " + number(melting, "K"),
                   "the material starts without strength", "strength.melting-temperature"});
}

void check_slope(const Material& m, double s, const char* key, Findings& out) {
  const double most = shear_modulus(m) > 0 ? 2.2 : 2.7;
  if (s < 0.8 || s > most)
    out.push_back({"slope s " + number(s, "") + " of the Hugoniot is unusual",
                   "solids have 0.8 to 2.2, liquids at most 2.7", key});
}

void check_gamma0(double gamma0, const char* key, Findings& out) {
  if (gamma0 < 0.3 || gamma0 > 3.5)
    out.push_back({"gamma0 " + number(gamma0, "") + " is unusual", "solids have 0.3 to 3.5", key});
}

void check_eos(const Material& /*m*/, const LinearEos& /*eos*/, Findings& /*out*/) {}
void check_eos(const Material& /*m*/, const PolynomialEos& /*eos*/, Findings& /*out*/) {}
void check_eos(const Material& /*m*/, const Tabular& /*eos*/, Findings& /*out*/) {}
void check_eos(const Material& m, const Porous& eos, Findings& out);

void check_eos(const Material& m, const MieGruneisen& eos, Findings& out) {
  check_slope(m, eos.s, "eos.s", out);
  check_gamma0(eos.gamma0, "eos.gamma0", out);
}

void check_eos(const Material& m, const MieGruneisenCubic& eos, Findings& out) {
  check_slope(m, eos.s1, "eos.s1", out);
  check_gamma0(eos.gamma0, "eos.gamma0", out);
  if (!(eos.sublimation > 0)) return;
  const double by_sound = eos.c0 * eos.c0 / eos.gamma0;
  if (eos.sublimation < 0.25 * by_sound || eos.sublimation > 1.5 * by_sound)
    out.push_back({"sublimation-energy " + number(eos.sublimation / 1e6, "MJ/kg") + " is " +
                       number(eos.sublimation / by_sound, "") + " times c0^2/gamma0",
                   "metals have 0.4 to 1.0; is it given per mole?", "eos.sublimation-energy"});
}

/// Near rest p = A mu + B mu^2 is a Hugoniot of slope s = (1 + B/A)/2.
void check_eos(const Material& m, const Tillotson& eos, Findings& out) {
  check_slope(m, 0.5 * (1 + eos.bulk_b / eos.bulk_a), "eos.bulk-curvature", out);
  check_gamma0(eos.a + eos.b, "eos.b", out);
}

/// Of an ideal gas the specific heat follows from the state at rest: p = (gamma - 1) rho c_v T.
void check_eos(const Material& m, const IdealGas& eos, Findings& out) {
  if (eos.p_inf > 0) return;
  const double c = eos.p0 / ((eos.gamma - 1) * eos.rho0 * m.thermal.initial_temperature);
  if (std::fabs(m.thermal.specific_heat - c) > 0.05 * c)
    out.push_back({"specific heat " + number(m.thermal.specific_heat, "J/(kg K)") +
                       " contradicts pressure, density and temperature at rest",
                   "an ideal gas with these has " + number(c, "J/(kg K)"), "thermal.specific-heat"});
}

void check_eos(const Material& /*m*/, const Jwl& eos, Findings& out) {
  const double d = chapman_jouguet(eos).velocity;
  if (std::fabs(d - eos.detonation_velocity) > 0.02 * eos.detonation_velocity)
    out.push_back({"detonation-velocity " + number(eos.detonation_velocity, "m/s") +
                       " is not what the other constants give",
                   "they give " + number(d, "m/s"), "eos.detonation-velocity"});
}

/// Its solid, and how much of it there is.
void check_eos(const Material& m, const Porous& eos, Findings& out) {
  const std::size_t before = out.size();
  std::visit([&](const auto& solid) { check_eos(m, solid, out); }, eos.solid);
  for (std::size_t k = before; k < out.size(); ++k)
    if (out[k].key.starts_with("eos.")) out[k].key.insert(4, "solid.");
  if (eos.alpha0 > 10)
    out.push_back({"distension " + number(eos.alpha0, "") + " is that of a foam",
                   "the model knows crushed pores, no foam; solids in powders have 1 to 3", "eos.density"});
}

}  // namespace

std::vector<Suspicion> lint(const Material& material) {
  Findings out;
  check_density(material, out);
  if (!out.empty() && out[0].certain) return out;  // the others would only follow from that
  if (!is_gas(material)) check_heat(material, out);
  check_moduli(material, out);
  check_yield(material, out);
  check_damage(material, out);
  check_melting(material, out);
  std::visit([&](const auto& eos) { check_eos(material, eos, out); }, material.eos);
  return out;
}

}  // namespace recoil
