#pragma once

#include <array>
#include <cmath>

#include "core/series.hpp"
#include "material/parameter.hpp"
#include "material/strength/yield_state.hpp"

namespace recoil {

/// Johnson & Cook (1983):
///   Y = (a + b ep^n)(1 + c ln max(ep_rate/reference_rate, 1))(1 - T*^m),
///   T* = (T - reference)/(melting - reference), clamped to [0, 1]. c = 0 switches the rate term off.
struct JohnsonCook {
  double shear_modulus = unset;        // Pa
  double a = unset;                    // Pa, initial yield stress
  double b = unset;                    // Pa, hardening
  double n = unset;                    // hardening exponent
  double c = unset;                    // rate sensitivity
  double m = unset;                    // thermal softening exponent
  double melting_temperature = unset;  // K
  double reference_temperature = 298;  // K
  double reference_rate = 1;           // 1/s

  static constexpr const char* kind = "johnson-cook";
  static constexpr const char* doc = "Johnson-Cook: hardening, rate and thermal softening";
  static constexpr bool rate_dependent = true;

  static constexpr auto parameters() {
    using J = JohnsonCook;
    using P = Parameter<J>;
    return std::array{
        P{"shear-modulus", "Pa", &J::shear_modulus, 1, 1e13, "shear modulus"},
        P{"a", "Pa", &J::a, 0, 1e13, "initial yield stress"},
        P{"b", "Pa", &J::b, 0, 1e13, "hardening coefficient"},
        P{"n", "1", &J::n, 0.01, 5, "hardening exponent"},
        P{"c", "1", &J::c, 0, 1, "rate sensitivity; 0 switches the rate term off"},
        P{"m", "1", &J::m, 0.05, 20, "exponent of thermal softening"},
        P{"melting-temperature", "K", &J::melting_temperature, 200, 1e4, "temperature where strength ends"},
        P{"reference-temperature", "K", &J::reference_temperature, 1, 2000, "temperature of no softening"},
        P{"reference-rate", "1/s", &J::reference_rate, 1e-8, 1e8, "strain rate of the constants a and b"}};
  }

  /// What is wrong with the constants together; null: nothing.
  constexpr const char* problem() const {
    return melting_temperature <= reference_temperature
               ? "melting-temperature must exceed reference-temperature"
               : nullptr;
  }

  /// Factor of thermal softening, 1 at and below the reference temperature, 0 from melting on.
  double softening(double temperature) const {
    const double t = (temperature - reference_temperature) / (melting_temperature - reference_temperature);
    if (t >= 1) return 0;
    return t > 0 ? 1 - std::pow(t, m) : 1.0;
  }

  /// b ep^n [Pa].
  double hardening(double ep) const {
    if (!(ep > 0)) return 0;
    return b * (n == 1 ? ep : std::pow(ep, n));
  }

  /// Yield stress [Pa]. Rises with plastic strain and its rate; zero from the melting temperature on.
  double yield(const YieldState& s) const {
    const double rate = s.rate / reference_rate;
    const double rate_factor = c > 0 && rate > 1 ? 1 + c * std::log(rate) : 1.0;
    return (a + hardening(s.ep)) * rate_factor * softening(s.temperature);
  }

  struct Expansion {
    double yield, by_ep, by_log_rate;  // Pa
  };

  /// b ep^n at a plastic strain, from which that at one near it follows without a power.
  struct Hardened {
    double ep, grown;  // 1, Pa
  };
  Hardened hardened(double ep) const { return {ep, hardening(ep)}; }

  /// b (ep + more)^n [Pa]; below 1 % of ep without a power.
  double hardening(const Hardened& at, double more) const {
    if (n == 1) return at.grown + b * more;
    if (!(more < 0.01 * at.ep)) return hardening(at.ep + more);
    return at.grown * power_near_one(more / at.ep, n);
  }

  /// Yield stress and slopes before thermal softening, at ep > 0 and log_rate = ln(ep_rate/reference_rate).
  /// Convex in the logarithm of an increment of ep taken in a given time.
  Expansion expand(double ep, double log_rate) const { return expand(hardened(ep), 0, log_rate); }
  /// The same at ep + more.
  Expansion expand(const Hardened& at, double more, double log_rate) const {
    const double grown = hardening(at, more), ep = at.ep + more;
    const double slope = log_rate > 0 ? c : 0.0;
    const double rate_factor = 1 + slope * log_rate;
    return {(a + grown) * rate_factor, n * grown / ep * rate_factor, (a + grown) * slope};
  }
};

}  // namespace recoil
