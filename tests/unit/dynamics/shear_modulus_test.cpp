#include "dynamics/stiffness/shear_modulus.hpp"

#include <gtest/gtest.h>

#include <array>

namespace recoil {
namespace {

constexpr double modulus = 8.6e9;

TEST(ExpandedModulus, FallsFromTheThinnestSolidOn) {
  const std::array s{0.0, 0.0, 0.0};
  const auto at = [&](double compression) {
    return expanded_modulus<2>(modulus, compression, false, s.data(), 1);
  };
  EXPECT_EQ(at(1.3), modulus);
  EXPECT_EQ(at(0.8), modulus);
  EXPECT_NEAR(at(0.7) / modulus, 0.5, 1e-12);
  EXPECT_NEAR(at(0.6) / modulus, 1e-6, 1e-12);
  EXPECT_NEAR(at(1e-3) / modulus, 1e-6, 1e-12) << "elastic waves of vapour would run at 35 km/s";
}

/// The wave of a stress S in matter without stiffness would part it at S/sqrt(rho G).
TEST(ExpandedModulus, IsNoLessThanTheStressThatIsThere) {
  const std::array s{2e8, -1e8, 0.0};  // equivalent stress 3e8
  EXPECT_NEAR(expanded_modulus<2>(modulus, 0.5, false, s.data(), 1), 3e8, 1);
  const std::array more{2e10, -1e10, 0.0};
  EXPECT_EQ(expanded_modulus<2>(modulus, 0.5, false, more.data(), 1), modulus);
}

/// Pieces between voids are solid; dust is not.
TEST(ExpandedModulus, StaysBetweenVoids) {
  const std::array s{0.0, 0.0, 0.0};
  EXPECT_EQ(expanded_modulus<2>(modulus, 0.11, true, s.data(), 1), modulus);
  EXPECT_NEAR(expanded_modulus<2>(modulus, 0.09, true, s.data(), 1) / modulus, 1e-6, 1e-12);
}

TEST(ExpandedModulus, OfAFluidIsNone) {
  const std::array s{0.0, 0.0, 0.0};
  EXPECT_EQ(expanded_modulus<2>(0, 0.01, false, s.data(), 1), 0);
}

}  // namespace
}  // namespace recoil
