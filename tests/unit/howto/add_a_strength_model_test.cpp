// What docs/how-to/add-a-strength-model.md shows, compiled and tried. Its blocks of C++ stand here word for
// word.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "material/model_keys.hpp"
#include "material/radial_return.hpp"

namespace recoil {

/// Y = a + b ep^n.
struct PowerLaw {
  double shear_modulus = unset;  // Pa; `unset`: the key is required, a number: its default
  double a = unset;              // Pa, initial yield stress
  double b = unset;              // Pa, hardening
  double n = unset;              // hardening exponent

  static constexpr const char* kind = "power-law";  // as written in a material
  static constexpr const char* doc = "yield stress with a power of plastic strain";
  static constexpr bool rate_dependent = true;  // for its curve, see 2

  static constexpr auto parameters() {  // key, SI unit, member, least, largest, one line
    using P = Parameter<PowerLaw>;
    return std::array{P{"shear-modulus", "Pa", &PowerLaw::shear_modulus, 1, 1e13, "shear modulus"},
                      P{"a", "Pa", &PowerLaw::a, 0, 1e11, "initial yield stress"},
                      P{"b", "Pa", &PowerLaw::b, 0, 1e11, "hardening"},
                      P{"n", "1", &PowerLaw::n, 0.01, 1, "hardening exponent"}};
  }

  /// Yield stress [Pa].
  double yield(const YieldState& s) const { return a + b * std::pow(s.ep, n); }

  // What the return asks of it; of rate and temperature it knows nothing.
  static constexpr double c = 0, reference_rate = 1, reference_temperature = 298;
  double softening(double /*temperature*/) const { return 1; }
  struct Expansion {
    double yield, by_ep, by_log_rate;
  };
  Expansion expand(double ep, double /*log_rate*/) const {
    const double grown = b * std::pow(ep, n);
    return {a + grown, n * grown / ep, 0};
  }
};

namespace {

TEST(HowToAddAStrengthModel, StressReturnsToTheYieldSurface) {
  const PowerLaw copper{47.7e9, 90e6, 292e6, .31};
  for (const double ep : {0.0, 1e-3, 0.4})
    for (const double excess : {1e-4, 0.1, 3.0}) {
      const double q = copper.yield({ep, 0, 298}) * (1 + excess);
      const double dep = plastic_increment(copper, q, {ep, 0, 298}, 1e-9);
      EXPECT_NEAR(q - 3 * copper.shear_modulus * dep, copper.yield({ep + dep, dep / 1e-9, 298}), 1e-10 * q);
    }
  EXPECT_EQ(model_keys::keys_of_model<PowerLaw>().size(), 4U);
}

}  // namespace
}  // namespace recoil
