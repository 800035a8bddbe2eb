#pragma once

#include <array>
#include <cmath>

#include "material/parameter.hpp"
#include "material/strength/yield_state.hpp"

namespace recoil {

/// Johnson & Holmquist, An improved computational constitutive model for brittle materials, AIP Conf. Proc.
/// 309 (1994) 981 ("JH-2"). With p* = p/p_HEL, T* = T/p_HEL and s_HEL = 3/2 (HEL - p_HEL):
///   intact     s_i = a (p* + T*)^n (1 + c ln(rate/reference_rate)) s_HEL,
///   fractured  s_f = b p*^m (1 + c ln(rate/reference_rate)) s_HEL, at most most_fractured s_HEL,
///   Y = s_i - D (s_i - s_f).
/// Both are zero where their base is not positive, and rates below the reference count as it. D is that of
/// the step before.
struct JohnsonHolmquist {
  double shear_modulus = unset;  // Pa
  double a = unset, n = unset;   // 1, of the intact strength
  double b = unset, m = unset;   // 1, of the fractured one
  double c = 0;                  // 1, rate sensitivity
  double tension = unset;        // Pa, T
  double hel = unset;            // Pa, stress at the Hugoniot elastic limit
  double hel_pressure = unset;   // Pa, pressure there
  double most_fractured = 1000;  // 1, of s_HEL
  double reference_rate = 1;     // 1/s

  static constexpr const char* kind = "johnson-holmquist";
  static constexpr const char* doc =
      "Johnson-Holmquist 2: ceramics that go from intact to fractured strength";
  static constexpr bool rate_dependent = true;
  static constexpr bool temperature_dependent = false;
  static constexpr bool pressure_dependent = true;
  static constexpr bool damage_dependent = true;

  static constexpr auto parameters() {
    using J = JohnsonHolmquist;
    using P = Parameter<J>;
    return std::array{
        P{"shear-modulus", "Pa", &J::shear_modulus, 1, 1e13, "shear modulus"},
        P{"a", "1", &J::a, 0, 10, "intact strength, in that at the elastic limit"},
        P{"n", "1", &J::n, 0.01, 5, "exponent of the intact strength over pressure"},
        P{"b", "1", &J::b, 0, 10, "fractured strength, in the same"},
        P{"m", "1", &J::m, 0.01, 5, "exponent of the fractured strength over pressure"},
        P{"c", "1", &J::c, 0, 1, "rate sensitivity; 0 switches the rate term off"},
        P{"tension", "Pa", &J::tension, 0, 1e12,
          "largest tension (of the pressure) that intact matter bears"},
        P{"hel", "Pa", &J::hel, 1, 1e12, "stress at the Hugoniot elastic limit, which normalises strengths"},
        P{"hel-pressure", "Pa", &J::hel_pressure, 1, 1e12, "pressure there, which normalises pressures"},
        P{"most-fractured", "1", &J::most_fractured, 0, 1000, "the most that the fractured strength reaches"},
        P{"reference-rate", "1/s", &J::reference_rate, 1e-8, 1e8, "strain rate of a and b"}};
  }

  /// What is wrong with the constants together; null: nothing.
  constexpr const char* problem() const {
    return hel <= hel_pressure ? "hel must exceed hel-pressure" : nullptr;
  }

  /// Equivalent stress at the Hugoniot elastic limit [Pa].
  constexpr double at_hel() const { return 1.5 * (hel - hel_pressure); }

  double intact(double pressure, double rate) const {
    const double base = (pressure + tension) / hel_pressure;
    return base > 0 ? a * std::pow(base, n) * by_rate(rate) * at_hel() : 0.0;
  }
  double fractured(double pressure, double rate) const {
    if (!(pressure > 0)) return 0;
    const double grown = b * std::pow(pressure / hel_pressure, m) * by_rate(rate);
    return (grown < most_fractured ? grown : most_fractured) * at_hel();
  }

  /// Yield stress [Pa].
  double yield(const YieldState& s) const {
    const double whole = intact(s.pressure, s.rate);
    if (!(s.damage > 0)) return whole;
    const double broken = fractured(s.pressure, s.rate);
    return s.damage < 1 ? whole - s.damage * (whole - broken) : broken;
  }

 private:
  double by_rate(double rate) const {
    return c > 0 && rate > reference_rate ? 1 + c * std::log(rate / reference_rate) : 1.0;
  }
};

}  // namespace recoil
