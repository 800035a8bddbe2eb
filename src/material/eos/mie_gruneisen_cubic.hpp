#pragma once

#include <array>
#include <cmath>

#include "material/eos/density_range.hpp"
#include "material/eos/quick_exp.hpp"
#include "material/parameter.hpp"

namespace recoil {

/// Mie-Grueneisen on a curved Hugoniot, in the form of Steinberg (UCRL-MA-106439, 1996): with w = u_p/U_s
///   U_s = c0 + (s1 + s2 w + s3 w^2) u_p,   Gamma rho = rho0 (gamma0 + a mu),  mu = rho/rho0 - 1.
/// Across the shock w = 1 - rho0/rho, so the pressure on the Hugoniot is closed, p_H = rho0 c0^2 w/(1 - s1 w
/// - s2 w^2 - s3 w^3)^2; with u_p in place of w a root would have to be found in every cell. Expanded: Gamma
/// = gamma0 and, about the isentrope through rest, Morse's potential (Phys. Rev. 34 (1929) 57) in the volume
/// x = rho0/rho, with the bulk modulus of the Hugoniot and its slope 4 s1 - 1 at rest:
///   e_s = c0^2/(2 k^2) (1 - y)^2,  p_s = -rho0 c0^2/k (1 - y) y,  y = exp(-k (x - 1)),  k = 4 s1/3.
/// So tension ends at rho0 c0^2/(4 k), and thin hot matter is a gas; a straight cold curve does neither.
/// That gas costs c0^2/(2 k^2) = 9 c0^2/(32 s1^2), of metals 0.3 to 0.7 of what evaporates them.
/// With `sublimation`, e_v, the expanded branch is that of the PUFF codes (McCloskey 1964; Bakken & Anderson
/// 1967),
///   Gamma = h + (gamma0 - h) sqrt(rho/rho0),  p = Gamma rho (e - e_v (1 - exp(-n (z + b z^2)))),
///   z = rho0/rho - 1,  n = c0^2/(gamma0 e_v),
/// a gas of gamma = 1 + h far out. There b is 1; here it gives the bulk modulus of the isentrope through rest
/// the slope 4 s1 - 1 on this side too: 0.1 to 1.1 for metals (and 0 where it would be less).
struct MieGruneisenCubic {
  double rho0 = unset;         // kg/m3
  double c0 = unset;           // m/s, bulk sound speed at rho0
  double s1 = unset;           // slope of the Hugoniot at rest
  double s2 = 0, s3 = 0;       // its curvature
  double gamma0 = unset;       // Grueneisen coefficient at rho0
  double a = 0;                // its change with compression
  double sublimation = 0;      // J/kg, that of matter at rest; 0: Morse's potential
  double vapour_gamma = 0.25;  // Grueneisen coefficient of its vapour

  static constexpr const char* kind = "mie-gruneisen-cubic";
  static constexpr const char* doc =
      "Mie-Grueneisen on a curved Hugoniot (Steinberg's s1, s2, s3), with an expanded branch that ends";
  static constexpr bool barotropic = false;
  /// The denominator of p_H is kept from going below this; states beyond are not admissible().
  static constexpr double guard = 0.1;

  static constexpr auto parameters() {
    using M = MieGruneisenCubic;
    using P = Parameter<M>;
    return std::array{
        P{"density", "kg/m3", &M::rho0, 1, 3e4, "density at rest"},
        P{"c0", "m/s", &M::c0, 10, 2e4, "bulk sound speed at rest"},
        P{"s1", "1", &M::s1, 0.1, 5, "slope of shock speed over particle speed at rest"},
        P{"s2", "1", &M::s2, -10, 10, "change of that slope with u_p/U_s"},
        P{"s3", "1", &M::s3, -10, 10, "change with the square of u_p/U_s"},
        P{"gamma0", "1", &M::gamma0, 0.01, 5, "Grueneisen coefficient at rest"},
        P{"a", "1", &M::a, -2, 5, "change of Gamma rho/rho0 with rho/rho0"},
        P{"sublimation-energy", "J/kg", &M::sublimation, 0, 1e9,
          "energy that turns it at rest into vapour; 0: Morse's potential when expanded"},
        P{"vapour-gamma", "1", &M::vapour_gamma, 0.01, 2, "Grueneisen coefficient of its vapour"}};
  }

  /// Whether it has a vapour that goes on expanding.
  constexpr bool evaporates() const { return sublimation > 0; }
  constexpr DensityRange range() const { return {evaporates() ? 0.001 : 0.1, 2.5}; }

  /// Pressure [Pa] at density rho [kg/m3] and specific internal energy e [J/kg], which is zero at rest.
  double pressure(double rho, double e) const { return gamma_rho(rho) * e + cold(rho); }

  /// Specific internal energy [J/kg] at density rho and pressure p [Pa].
  double energy(double rho, double p) const { return (p - cold(rho)) / gamma_rho(rho); }

