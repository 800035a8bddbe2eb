#include "kernels/strong_shocks.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace recoil::detail::strong_shocks_test {
namespace {

constexpr double rho = 8000, sound = 5000;

/// Nine cells with a compression in the middle; those that find_strong_shocks() looks at are two from the
/// ends.
struct Shocked {
  static constexpr int cells = 9, margin = 2, looked_at = cells - 2 * margin;
  std::array<double, cells> stress{}, u{}, z{}, density{};
  std::array<std::uint8_t, cells> own{};
  std::array<double, looked_at> kept{};
  bool any = false;

  /// @param strength change of the stress from the fourth cell to the sixth, of rho c^2. @param closing
  /// change of the velocity [m/s]. @param lone a cell without its own average. @param compression change of
  /// the density, of rho. @param frame velocity of all [m/s].
  explicit Shocked(double strength, double closing = 1, int lone = -1, double compression = 0,
                   double frame = 0) {
    for (std::size_t i = 0; i < cells; ++i) {
      const double part = i < 4 ? 0 : i == 4 ? 0.5 : 1;
      density[i] = rho * (1 + compression * (1 - part)), z[i] = density[i] * sound, own[i] = 1;
      stress[i] = -strength * rho * sound * sound * (1 - part);
      u[i] = frame - closing * part;
    }
    if (lone >= 0) own[static_cast<std::size_t>(lone)] = 0;
    any = find_strong_shocks({stress.data() + margin, u.data() + margin, z.data() + margin,
                              density.data() + margin, own.data() + margin, 1, 1},
                             looked_at, kept.data());
  }
};

TEST(StrongShocks, WeakOnesAndExpansionsLeaveAllAsItIs) {
  EXPECT_FALSE(Shocked(0.0999).any);
  EXPECT_FALSE(Shocked(0.5, -1).any) << "the matter moves apart";
}

TEST(StrongShocks, GrowWithTheJumpAndKeepAPart) {
  const Shocked half_way(0.15), strong(0.4);
  EXPECT_NEAR(half_way.kept[2], 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(strong.kept[2], 0.3) << "inside of matter";
  EXPECT_DOUBLE_EQ(strong.kept[1], 0.3) << "half of the jump";
  EXPECT_EQ(strong.kept[0], 1) << "and none";
}

/// Matter behind moves with 250 m/s, so the shock runs with 5250 m/s through the matter ahead, 1.05 c.
TEST(StrongShocks, ThatAreSlowOnTheMeshCountFromLessOn) {
  const auto slow = [](double strength, double speed_over_mesh) {
    return Shocked(strength, 250, -1, 0.05, 250 + speed_over_mesh - 5250);
  };
  EXPECT_FALSE(slow(0.0199, 0).any) << "too weak";
  EXPECT_FALSE(slow(0.0999, 4200).any) << "fast, as where one body is at rest";
  EXPECT_NEAR(slow(0.0275, 0).kept[2], 0.75, 1e-12);
  EXPECT_NEAR(slow(0.05, 1900).kept[2], 0.5, 1e-12);
  EXPECT_NEAR(slow(0.05, -1900).kept[2], 0.5, 1e-12);
  EXPECT_NEAR(slow(0.05, 3500).kept[2], 0.75, 1e-12);
  EXPECT_NEAR(slow(0.4, 0).kept[2], 0.3, 1e-12) << "strong besides";
}

/// Behind a shock that a wall throws back matter is at rest as ahead of it: the jump of rho u is nearly zero.
TEST(StrongShocks, ThatCrossAreNotSlow) {
  EXPECT_NEAR(Shocked(0.05, 250, -1, 0.05, -5000).kept[2], 0.5, 1e-12);
  EXPECT_FALSE(Shocked(0.05, 10, -1, 0.05, 0).any);
}

TEST(StrongShocks, AreFirstOrderBesideGhostValues) {
  EXPECT_DOUBLE_EQ(Shocked(0.4, 1, 2).kept[2], 0);
  EXPECT_DOUBLE_EQ(Shocked(0.4, 1, 1).kept[2], 0.3) << "three cells away";
}

TEST(StrongShocks, FlattenKeepsTheBitsOfWhatIsLeft) {
  const std::array<double, 3> q{0.1, 0.2, 0.3}, kept{1, 0.25, 0};
  std::array<double, 3> low{0.3 / 7, 0.1, 0.1}, high{0.9 / 7, 0.6, 0.7};
  const double untouched = low[0];
  flatten(q.data(), kept.data(), 3, {low.data(), high.data()});
  EXPECT_EQ(low[0], untouched);
  EXPECT_NEAR(low[1], 0.175, 1e-15);
  EXPECT_NEAR(high[1], 0.3, 1e-15);
  EXPECT_EQ(low[2], 0.3);
  EXPECT_EQ(high[2], 0.3);
}

/// Solids stay as they are, whatever their densities; vapour is first order where its density changes by a
/// factor of two.
TEST(ThinMatter, IsFirstOrderWhereItThinsOut) {
  const std::array density{8000.0, 3000.0, 2800.0, 2700.0, 1700.0, 900.0, 100.0};
  std::array<double, 5> kept{};
  EXPECT_FALSE(find_thin_matter(density.data() + 1, 1, 50, 5, kept.data()));
  ASSERT_TRUE(find_thin_matter(density.data() + 1, 1, 2900, 5, kept.data()));
  EXPECT_EQ(kept[0], 1) << "no vapour";
  EXPECT_EQ(kept[1], 1) << "3000 to 2700";
  EXPECT_NEAR(kept[2], 1 - (2800.0 / 1700 - 1.2) / 0.8, 1e-12);
  EXPECT_EQ(kept[3], 0) << "2700 to 900";
  EXPECT_EQ(kept[4], 0);
}

}  // namespace
}  // namespace recoil::detail::strong_shocks_test
