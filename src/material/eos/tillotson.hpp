#pragma once

#include <array>
#include <cmath>

#include "material/eos/density_range.hpp"
#include "material/eos/quick_exp.hpp"
#include "material/parameter.hpp"

namespace recoil {

/// Tillotson (General Atomic GA-3216, 1962), as in H. J. Melosh, Impact Cratering (1989), appendix II. With
/// mu = rho/rho0 - 1, z = rho0/rho - 1, w = e0 (rho/rho0)^2:
///   compressed, or colder than e_iv:     p_c = (a + b w/(e + w)) rho e + A mu + B mu^2
///   expanded and hotter than e_cv:       p_e = a rho e + (b w/(e + w) rho e + A mu exp(-beta z)) exp(-alpha
///   z^2) expanded, e_iv < e < e_cv:           p = p_c + (p_e - p_c)(e - e_iv)/(e_cv - e_iv)
/// The sound speed jumps where one form ends. e is zero at rest.
struct Tillotson {
  double rho0 = unset;                    // kg/m3
  double a = unset, b = unset;            // 1
  double bulk_a = unset, bulk_b = unset;  // Pa, A and B
  double e0 = unset;                      // J/kg
  double alpha = unset, beta = unset;     // 1
  double e_iv = unset, e_cv = unset;      // J/kg

  static constexpr const char* kind = "tillotson";
  static constexpr const char* doc = "Tillotson: from compression to vapour";
  static constexpr bool barotropic = false;
  static constexpr DensityRange range{0.001, 5};

  static constexpr auto parameters() {
    using T = Tillotson;
    using P = Parameter<T>;
    return std::array{
        P{"density", "kg/m3", &T::rho0, 1, 3e4, "density at rest"},
        P{"a", "1", &T::a, 0.1, 2, "Grueneisen coefficient of hot thin vapour"},
        P{"b", "1", &T::b, 0, 5, "a + b is the Grueneisen coefficient at rest"},
        P{"bulk-modulus", "Pa", &T::bulk_a, 1e8, 1e13, "A, bulk modulus at rest"},
        P{"bulk-curvature", "Pa", &T::bulk_b, 0, 1e13, "B, factor of the square of compression"},
        P{"e0", "J/kg", &T::e0, 1e5, 1e10, "energy at which the Grueneisen coefficient falls"},
        P{"alpha", "1", &T::alpha, 0.1, 50, "decay of the condensed part with expansion"},
        P{"beta", "1", &T::beta, 0.1, 50, "decay of the cold part with expansion"},
        P{"e-iv", "J/kg", &T::e_iv, 1e4, 1e9, "energy of incipient vaporisation"},
        P{"e-cv", "J/kg", &T::e_cv, 1e4, 1e9, "energy of complete vaporisation"}};
  }

  /// What is wrong with the constants together; null: nothing.
  constexpr const char* problem() const { return e_cv <= e_iv ? "e-cv must exceed e-iv" : nullptr; }

  /// Pressure [Pa] at density rho [kg/m3] and specific internal energy e [J/kg].
  constexpr double pressure(double rho, double e) const { return by_energy(at(rho), e).pressure; }

  /// Specific internal energy [J/kg] at density rho and pressure p [Pa]: a root of a quadratic in the pure
  /// forms, Newton's method between them.
  double energy(double rho, double p) const {
    const Place d = at(rho);
    const double cold = root(d, 1, d.compressed, p), hot = root(d, d.fade, d.thin, p);
    const double low = by_energy(d, e_iv).pressure, high = by_energy(d, e_cv).pressure;
    double e = between(e_iv + (e_cv - e_iv) * (p - low) / (high - low));
    for (int i = 0; i < 6; ++i) {
      const Value v = by_energy(d, e);
      e = between(e - (v.pressure - p) / v.by_energy);
    }
    e = cold < e_iv ? cold : e;
    e = hot > e_cv ? hot : e;
    return rho >= rho0 ? cold : e;
  }

  /// (dp/drho) at constant entropy [m2/s2]. No floor: negative where the state is unstable.
  double sound_speed_squared(double rho, double p) const {
    const double e = energy(rho, p);
    const Place d = at(rho);
    const double part = part_of(d, e), q = d.w / (e + d.w);
    const double thermal = a * e + b * e * (q + 2 * q * e / (e + d.w)) * (1 + part * (d.fade - 1)) +
                           part * b * q * rho * e * d.fade_slope;
    const double fixed = d.compressed_slope + part * (d.thin_slope - d.compressed_slope);
    return thermal + fixed + p / (rho * rho) * by_energy(d, e).by_energy;
  }

  constexpr bool admissible(double rho) const { return rho > 0; }
  /// Its vapour goes on expanding.
  static constexpr bool evaporates() { return true; }
  constexpr double largest_density() const { return infinite; }

 private:
  /// What depends on density alone.
  struct Place {
    double rho, w;                        // kg/m3, J/kg
    double compressed, compressed_slope;  // Pa, m2/s2: the parts of p_c and p_e without energy
    double thin, thin_slope;
    double fade, fade_slope;  // exp(-alpha z^2), m3/kg
    bool expanded;
  };
  struct Value {
    double pressure, by_energy;  // Pa, kg/m3
  };

  constexpr Place at(double rho) const {
    const double eta = rho / rho0, mu = eta - 1, z = eta < 1 ? 1 / eta - 1 : 0.0;
    const double dz = -rho0 / (rho * rho);
    Place d{};
    d.rho = rho;
    d.w = e0 * eta * eta;
    d.compressed = mu * (bulk_a + bulk_b * mu);
    d.compressed_slope = (bulk_a + 2 * bulk_b * mu) / rho0;
    d.fade = quick_exp(-alpha * z * z);
    d.fade_slope = -2 * alpha * z * dz * d.fade;
    const double cold = bulk_a * quick_exp(-beta * z);
    d.thin = mu * cold * d.fade;
    d.thin_slope = cold * (d.fade * (1 / rho0 - mu * beta * dz) + mu * d.fade_slope);
    d.expanded = eta < 1;
    return d;
  }

  constexpr double between(double e) const { return e < e_iv ? e_iv : e > e_cv ? e_cv : e; }

  /// The part of the vapour's form.
  constexpr double part_of(const Place& d, double e) const {
    return d.expanded ? (between(e) - e_iv) / (e_cv - e_iv) : 0.0;
  }

  constexpr Value by_energy(const Place& d, double e) const {
    const double part = part_of(d, e), q = d.w / (e + d.w);
    const double scale = 1 + part * (d.fade - 1);
    const bool mixing = d.expanded && e > e_iv && e < e_cv;
    const double by_part = b * d.rho * e * q * (d.fade - 1) + d.thin - d.compressed;
    return {d.rho * e * (a + b * q * scale) + d.compressed + part * (d.thin - d.compressed),
            d.rho * (a + b * q * q * scale) + (mixing ? by_part / (e_cv - e_iv) : 0.0)};
  }

  /// The energy > -w where a rho e + scale b w/(e + w) rho e + fixed is p.
  double root(const Place& d, double scale, double fixed, double p) const {
    const double excess = p - fixed, linear = (a + scale * b) * d.rho * d.w - excess;
    const double square = std::sqrt(linear * linear + 4 * a * d.rho * d.w * excess);
    // The form of the quadratic's root in which nothing cancels.
    return linear > 0 ? 2 * excess * d.w / (linear + square) : (square - linear) / (2 * a * d.rho);
  }
};

/// Bulk sound speed at rest [m/s].
inline double bulk_sound_speed(const Tillotson& eos) { return std::sqrt(eos.bulk_a / eos.rho0); }

}  // namespace recoil