  /// (dp/drho) at constant entropy [m2/s2]. No floor: negative where the state is unstable.
  double sound_speed_squared(double rho, double p) const {
    const double g = gamma_rho(rho);
    const double e = (p - cold(rho)) / g;
    return cold_slope(rho) + gamma_rho_slope(rho) * e + g * p / (rho * rho);
  }

  /// Whether the Hugoniot reaches this density, and rises there.
  constexpr bool admissible(double rho) const {
    const double w = 1 - rho0 / rho, d = denominator(w);
    return rho > 0 && (w <= 0 || (d > guard && d + 2 * w * steepness(w) > 0));
  }

  /// The least density that is not admissible (infinite if all are).
  constexpr double largest_density() const {
    constexpr int parts = 500;
    for (int i = 1; i < parts; ++i) {
      double low = rho0 / (1 - static_cast<double>(i - 1) / parts);
      double high = rho0 / (1 - static_cast<double>(i) / parts);
      if (admissible(high)) continue;
      for (int k = 0; k < 50; ++k) {
        const double middle = 0.5 * (low + high);
        (admissible(middle) ? low : high) = middle;
      }
      return high;
    }
    return infinite;
  }

  /// The pressure where e = 0 [Pa].
  double cold(double rho) const {
    const double w = 1 - rho0 / rho, d = guarded(denominator(w)), g = gamma0 + a * (rho / rho0 - 1);
    const double compressed = rho0 * c0 * c0 * w * (1 - 0.5 * g * w) / (d * d);
    if (evaporates()) return w >= 0 ? compressed : -gamma_rho(rho) * bond(w).energy;
    const Isentrope at = isentrope(w);
    return w >= 0 ? compressed : at.pressure - gamma0 * rho * at.energy;
  }

  /// The slope of cold() [m2/s2].
  double cold_slope(double rho) const {
    const double x = rho0 / rho, w = 1 - x, d = guarded(denominator(w)), g = gamma0 + a * (rho / rho0 - 1);
    const double by_w = ((1 - g * w) * d + 2 * w * steepness(w) * (1 - 0.5 * g * w)) / (d * d * d);
    const double compressed = c0 * c0 * (by_w * x * x - 0.5 * a * w * w / (d * d));
    return w >= 0 ? compressed : expanded_slope(rho, x, w);
  }

 private:
  /// Gamma rho [kg/m3].
  double gamma_rho(double rho) const {
    const double expanded =
        evaporates() ? (vapour_gamma + (gamma0 - vapour_gamma) * root(rho)) * rho : gamma0 * rho;
    return rho >= rho0 ? rho0 * gamma0 + a * (rho - rho0) : expanded;
  }
  /// Its slope.
  double gamma_rho_slope(double rho) const {
    const double expanded = evaporates() ? vapour_gamma + 1.5 * (gamma0 - vapour_gamma) * root(rho) : gamma0;
    return rho >= rho0 ? a : expanded;
  }
  double root(double rho) const { return std::sqrt(rho > 0 ? rho / rho0 : 0.0); }
  constexpr double denominator(double w) const { return 1 - w * (s1 + w * (s2 + w * s3)); }
  /// The slope of -denominator().
  constexpr double steepness(double w) const { return s1 + w * (2 * s2 + 3 * w * s3); }
  static constexpr double guarded(double d) { return d > guard ? d : guard; }

  /// @param x rho0/rho, w 1 - x < 0
  double expanded_slope(double rho, double x, double w) const {
    if (evaporates()) {
      const Bond at = bond(w);
      return -gamma_rho_slope(rho) * at.energy - gamma_rho(rho) * at.slope * x / rho;
    }
    const Isentrope at = isentrope(w);
    return at.slope * x * x - gamma0 * (at.energy + at.pressure / rho);
  }

  /// Morse's isentrope through rest, expanded: w = 1 - rho0/rho <= 0. The slope is -dp/dx / rho0 [m2/s2].
  struct Isentrope {
    double pressure, energy, slope;
  };
  constexpr Isentrope isentrope(double w) const {
    const double k = 4 * s1 / 3, y = quick_exp(w < 0 ? k * w : 0.0), c2 = c0 * c0;
    return {-rho0 * c2 / k * (1 - y) * y, 0.5 * c2 / (k * k) * (1 - y) * (1 - y), c2 * y * (2 * y - 1)};
  }

  /// The energy without pressure, e_v (1 - exp(-n (z + b z^2))) [J/kg], at z = -w >= 0, and its slope by w.
  struct Bond {
    double energy, slope;
  };
  constexpr Bond bond(double w) const {
    const double n = c0 * c0 / (gamma0 * sublimation);
    const double wanted = 0.5 * (n + gamma0 - vapour_gamma / gamma0) + 1.5 - 2 * s1,
                 b = wanted > 0 ? wanted : 0.0;
    const double z = w < 0 ? -w : 0.0, y = quick_exp(-n * z * (1 + b * z));
    return {sublimation * (1 - y), -sublimation * n * (1 + 2 * b * z) * y};
  }
};

/// Bulk sound speed at rest [m/s].
constexpr double bulk_sound_speed(const MieGruneisenCubic& eos) { return eos.c0; }

}  // namespace recoil
