#include "material/radial_return.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "samples.hpp"

namespace recoil::radial_return_test {
namespace {

/// The state after an increment dep within dt.
YieldState after(YieldState before, double dep, double dt) {
  before.ep += dep;
  before.rate = dep / dt;
  return before;
}

/// Calls f(strength, q_trial, before, dt, dep) over many states, inside and outside of the surface.
template <class F>
void for_many_returns(const F& f) {
  const auto try_out = [&](const auto& s) {
    for (const double dt : {1e-10, 1e-8, 1e-4})
      for (const double t : {250.0, 298.0, 700.0, 3000.0})
        for (const double ep : {0.0, 1e-9, 1e-3, 0.4, 3.0})
          for (const double excess : {-0.5, 0.0, 1e-12, 1e-8, 1e-4, 0.01, 0.1, 0.3, 1.0, 20.0}) {
            const YieldState before{ep, 0, t, 1e9, 1.02};
            const double y = s.yield(before);
            const double q = (std::isfinite(y) && y > 0 ? y : 1e8) * (1 + excess);
            f(s, q, before, dt, plastic_increment(s, q, before, dt));
          }
  };
  samples::for_each<Strength>([&]<class Model>(const Model& s) {
    try_out(s);
    for (const double solid : {1.0, 0.4, 0.0}) try_out(PartlyMolten<Model>(s, solid, 1700));
  });
}

TEST(RadialReturn, SatisfiesItsEquation) {
  for_many_returns([](const auto& s, double q, const YieldState& before, double dt, double dep) {
    if (!(s.shear_modulus > 0) || q <= s.yield(before)) {
      EXPECT_NEAR(dep, 0, 1e-18) << s.kind;  // what is molten in part is rounded otherwise
      return;
    }
    const double returned = q - 3 * s.shear_modulus * dep;
    EXPECT_NEAR(returned, s.yield(after(before, dep, dt)), 1e-10 * q)
        << s.kind << " q " << q << " ep " << before.ep << " T " << before.temperature << " dt " << dt
        << " dep " << dep;
  });
}

TEST(RadialReturn, NoYieldStressIsBelowItsBound) {
  const JohnsonCook copper{.shear_modulus = 46e9,
                           .a = 90e6,
                           .b = 292e6,
                           .n = 0.31,
                           .c = 0.025,
                           .m = 1.09,
                           .melting_temperature = 1356};
  EXPECT_NEAR(least_yield(copper, 0.0, 298) / 90e6, 1, 1e-8);  // without strain it is the yield stress
  JohnsonCook soft = copper;                                   // which softens faster than T* below melting
  soft.m = 0.5;
  EXPECT_EQ(least_yield(soft, 0.0, 700), 0);
  int known = 0;
  const auto compare = [&](const auto& s) {
    for (const double t : {200.0, 298.0, 299.0, 700.0, 1355.0, 1355.999999, 1356.0, 3000.0})
      for (const double ep : {0.0, 1e-9, 1e-3, 0.4, 3.0}) {
        const double y = s.yield({.ep = ep, .temperature = t}), least = least_yield(s, ep, t);
        EXPECT_TRUE(least < y || least == 0 || std::isinf(y)) << s.kind << " " << t << " " << ep;
        known += least > 0 ? 1 : 0;
        EXPECT_LE(least_yield(s, ep, t + 10), least)
            << s.kind;  // a temperature above the true one may be given
      }
  };
  samples::for_each<Strength>(compare);
  compare(copper);
  compare(soft);
  EXPECT_GT(known, 100);
  EXPECT_EQ(least_yield(copper, 0.0, std::nan("")), 0);
}

TEST(RadialReturn, NeverLeavesStressOutsideNorMakesEnergy) {
  for_many_returns([](const auto& s, double q, const YieldState& before, double dt, double dep) {
    if (!(s.shear_modulus > 0)) return;
    const double returned = q - 3 * s.shear_modulus * dep;
    EXPECT_LE(returned, s.yield(after(before, dep, dt)) + 1e-10 * q) << s.kind;
    EXPECT_GE(dep, 0);
    EXPECT_GE(returned, -1e-12 * q) << "the stress would change its sign: dissipation < 0";
  });
}

TEST(RadialReturn, ClosedForms) {
  const PerfectlyPlastic plastic{27.6e9, 0.3e9};
  EXPECT_NEAR(plastic_increment(plastic, 0.5e9, {0.1, 0, 298}, 1e-9), 0.2e9 / (3 * 27.6e9), 1e-18);
  const LinearHardening hardening{43.3e9, 0.4e9, 0.1e9};
  EXPECT_NEAR(plastic_increment(hardening, 0.6e9, {0.5, 0, 298}, 1e-9), 0.15e9 / (3 * 43.3e9 + 0.1e9), 1e-18);
}

TEST(RadialReturn, MeltedMatterKeepsNoStress) {
  const JohnsonCook s{43.33e9, 400e6, 177e6, 1.0, .025, 1.09, 1358};
  EXPECT_NEAR(plastic_increment(s, 1e9, {0.2, 0, 1400}, 1e-9), 1e9 / (3 * 43.33e9), 1e-15);
}

TEST(PartlyMolten, HasTheStrengthOfItsSolidPart) {
  samples::for_each<Strength>([]<class Model>(const Model& s) {
    const YieldState state{.ep = 0.1, .rate = 1e4, .temperature = 800, .pressure = 1e9, .compression = 1.02};
    const double whole = PartlyMolten<Model>(s, 1, infinite).yield(state);
    EXPECT_EQ(whole, s.yield(state)) << s.kind;
    EXPECT_EQ(PartlyMolten<Model>(s, 0.4, infinite).yield(state), 0.4 * whole) << s.kind;
    EXPECT_EQ(PartlyMolten<Model>(s, 0, infinite).yield(state), 0) << s.kind;
  });
}

/// While latent heat is taken up the temperature is that of melting, which a model with a curve and the law
/// of the temperature round otherwise: the solid part says what has strength.
TEST(PartlyMolten, RoundingDoesNotDecideWhatHasMelted) {
  for (const auto& s : samples::of(SteinbergGuinan{})) {
    const double compression = 1.03, at = s.melting_at(compression);
    for (const double temperature : {at * (1 - 1e-14), at, at * (1 + 1e-14)}) {
      const YieldState state{.temperature = temperature, .pressure = 5e9, .compression = compression};
      EXPECT_EQ(PartlyMolten<SteinbergGuinan>(s, 0.9, at).yield(state), 0);
      EXPECT_GT(PartlyMolten<SteinbergGuinan>(s, 1, at).yield(state), 1e6);
    }
    const YieldState molten{.temperature = at, .compression = compression};
    EXPECT_EQ(PartlyMolten<SteinbergGuinan>(s, 1, infinite).yield(molten), 0);  // by the model alone
  }
}

/// A model with a melting temperature but no curve takes that of the state.
TEST(PartlyMolten, MeltsAtTheTemperatureOfTheState) {
  const JohnsonCook s{43.33e9, 400e6, 177e6, 1.0, .025, 1.09, 1358};
  EXPECT_EQ(s.yield({.temperature = 1400}), 0);
  EXPECT_GT(PartlyMolten<JohnsonCook>(s, 1, 2000).yield({.temperature = 1400}), 0.1e9);
  EXPECT_EQ(PartlyMolten<JohnsonCook>(s, 1, 2000).yield({.temperature = 2000}), 0);
}

TEST(RadialReturn, FasterIsStronger) {
  const JohnsonCook s{43.33e9, 400e6, 177e6, 1.0, .025, 1.09, 1358};
  EXPECT_LT(plastic_increment(s, 1e9, {0, 0, 298}, 1e-10), plastic_increment(s, 1e9, {0, 0, 298}, 1e-6));
}

/// Without a rate term the time step must not matter.
TEST(RadialReturn, TimeStepMattersOnlyThroughTheRate) {
  const JohnsonCook s{77.3e9, 1500e6, 569e6, .22, 0, 1.17, 1723};
  const double a = plastic_increment(s, 3e9, {0.01, 0, 400}, 1e-10),
               b = plastic_increment(s, 3e9, {0.01, 0, 400}, 1e-3);
  EXPECT_NEAR(a, b, 1e-11 * b);
}

}  // namespace
}  // namespace recoil::radial_return_test
