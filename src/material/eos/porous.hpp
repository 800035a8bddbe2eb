#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "material/eos/density_range.hpp"
#include "material/eos/linear.hpp"
#include "material/eos/mie_gruneisen.hpp"
#include "material/eos/mie_gruneisen_cubic.hpp"
#include "material/eos/polynomial.hpp"
#include "material/eos/tabular.hpp"
#include "material/eos/tillotson.hpp"
#include "material/parameter.hpp"

namespace recoil {

/// What the grains of porous matter may be.
using PorousSolid =
    std::variant<MieGruneisen, LinearEos, MieGruneisenCubic, Tillotson, PolynomialEos, Tabular>;

/// Porous matter of a fixed distension alpha, the density of its solid over its own. The pores bear nothing,
/// so with the solid's own equation of state p_s
///   p(rho, e) = p_s(alpha rho, e)/alpha
/// (W. Herrmann, J. Appl. Phys. 40 (1969) 2490, with the factor 1/alpha of M. M. Carroll & A. C. Holt,
/// J. Appl. Phys. 43 (1972) 759). At a fixed alpha its isentropes are those of the solid, for p d(1/rho) is
/// p_s d(1/rho_s), and so is the speed of sound.
struct PorousState {
  const PorousSolid& solid;
  double alpha;                             // >= 1
  double rho0;                              // kg/m3, without pressure at this alpha
  double rho0_solid;                        // kg/m3
  DensityRange range;                       // as parts of rho0
  static constexpr bool barotropic = true;  // see Porous

  /// Density of the solid [kg/m3]; that at rest to the bit.
  double compacted(double rho) const { return rho / rho0 * rho0_solid; }

  double pressure(double rho, double e) const {
    return std::visit([&](const auto& m) { return m.pressure(compacted(rho), e) / alpha; }, solid);
  }
  double energy(double rho, double p) const {
    return std::visit([&](const auto& m) { return m.energy(compacted(rho), p * alpha); }, solid);
  }
  double sound_speed_squared(double rho, double p) const {
    return std::visit([&](const auto& m) { return m.sound_speed_squared(compacted(rho), p * alpha); }, solid);
  }
  bool admissible(double rho) const {
    return std::visit([&](const auto& m) { return m.admissible(compacted(rho)); }, solid);
  }
  double largest_density() const {
    return std::visit([](const auto& m) { return m.largest_density(); }, solid) / alpha;
  }
};

/// Bulk sound speed without pressure [m/s]: that of the solid.
inline double bulk_sound_speed(const PorousState& eos) {
  return std::visit([](const auto& m) { return bulk_sound_speed(m); }, eos.solid);
}

/// Porous matter: the P-alpha model. Up to the crush curve
///   p = p_s - (p_s - p_e) ((alpha - 1)/(alpha0 - 1))^(1/n),
/// which is alpha = 1 + (alpha0 - 1) ((p_s - p)/(p_s - p_e))^n, alpha keeps its value, loading and unloading
/// alike; on the curve it falls, and never rises again. What is carried with the matter is alpha0 - alpha,
/// 0 at rest (Components::crushed).
/// The solid may be barotropic or not: `extra` is always kept, and is zero where the pressure knows the
/// energy.
struct Porous {
  double rho0 = unset;           // kg/m3, with its pores
  double elastic_limit = unset;  // Pa, p_e
  double compaction = unset;     // Pa, p_s
  double exponent = 2;           // n
  PorousSolid solid = {};
  double alpha0 = 1;          // by settle()
  double rho0_solid = unset;  // kg/m3, by settle()
  DensityRange range = {};    // by settle()

  static constexpr const char* kind = "porous";
  static constexpr const char* doc = "porous matter, P-alpha: a solid whose pores are crushed";
  static constexpr bool barotropic = true;

  static constexpr auto parameters() {
    using P = Parameter<Porous>;
    return std::array{
        P{"density", "kg/m3", &Porous::rho0, 1, 3e4, "density at rest, with the pores"},
        P{"elastic-limit", "Pa", &Porous::elastic_limit, 0, 1e12, "pressure at which pores begin to crush"},
        P{"compaction-pressure", "Pa", &Porous::compaction, 1, 1e12, "pressure at which no pores are left"},
        P{"exponent", "1", &Porous::exponent, 1, 10, "of the crush curve"}};
  }

