#include "mesh/grid.hpp"

#include "../core/dimensions.hpp"
#include "core/error.hpp"
#include "grids.hpp"

namespace recoil::grid_test {
namespace {

template <class D>
struct Grids : testing::Test {
  static constexpr int dim = D::value;
};
TYPED_TEST_SUITE(Grids, Dimensions);

TYPED_TEST(Grids, CellsAndCentresAreInverse) {
  constexpr int dim = TestFixture::dim;
  const auto grid = make_test_grid<dim>(7, 3, Edge::outflow);
  for_each(grid.domain().grown(2), [&](const Index<dim>& i) { EXPECT_EQ(grid.cell_of(grid.centre(i)), i); });
  for (int d = 0; d < dim; ++d) EXPECT_EQ(grid.blocks()[d], (7 + d + 2) / 3);
}

TYPED_TEST(Grids, WholeCellsFillTheDomain) {
  constexpr int dim = TestFixture::dim;
  const auto grid = make_test_grid<dim>(7, 3, Edge::outflow);
  double volume = 0, expected = 1;
  for_each(grid.domain(), [&](const Index<dim>& i) { volume += grid.full_volume(i); });
  for (int d = 0; d < dim; ++d) expected *= grid.cells[d] * grid.dx;
  EXPECT_DOUBLE_EQ(volume, expected);
  EXPECT_DOUBLE_EQ(grid.full_area({}, 0), grid.dx_power(dim - 1));
}

TEST(AxisymmetricGrid, VolumesAndAreasPerRadian) {
  const auto grid = make_axisymmetric_grid(24, 10, 8);
  const double radius = 24 * grid.dx, height = 10 * grid.dx;
  double volume = 0, disc = 0, mantle = 0;
  for_each(grid.domain(), [&](const Index<2>& i) { volume += grid.full_volume(i); });
  for (int i = 0; i < 24; ++i) disc += grid.full_area({{i, 3}}, 1);
  for (int j = 0; j < 10; ++j) mantle += grid.full_area({{24, j}}, 0);
  EXPECT_DOUBLE_EQ(volume, 0.5 * radius * radius * height);
  EXPECT_DOUBLE_EQ(disc, 0.5 * radius * radius);
  EXPECT_DOUBLE_EQ(mantle, radius * height);
  EXPECT_EQ(grid.full_area({{0, 2}}, 0), 0);  // the axis
  EXPECT_EQ(grid.face_weight(-2), grid.face_weight(2));
  EXPECT_EQ(grid.weight(-1), grid.weight(0));
}

TEST(SphericalGrid, VolumesAndAreasPerSteradian) {
  auto grid = make_test_grid<1>(24, 8, Edge::outflow);
  grid.origin[0] = 0;
  grid.radial_power = 2;
  const double radius = 24 * grid.dx;
  double volume = 0, hoops = 0, moment = 0;
  for (int i = 0; i < 24; ++i) {
    volume += grid.full_volume({{i}});
    hoops += grid.hoop_area(i);
    const double low = i * grid.dx, high = low + grid.dx, part = grid.low_face_part(i);
    moment += (part * low + (1 - part) * high) * grid.hoop_area(i);  // of a velocity that grows with r
  }
  EXPECT_NEAR(volume, radius * radius * radius / 3, 1e-12 * volume);
  EXPECT_NEAR(hoops, radius * radius, 1e-12 * hoops);
  EXPECT_NEAR(moment, 2 * radius * radius * radius / 3, 1e-12 * moment);
  EXPECT_DOUBLE_EQ(grid.full_area({{24}}, 0), radius * radius);
  EXPECT_EQ(grid.full_area({{0}}, 0), 0);  // the centre
  EXPECT_EQ(grid.weight(-1), grid.weight(0));
}

template <int Dim>
Index<Dim> chosen(int cells, Edge edge, int wanted) {
  const auto grid = make_test_grid<Dim>(cells, 1, edge, true);
  return choose_block<Dim>(grid.cells, grid.edge, wanted);
}

TYPED_TEST(Grids, BlocksAreAsWantedOrWhatTheAxisHas) {
  constexpr int dim = TestFixture::dim;
  EXPECT_EQ(chosen<dim>(100, Edge::outflow, 24)[dim - 1], 24);
  EXPECT_EQ(chosen<dim>(100, Edge::reflect, 24)[0], 24);
  EXPECT_EQ(chosen<dim>(11, Edge::outflow, 24)[0], 11);
  EXPECT_EQ(chosen<dim>(1000, Edge::outflow, 0)[0], dim == 1 ? 64 : dim == 2 ? 32 : 16);
}

TYPED_TEST(Grids, PeriodicAxesHoldWholeBlocks) {
  constexpr int dim = TestFixture::dim;
  for (const int cells : {16, 32, 40, 60, 75, 130, 240}) {
    const int block = chosen<dim>(cells, Edge::periodic, 16)[0];
    EXPECT_EQ(cells % block, 0) << cells;
    EXPECT_GT(block, widest_halo);
  }
  EXPECT_EQ(chosen<dim>(60, Edge::periodic, 16)[0], 15);
  EXPECT_EQ(chosen<dim>(13, Edge::periodic, 16)[0], 13);  // one block
}

TYPED_TEST(Grids, APrimeNumberOfPeriodicCellsIsAnError) {
  constexpr int dim = TestFixture::dim;
  EXPECT_THROW(chosen<dim>(101, Edge::periodic, 16), InputError);
  EXPECT_NO_THROW(chosen<dim>(101, Edge::outflow, 16));
}

}  // namespace
}  // namespace recoil::grid_test
