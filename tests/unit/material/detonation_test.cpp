#include "material/detonation.hpp"

#include <gtest/gtest.h>

namespace recoil::detonation_test {
namespace {

/// TNT: Lee, Hornig & Kury (1968) give 6930 m/s and 21.0 GPa with these constants.
TEST(Detonation, TntHasItsPublishedState) {
  const Jwl tnt{1630, 371.2e9, 3.231e9, 4.15, .95, .30, 7e9, 6930};
  const ChapmanJouguet s = chapman_jouguet(tnt);
  EXPECT_NEAR(s.velocity, 6930, 7);
  EXPECT_NEAR(s.pressure, 21.0e9, 0.05e9);
}

/// Behind the front the products follow it with the speed of sound.
TEST(Detonation, FrontIsSonic) {
  const Jwl c4{1601, 609.77e9, 12.95e9, 4.5, 1.4, .25, 9e9, 8193};
  const ChapmanJouguet s = chapman_jouguet(c4);
  const double c2 = c4.sound_speed_squared(s.density, s.pressure), behind = s.velocity - s.particle;
  EXPECT_NEAR(c2, behind * behind, 1e-6 * c2);
  EXPECT_NEAR(s.velocity, 8193, 40);
}

}  // namespace
}  // namespace recoil::detonation_test
