#include "core/vec.hpp"

#include "dimensions.hpp"
#include "random.hpp"

namespace recoil::vec_test {
namespace {

template <class D>
struct Vectors : testing::Test {
  static constexpr int dim = D::value;
};
TYPED_TEST_SUITE(Vectors, Dimensions);

TYPED_TEST(Vectors, SumsScalesAndProducts) {
  constexpr int dim = TestFixture::dim;
  Random random(1);
  const auto a = random.vector<dim>(-1, 1), b = random.vector<dim>(-1, 1);
  EXPECT_EQ(a + b - b - a + a, a + b - b);
  EXPECT_EQ(2.0 * a, a + a);
  EXPECT_EQ(-a + a, Vec<dim>{});
  EXPECT_NEAR(dot(a + b, a + b), dot(a, a) + 2 * dot(a, b) + dot(b, b), 1e-14);
  EXPECT_NEAR(norm(3.0 * a), 3 * norm(a), 1e-15);
}

TYPED_TEST(Vectors, UnitVectors) {
  constexpr int dim = TestFixture::dim;
  Random random(2);
  const auto a = random.vector<dim>(-1, 1);
  EXPECT_NEAR(norm(unit(a)), 1, 1e-15);
  EXPECT_NEAR(dot(unit(a), a), norm(a), 1e-15);
  EXPECT_EQ(unit(Vec<dim>{}), Vec<dim>{});
}

TEST(MainAxis, IsTheLargestByMagnitudeAndTheLowerOfEquals) {
  EXPECT_EQ(main_axis(Vec<3>{{1, -3, 2}}), 1);
  EXPECT_EQ(main_axis(Vec<3>{{2, -2, 2}}), 0);
  EXPECT_EQ(main_axis(Vec<3>{{0, -1, 1}}), 1);
  EXPECT_EQ(main_axis(Vec<1>{{-5}}), 0);
}

}  // namespace
}  // namespace recoil::vec_test
