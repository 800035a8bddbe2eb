#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "material/parameter.hpp"
#include "material/strength/yield_state.hpp"

namespace recoil {

/// Preston, Tonks & Wallace, J. Appl. Phys. 93 (2003) 211: flow stress Y = 2 tau G from 1e-3 to 1e12 1/s,
/// thermal activation at low rates, an overdriven power law at high ones, hardening that saturates between
/// tau_y and tau_s. T in units of the melting temperature, the rate in units of the time that a transverse
/// wave takes to cross an atom, r = 1/2 (4 pi rho/(3 M))^(1/3) sqrt(G/rho). Shear modulus, density and
/// melting temperature are those at rest, in every state; in the source they follow density and temperature,
/// which counts behind strong shocks. Rates below 1e-3 1/s count as that.
struct PrestonTonksWallace {
  double shear_modulus = unset;         // Pa
  double density = unset;               // kg/m3
  double atomic_mass = unset;           // kg/mol
  double melting_temperature = unset;   // K
  double theta = unset, p = unset;      // hardening
  double s0 = unset, s_inf = unset;     // saturation at 0 K, near melting
  double kappa = unset, gamma = unset;  // dependence on temperature and rate
  double y0 = unset, y_inf = unset;     // yield at 0 K, near melting
  double y1 = unset, y2 = unset;        // yield at medium rates
  double beta = unset;                  // exponent at high rates

  static constexpr const char* kind = "preston-tonks-wallace";
  static constexpr const char* doc = "Preston-Tonks-Wallace: plastic flow up to the highest rates";
  static constexpr bool rate_dependent = true;

  static constexpr auto parameters() {
    using W = PrestonTonksWallace;
    using P = Parameter<W>;
    return std::array{
        P{"shear-modulus", "Pa", &W::shear_modulus, 1, 1e13, "shear modulus at rest, kept in every state"},
        P{"density", "kg/m3", &W::density, 100, 3e4, "density at rest, for the unit of the rate"},
        P{"atomic-mass", "kg/mol", &W::atomic_mass, 1e-3, 0.3, "molar mass of the atoms"},
        P{"melting-temperature", "K", &W::melting_temperature, 50, 1e4, "unit of the temperature"},
        P{"theta", "1", &W::theta, 1e-6, 1, "hardening rate at the start"},
        P{"p", "1", &W::p, 0, 20, "how hardening falls with strain; 0: Voce's law"},
        P{"s0", "1", &W::s0, 1e-6, 1, "saturation stress at 0 K"},
        P{"s-inf", "1", &W::s_inf, 0, 1, "saturation stress near melting"},
        P{"kappa", "1", &W::kappa, 0, 10, "factor of the thermal terms"},
        P{"gamma", "1", &W::gamma, 1e-12, 1, "factor of the rate"},
        P{"y0", "1", &W::y0, 0, 1, "yield stress at 0 K"},
        P{"y-inf", "1", &W::y_inf, 0, 1, "yield stress near melting"},
        P{"y1", "1", &W::y1, 0, 10, "yield stress at medium rates"},
        P{"y2", "1", &W::y2, 0, 5, "its exponent"},
        P{"beta", "1", &W::beta, 0.01, 2, "exponent of the rate where the flow is overdriven"}};
  }

  /// What is wrong with the constants together; null: nothing.
  constexpr const char* problem() const {
    if (s_inf > s0 || y_inf > y0) return "stresses near melting must not exceed those at 0 K";
    return y0 > s0 || y_inf > s_inf ? "yield must not exceed saturation: y0 <= s0, y-inf <= s-inf" : nullptr;
  }

  /// The unit of the rate [1/s].
  double unit_rate() const {
    constexpr double avogadro = 6.02214076e23;
    const double per_atom = 4 * std::numbers::pi * density * avogadro / (3 * atomic_mass);
    return 0.5 * std::cbrt(per_atom) * std::sqrt(shear_modulus / density);
  }

  double yield(const YieldState& s) const {
    const double t = s.temperature / melting_temperature;
    if (t >= 1) return 0;
    const double x = std::max(s.rate, 1e-3) / (gamma * unit_rate());  // rate over gamma xi
    const double thermal = std::erf(std::max(-kappa * t * std::log(x), 0.0));
    const double overdriven = s0 * std::pow(x, beta);
    const double saturation = std::max(s0 - (s0 - s_inf) * thermal, overdriven);
    const double start = std::max(y0 - (y0 - y_inf) * thermal, std::min(y1 * std::pow(x, y2), overdriven));
    return 2 * shear_modulus * hardened(s.ep, start, saturation);
  }

 private:
  double hardened(double ep, double start, double saturation) const {
    const double room = saturation - start;
    if (!(room > 0)) return saturation;
    if (p == 0) return saturation - room * std::exp(-theta * ep / room);
    const double scale = s0 - start, full = p * room / scale;
    const double left = -std::expm1(-full) * std::exp(-p * theta * ep / (scale * std::expm1(full)));
    return saturation + scale / p * std::log1p(-left);
  }
};

}  // namespace recoil