  /// Takes over what follows from the solid, once it is complete.
  /// @returns what is wrong with the constants together; null: nothing.
  const char* settle() {
    rho0_solid = std::visit([](const auto& m) { return m.rho0; }, solid);
    alpha0 = rho0_solid / rho0;
    const DensityRange own = std::visit([](const auto& m) { return density_range(m); }, solid);
    range = {own.least, own.most * alpha0};
    if (!(alpha0 > 1)) return "the density of porous matter must be below that of its solid";
    if (!(compaction > elastic_limit)) return "compaction-pressure must exceed elastic-limit";
    return nullptr;
  }

  /// Whether its solid has a vapour that goes on expanding.
  bool evaporates() const {
    return std::visit(
        [](const auto& m) {
          if constexpr (requires { m.evaporates(); })
            return m.evaporates();
          else
            return false;
        },
        solid);
  }

  /// alpha of matter that has lost `crushed` of its distension: what rounding leaves beyond its bounds is
  /// cut.
  double distension(double crushed) const { return std::clamp(alpha0 - crushed, 1.0, alpha0); }

  PorousState frozen(double crushed) const {
    const double alpha = distension(crushed);
    const double rest = crushed > 0 ? rho0_solid / alpha : rho0;
    return {solid, alpha, rest, rho0_solid, {range.least, range.most / alpha0}};
  }

  /// How much of its distension matter has lost that is brought to rho [kg/m3] and e [J/kg], and had lost
  /// `crushed` before: where its pressure would be beyond the crush curve, what puts it there. By false
  /// position (Illinois) in t = ((alpha - 1)/(alpha0 - 1))^(1/n), over which the curve is straight; the
  /// pressure holds to 1e-13 p_s.
  double crush(double rho, double e, double crushed) const {
    const double before = distension(crushed);
    if (!(before > 1)) return crushed;
    const auto lost = [&](double t) { return (alpha0 - 1) * (1 - std::pow(t, exponent)); };
    const auto excess = [&](double t) {
      return frozen(lost(t)).pressure(rho, e) - (compaction - (compaction - elastic_limit) * t);
    };
    if (!(frozen(crushed).pressure(rho, e) > elastic_limit)) return crushed;
    double low = 0, high = std::pow((before - 1) / (alpha0 - 1), 1 / exponent), at_high = excess(high);
    if (!(at_high > 0)) return crushed;
    double at_low = excess(low);
    if (at_low >= 0) return alpha0 - 1;
    double t = high;
    for (int i = 0, kept = 0; i < 100 && high - low > 1e-15; ++i) {
      t = (low * at_high - high * at_low) / (at_high - at_low);
      const double at = excess(t);
      if (std::fabs(at) <= 1e-13 * compaction) break;
      const int side = at > 0 ? 1 : -1;
      (at > 0 ? high : low) = t;
      (at > 0 ? at_high : at_low) = at;
      if (side == kept) (at > 0 ? at_low : at_high) *= 0.5;
      kept = side;
    }
    return std::max(crushed, lost(t));
  }

  // At rest, with all of its pores: for what knows of no state, such as tables and searches.
  double pressure(double rho, double e) const { return frozen(0).pressure(rho, e); }
  double energy(double rho, double p) const { return frozen(0).energy(rho, p); }
  double sound_speed_squared(double rho, double p) const { return frozen(0).sound_speed_squared(rho, p); }
  bool admissible(double rho) const { return frozen(0).admissible(rho); }
  /// Of any distension.
  double largest_density() const {
    return std::visit([](const auto& m) { return m.largest_density(); }, solid);
  }
};

/// Bulk sound speed at rest [m/s]: the solid's, for pores are not crushed by sound.
inline double bulk_sound_speed(const Porous& eos) { return bulk_sound_speed(eos.frozen(0)); }

}  // namespace recoil
