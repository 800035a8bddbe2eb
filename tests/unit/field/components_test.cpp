#include "field/components.hpp"

#include <set>

#include "../core/dimensions.hpp"

namespace recoil::components_test {
namespace {

template <class D>
struct Numbers : testing::Test {
  static constexpr int dim = D::value;
  using C = Components<dim>;
};
TYPED_TEST_SUITE(Numbers, Dimensions);

TYPED_TEST(Numbers, EveryComponentHasAPlaceOfItsOwn) {
  constexpr int dim = TestFixture::dim;
  using C = typename TestFixture::C;
  std::multiset<int> places{C::rho, C::p, C::ep, C::temperature_rise, C::damage, C::extra};
  for (int d = 0; d < dim; ++d) places.insert(C::u + d);
  for (int c = 0; c < C::stresses; ++c) places.insert(C::s + c);
  EXPECT_EQ(static_cast<int>(places.size()), C::primitives);
  int k = 0;
  for (const int p : places) EXPECT_EQ(p, k++);
  EXPECT_EQ(C::contents, C::extra);
}

TYPED_TEST(Numbers, StressesAreSymmetricAndAllPresent) {
  constexpr int dim = TestFixture::dim;
  using C = typename TestFixture::C;
  std::set<int> found;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) {
      EXPECT_EQ(C::stress(i, j), C::stress(j, i));
      if (C::stress(i, j) >= 0) found.insert(C::stress(i, j));
    }
  EXPECT_EQ(static_cast<int>(found.size()), C::stresses);
  if constexpr (dim == 3) {
    EXPECT_EQ(C::stress(2, 2), -1);
  }
}

/// u -> R u, S -> R S R with R = diag(+-1): the sign of u_i is R_ii, of S_ij R_ii R_jj, of a scalar 1.
TYPED_TEST(Numbers, MirroringTurnsVectorsAndTensors) {
  constexpr int dim = TestFixture::dim;
  using C = typename TestFixture::C;
  for (unsigned flips = 0; flips < 1U << dim; ++flips) {
    const auto r = [&](int d) { return (flips >> d & 1U) != 0 ? -1 : 1; };
    for (const int scalar : {C::rho, C::p, C::ep, C::temperature_rise, C::damage, C::extra})
      EXPECT_EQ(component_sign<dim>(scalar, flips), 1);
    for (int i = 0; i < dim; ++i) {
      EXPECT_EQ(component_sign<dim>(C::u + i, flips), r(i));
      for (int j = 0; j < dim; ++j) {
        if (C::stress(i, j) < 0) continue;
        EXPECT_EQ(component_sign<dim>(C::s + C::stress(i, j), flips), r(i) * r(j));
      }
    }
  }
}

}  // namespace
}  // namespace recoil::components_test
