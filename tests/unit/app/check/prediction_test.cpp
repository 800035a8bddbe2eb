#include "app/check/prediction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "app/load_case.hpp"

namespace recoil::app::prediction_test {
namespace {

const std::string cases = std::string(RECOIL_SOURCE_DIR) + "/cases/";

PlatePrediction predicted(const std::string& file, const std::vector<std::string>& overrides = {}) {
  const LoadedCase loaded = load_case(file, overrides);
  EXPECT_FALSE(loaded.found.has_errors()) << loaded.found.text();
  const auto pairs = find_plate_pairs(loaded.contents);
  EXPECT_EQ(pairs.size(), 1U);
  return predict(pairs.at(0), loaded.contents, loaded.materials);
}

// Exact: jump conditions on the two Hugoniots (cases.md, B).
TEST(Prediction, AluminiumOnCopperWithoutStrength) {
  const PlatePrediction p = predicted(cases + "flyer_al_cu_hydro");
  EXPECT_NEAR(p.velocity, 134.05, 0.02);
  EXPECT_NEAR(p.stress, 4.956e9, 2e6);
  EXPECT_NEAR(p.target_shock.shock_speed, 4140, 1);
  EXPECT_NEAR(p.flyer_shock.shock_speed, 5809, 1);
  EXPECT_FALSE(p.precursor_arrival.has_value());
  EXPECT_NEAR(p.shock_arrival, 3.623e-6, 2e-9);
  EXPECT_NEAR(p.plateau_surface_velocity, 268.1, 1);
  EXPECT_EQ(p.parting, Parting::by_flyer_release);
}

// Exact two-wave solution with the rate term off; converged solution for the opening.
TEST(Prediction, AluminiumOnCopper) {
  const PlatePrediction p = predicted(cases + "flyer_al_cu");
  EXPECT_EQ(p.contact, 0);
  EXPECT_NEAR(p.velocity, 133.69, 0.02);
  EXPECT_NEAR(p.stress, 5.0838e9, 1e6);
  ASSERT_TRUE(p.precursor_arrival.has_value());
  EXPECT_NEAR(*p.precursor_arrival, 3.180e-6, 2e-9);
  EXPECT_NEAR(p.precursor_surface_velocity, 43.44, 0.05);
  EXPECT_NEAR(p.shock_arrival, 3.566e-6, 0.01 * 3.566e-6);
  EXPECT_EQ(p.parting, Parting::by_flyer_release);
  EXPECT_NEAR(p.opens, 0.695e-6, 0.03 * 0.695e-6);
  EXPECT_NEAR(p.flyer_rear_after, -174.6, 7);
}

// Of equal materials: the release that comes first, from the thinner plate, opens, whichever of the two
// flies.
TEST(Prediction, EqualPlatesPartByTheThinnerOne) {
  const auto opens = [](const std::string& flyer, const std::string& target) {
    return predicted(cases + "contact_equal_plates",
                     {"body.flyer.shape.x=" + flyer, "body.target.shape.x=" + target});
  };
  const PlatePrediction thin_flyer = opens("[\"-2 mm\", \"0 mm\"]", "[\"0 mm\", \"9 mm\"]");
  const PlatePrediction thin_target = opens("[\"-9 mm\", \"0 mm\"]", "[\"0 mm\", \"2 mm\"]");
  EXPECT_EQ(thin_flyer.parting, Parting::neutral);
  EXPECT_EQ(thin_target.parting, Parting::neutral);
  EXPECT_NEAR(thin_flyer.opens, thin_target.opens, 1e-3 * thin_flyer.opens);
  EXPECT_NEAR(thin_flyer.opens, 2 * 2e-3 / 5000, 0.01 * thin_flyer.opens);
}

// The release from the rear of a thin target comes to the contact first, and the flyer's need not take all of
// the stress then: a run of 4 mm of PMMA on 3 mm of copper at 1200 m/s opens at 2.04 us, not at 2.59.
TEST(Prediction, AThinTargetOpensBeforeTheFlyersReleaseIsThrough) {
  const PlatePrediction thick = predicted(cases + "flyer_al_cu"),
                        thin = predicted(cases + "flyer_al_cu", {"body.target.shape.x=[\"0 mm\", \"0.8 mm\"]",
                                                                 "gauge.rear.at.x=0.8mm"});
  EXPECT_FALSE(thick.opens_is_bound);
  EXPECT_TRUE(thin.opens_is_bound);
  EXPECT_EQ(thin.parting, Parting::by_flyer_release);
  EXPECT_DOUBLE_EQ(thin.opens, thick.opens);
}

TEST(Prediction, BondedPlatesNeverOpen) {
  const PlatePrediction p = predicted(cases + "flyer_bonded");
  EXPECT_NEAR(p.stress, 5.0838e9, 1e6);
  EXPECT_EQ(p.parting, Parting::never);
  EXPECT_TRUE(std::isinf(p.opens));
}

TEST(Prediction, CopperOnAluminiumStaysUntilTheTargetsRelease) {
  const PlatePrediction p = predicted(cases + "flyer_cu_al");
  EXPECT_NEAR(p.velocity, 316.31, 0.02);
  EXPECT_EQ(p.parting, Parting::by_target_release);
  EXPECT_NEAR(p.opens, 4.886e-6, 0.01 * 4.886e-6);
  EXPECT_NEAR(p.plateau_surface_velocity, 623.6, 7);
}

// Where the release overtakes the shock in aluminium on aluminium, in flyer thicknesses: (c_L + U_s)/(c_L -
// U_s) of the independent solution's notes, which hold without the precursor's reflection in the flyer.
TEST(Prediction, ReleaseOvertakesTheShock) {
  const double speeds[] = {1000, 1500, 1900}, depths[] = {8.87, 8.02, 7.51};
  for (int i = 0; i < 3; ++i) {
    const PlatePrediction p =
        predicted(cases + "flyer_al_cu", {"body.target.material=aluminium/6061-t6",
                                          "body.flyer.velocity.x=" + std::to_string(speeds[i]) + " m/s"});
    EXPECT_EQ(p.parting, Parting::neutral);
    EXPECT_NEAR(p.overtaking_depth / 2e-3, depths[i], 0.15) << speeds[i];
  }
}

// Without free sides nothing comes from them; with planes of symmetry it comes from the far ends alone.
TEST(Prediction, ReleasesComeFromFreeSidesOnly) {
  EXPECT_TRUE(std::isinf(predicted(cases + "contact_restitution_3d").pair.half_width));
  EXPECT_NEAR(predicted(cases + "contact_finite_plates").pair.half_width, 3e-3, 1e-9);
}

TEST(Prediction, AGapDelaysAndARigidTargetTakesTheWholeVelocity) {
  const PlatePrediction p =
      predicted(cases + "flyer_al_cu", {"body.target.shape.x=[\"0.45 mm\", \"15 mm\"]"});
  EXPECT_NEAR(p.contact, 1e-6, 1e-12);
  LoadedCase loaded = load_case(cases + "flyer_al_cu", {});
  loaded.contents.bodies[1].rigid = true;
  const auto pairs = find_plate_pairs(loaded.contents);
  const PlatePrediction wall = predict(pairs.at(0), loaded.contents, loaded.materials);
  EXPECT_EQ(wall.velocity, 0);
  EXPECT_NEAR(wall.flyer_shock.velocity, 450, 1e-9);
  EXPECT_EQ(wall.parting, Parting::by_flyer_release);
}

TEST(Prediction, MirroredMotionGivesTheMirroredAnswer) {
  const PlatePrediction there = predicted(cases + "flyer_al_cu");
  const PlatePrediction back = predicted(
      cases + "flyer_al_cu", {"body.flyer.shape.x=[\"15 mm\", \"17 mm\"]", "body.flyer.velocity.x=-450 m/s"});
  EXPECT_NEAR(back.velocity, -there.velocity, 1e-9);
  EXPECT_NEAR(back.flyer_rear_after, -there.flyer_rear_after, 1e-9);
  EXPECT_NEAR(back.opens, there.opens, 1e-15);
}

// A plate of 60 mm radius: the release from its edge needs 60 mm / c_L to the middle.
TEST(Prediction, TellsWhenTheSidesMatter) {
  const LoadedCase loaded =
      load_case(cases + "flyer_al_cu",
                {"domain={ geometry = \"axisymmetric\", r = [\"0 mm\", "
                 "\"80 mm\"], z = [\"-8 mm\", \"22 mm\"] }",
                 "body.flyer.shape={ kind = \"cylinder\", radius = \"60 mm\", z = [\"-2 mm\", \"0 mm\"] }",
                 "body.target.shape={ kind = \"cylinder\", radius = \"70 mm\", z = [\"0 mm\", \"15 mm\"] }",
                 "body.flyer.velocity={ z = \"450 m/s\" }", "gauge.rear.at={ z = \"15 mm\" }"});
  ASSERT_FALSE(loaded.found.has_errors()) << loaded.found.text();
  const auto pairs = find_plate_pairs(loaded.contents);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_NEAR(pairs[0].half_width, 0.06, 1e-12);
  EXPECT_EQ(pairs[0].axis, 1);
  const std::string text = describe(predict(pairs[0], loaded.contents, loaded.materials), loaded.contents);
  EXPECT_NE(text.find("from the sides"), std::string::npos);
  EXPECT_NE(text.find("133.7 m/s"), std::string::npos);
}

TEST(Prediction, NoPairWhereNothingClosesIn) {
  const LoadedCase apart = load_case(cases + "flyer_al_cu", {"body.flyer.velocity.x=-1 m/s"});
  EXPECT_TRUE(find_plate_pairs(apart.contents).empty());
}

TEST(Prediction, NoneForBodiesThatDoNotStartFromRest) {
  for (const char* change : {"body.flyer.pressure=3 GPa", "body.target.temperature=600 K"}) {
    const LoadedCase loaded = load_case(cases + "flyer_al_cu", {change});
    EXPECT_TRUE(find_plate_pairs(loaded.contents).empty()) << change;
    EXPECT_TRUE(predict_touches(loaded.contents, loaded.materials, {}).empty()) << change;
    ASSERT_EQ(not_predicted(loaded.contents).size(), 1U) << change;
  }
  const LoadedCase pressed = load_case(cases + "flyer_al_cu", {"body.flyer.pressure=3 GPa"});
  EXPECT_NE(not_predicted(pressed.contents).at(0).find("'flyer' are not predicted: it starts at 3 GPa"),
            std::string::npos);
  const LoadedCase usual = load_case(cases + "flyer_al_cu", {"body.flyer.pressure=0 GPa"});
  EXPECT_EQ(find_plate_pairs(usual.contents).size(), 1U);
  EXPECT_TRUE(not_predicted(usual.contents).empty());
}

/// Round bodies in domains much larger than they are: the first touch is not where a coarse grid has a point.
TEST(Prediction, TouchesOfRoundBodiesAreExact) {
  const auto touch = [](const std::string& name) {
    const LoadedCase loaded = load_case(cases + name, {});
    const auto all = predict_touches(loaded.contents, loaded.materials, find_plate_pairs(loaded.contents));
    EXPECT_EQ(all.size(), 1U);
    return all.at(0).approach;
  };
  const Approach oblique = touch("oblique_levels"), square = touch("sphere_on_plate");
  EXPECT_NEAR(oblique.time, 0.1e-3 / 1060.66, 0.005 * 0.0943e-6);
  EXPECT_NEAR(oblique.closing, 1060.66, 10);
  EXPECT_NEAR(square.time, 0.1e-3 / 500, 0.005 * 0.2e-6);
  EXPECT_NEAR(square.closing, 500, 1);
}

}  // namespace
}  // namespace recoil::app::prediction_test
