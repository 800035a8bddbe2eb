#include "picture/raster.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace recoil::raster_test {
namespace {

const double kNone = std::numeric_limits<double>::quiet_NaN();

TEST(Raster, CoarseCellsFillSeveralPlaces) {
  UnstructuredGrid grid;
  add_box_cell(grid, 2, {0, 0, 0}, {2, 2, 0});
  add_box_cell(grid, 2, {2, 0, 0}, {3, 1, 0});
  add_box_cell(grid, 2, {3, 1, 0}, {4, 2, 0});
  const auto a = rasterise(grid, {5, 7, 8});
  ASSERT_EQ(a.nx, 4);
  ASSERT_EQ(a.ny, 2);
  EXPECT_DOUBLE_EQ(a.dx, 1);
  EXPECT_EQ(a.at(0, 0), 5);
  EXPECT_EQ(a.at(1, 1), 5);
  EXPECT_EQ(a.at(2, 0), 7);
  EXPECT_EQ(a.at(3, 1), 8);
  EXPECT_TRUE(std::isnan(a.at(3, 0)));
  EXPECT_TRUE(std::isnan(a.at(2, 1)));
}

TEST(Raster, CellsWithoutAValueHideNothing) {
  UnstructuredGrid grid;  // two bodies, each with its own cell in the same place
  add_box_cell(grid, 2, {0, 0, 0}, {1, 1, 0});
  add_box_cell(grid, 2, {0, 0, 0}, {1, 1, 0});
  EXPECT_EQ(rasterise(grid, {3, kNone}).at(0, 0), 3);
  EXPECT_EQ(rasterise(grid, {kNone, 4}).at(0, 0), 4);
}

TEST(Raster, CutTakesOneLayerOfASolidGrid) {
  UnstructuredGrid grid;
  std::vector<double> values;
  for (int k = 0; k < 3; ++k) {
    add_box_cell(grid, 3, {0, 0, 1.0 * k}, {1, 1, k + 1.0});
    values.push_back(k);
  }
  EXPECT_EQ(rasterise(grid, values, {2, 1.5}).at(0, 0), 1);
  EXPECT_EQ(rasterise(grid, values, {2, 1.0}).at(0, 0), 1);
  EXPECT_EQ(rasterise(grid, values, {2, 9.0}).nx, 0);
  EXPECT_EQ(cell_edges(grid, {2, 0.5}).size(), 1u);
}

TEST(Raster, CutsAcrossEachAxis) {
  UnstructuredGrid grid;  // 2 x 3 x 4 cells, each with its own number
  std::vector<double> values;
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 2; ++i) {
        add_box_cell(grid, 3, {1.0 * i, 1.0 * j, 1.0 * k}, {i + 1.0, j + 1.0, k + 1.0});
        values.push_back(100 * k + 10 * j + i);
      }
  const auto across_x = rasterise(grid, values, {0, 1.5}), across_y = rasterise(grid, values, {1, 2.5});
  EXPECT_EQ(across_x.nx, 3);
  EXPECT_EQ(across_x.ny, 4);
  EXPECT_EQ(across_x.at(2, 3), 321);
  EXPECT_EQ(across_y.nx, 2);
  EXPECT_EQ(across_y.ny, 4);
  EXPECT_EQ(across_y.at(1, 2), 221);
}

TEST(Raster, OneRowOfLines) {
  UnstructuredGrid grid;
  for (int i = 0; i < 10; ++i) add_box_cell(grid, 1, {0.1 * i, 0, 0}, {0.1 * (i + 1), 0, 0});
  std::vector<double> values(10);
  for (std::size_t i = 0; i < 10; ++i) values[i] = static_cast<double>(i);
  const auto a = rasterise(grid, values);
  ASSERT_EQ(a.nx, 10);
  ASSERT_EQ(a.ny, 1);
  EXPECT_EQ(a.values, values);
  EXPECT_EQ(rasterise(grid, values, {}, 4).nx, 4);
}

}  // namespace
}  // namespace recoil::raster_test
