#include "core/index.hpp"

#include <vector>

#include "dimensions.hpp"

namespace recoil::index_test {
namespace {

template <class D>
struct IndexBox : testing::Test {
  static constexpr int dim = D::value;
  static Box<dim> some() {
    Box<dim> b;
    for (int d = 0; d < dim; ++d) b.lo[d] = -2 + d, b.hi[d] = 3 + 2 * d;
    return b;
  }
};
TYPED_TEST_SUITE(IndexBox, Dimensions);

TYPED_TEST(IndexBox, PlacesAndIndicesAreInverse) {
  const auto box = TestFixture::some();
  for (int k = 0; k < box.size(); ++k) {
    EXPECT_EQ(box.at(box.index(k)), k);
    EXPECT_TRUE(box.contains(box.index(k)));
  }
}

TYPED_TEST(IndexBox, StrideIsTheStepToTheNeighbour) {
  constexpr int dim = TestFixture::dim;
  const auto box = TestFixture::some();
  for (int d = 0; d < dim; ++d) {
    Index<dim> next = box.lo;
    ++next[d];
    EXPECT_EQ(box.at(next) - box.at(box.lo), box.stride(d));
  }
}

TYPED_TEST(IndexBox, ForEachVisitsEveryCellOnceInOrderOfMemory) {
  constexpr int dim = TestFixture::dim;
  const auto box = TestFixture::some();
  int visited = 0;
  for_each(box, [&](const Index<dim>& i) { EXPECT_EQ(box.at(i), visited++); });
  EXPECT_EQ(visited, box.size());
}

TYPED_TEST(IndexBox, NothingIsVisitedInAnEmptyBox) {
  constexpr int dim = TestFixture::dim;
  for (int d = 0; d < dim; ++d) {
    auto box = TestFixture::some();
    box.hi[d] = box.lo[d];
    for_each(box, [&](const Index<dim>&) { ADD_FAILURE(); });
  }
}

TYPED_TEST(IndexBox, GrowsOnAllSides) {
  constexpr int dim = TestFixture::dim;
  const auto box = TestFixture::some(), grown = box.grown(2);
  for (int d = 0; d < dim; ++d) {
    EXPECT_EQ(grown.extent(d), box.extent(d) + 4);
    Index<dim> edge = box.lo;
    edge[d] -= 2;
    EXPECT_TRUE(grown.contains(edge));
    EXPECT_FALSE(box.contains(edge));
    --edge[d];
    EXPECT_FALSE(grown.contains(edge));
  }
  EXPECT_EQ(grown.grown(-2), box);
}

TEST(Power, IsAnInteger) {
  static_assert(power<1>(7) == 7 && power<2>(3) == 9 && power<3>(5) == 125);
  EXPECT_EQ(power<3>(-1), -1);
}

}  // namespace
}  // namespace recoil::index_test
