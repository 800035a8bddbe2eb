#include "format/vtkhdf.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../support/scratch_folder.hpp"
#include "core/error.hpp"

namespace recoil::vtkhdf_test {
namespace {

/// A grid of boxes of two sizes (as refined leaves have) with a field of each kind.
UnstructuredGrid sample(int dim, int count) {
  UnstructuredGrid grid;
  for (int n = 0; n < count; ++n) {
    const double size = n % 3 == 0 ? 1e-3 : 0.5e-3, x = n * 1e-3;
    add_box_cell(grid, dim, {x, -1e-3, 0.25e-3}, {x + size, -1e-3 + size, 0.25e-3 + size});
  }
  std::vector<float> pressure;
  std::vector<double> velocity, stress;
  std::vector<std::int32_t> level;
  for (int n = 0; n < count; ++n) {
    pressure.push_back(static_cast<float>(0.1 * n));
    level.push_back(n % 4 - 1);
    for (int c = 0; c < 3; ++c) velocity.push_back(std::sin(n + 0.3 * c) / 3);
    for (int c = 0; c < 6; ++c) stress.push_back(std::cos(n - 0.7 * c) * 1e-3);
  }
  grid.cell_arrays = {{"pressure_GPa", 1, pressure},
                      {"velocity_m/s", 3, velocity},
                      {"stress_GPa", 6, stress},
                      {"level", 1, level}};
  grid.cell_arrays[1].name = "velocity_m_per_s";
  return grid;
}

/// What VTK's own reader sees in the file; null where VTK is not installed.
nlohmann::json seen_by_vtk(const std::filesystem::path& path) {
  const std::string command =
      "/usr/bin/python3 " RECOIL_SOURCE_DIR "/tests/python/read_vtkhdf.py " + path.string();
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw EnvironmentError("cannot start python3");
  std::string text;
  char buffer[4096];
  while (const std::size_t n = fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, n);
  const int status = pclose(pipe);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code == 77 || code == 127) return nullptr;
  if (code != 0) throw EnvironmentError("VTK does not read the file, code " + std::to_string(code));
  return nlohmann::json::parse(text);
}

void expect_same(const nlohmann::json& seen, const UnstructuredGrid& grid) {
  ASSERT_EQ(seen["cells"].size(), grid.cells());
  for (std::size_t n = 0; n < grid.cells(); ++n) {
    const auto& cell = seen["cells"][n];
    EXPECT_EQ(cell["type"], static_cast<int>(grid.types[n]));
    const auto begin = static_cast<std::size_t>(grid.offsets[n]),
               end = static_cast<std::size_t>(grid.offsets[n + 1]);
    ASSERT_EQ(cell["points"].size(), end - begin);
    for (std::size_t k = begin; k < end; ++k)
      for (std::size_t d = 0; d < 3; ++d)
        EXPECT_EQ(cell["points"][k - begin][d].get<double>(),
                  grid.points[3 * static_cast<std::size_t>(grid.connectivity[k]) + d]);
  }
  ASSERT_EQ(seen["arrays"].size(), grid.cell_arrays.size());
  for (const auto& array : grid.cell_arrays) {
    const auto& read = seen["arrays"][array.name];
    EXPECT_EQ(read["components"], array.components) << array.name;
    EXPECT_EQ(read["values"].get<std::vector<double>>(), as_doubles(array.values)) << array.name;
  }
}

class VtkReads : public testing::TestWithParam<int> {};

TEST_P(VtkReads, TheSameCellsArraysAndValues) {
  const ScratchFolder folder;
  for (const int count : {5, 300}) {  // stored plain and compressed
    UnstructuredGrid grid = sample(GetParam(), count);
    if (count == 300) merge_points(grid);
    write_vtkhdf(folder / "a.hdf", grid, 1.25e-6, 4);
    const auto seen = seen_by_vtk(folder / "a.hdf");
    if (seen.is_null()) GTEST_SKIP() << "python3-vtk9 is not installed";
    expect_same(seen, grid);
    EXPECT_EQ(seen["time"], 1.25e-6);
    EXPECT_EQ(seen["arrays"]["pressure_GPa"]["kind"], "float");
  }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, VtkReads, testing::Values(1, 2, 3));

TEST(Vtkhdf, CornersAreInVtksOrder) {
  UnstructuredGrid grid;
  add_box_cell(grid, 1, {0, 5, 5}, {1, 6, 6});
  add_box_cell(grid, 2, {0, 0, 7}, {1, 1, 8});
  add_box_cell(grid, 3, {0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(grid.types, (std::vector<unsigned char>{3, 9, 12}));
  EXPECT_EQ(grid.offsets, (std::vector<std::int64_t>{0, 2, 6, 14}));
  const std::vector<double> expected{0, 5, 5, 1, 5, 5, 0, 0, 7, 1, 0, 7, 1, 1, 7, 0, 1, 7, 0, 0, 0,
                                     1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
  EXPECT_EQ(grid.points, expected);
}

TEST(Vtkhdf, MergedPointsMakeTheSameCells) {
  UnstructuredGrid grid;
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i)
      add_box_cell(grid, 2, {0.1 * i, 0.1 * j, 0}, {0.1 * (i + 1), 0.1 * (j + 1), 0});
  const UnstructuredGrid before = grid;
  merge_points(grid);
  EXPECT_EQ(grid.points.size(), 3u * 11 * 11);
  for (std::size_t k = 0; k < grid.connectivity.size(); ++k)
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_EQ(grid.points[3 * static_cast<std::size_t>(grid.connectivity[k]) + d],
                before.points[3 * static_cast<std::size_t>(before.connectivity[k]) + d]);
}

TEST(Vtkhdf, ReadsWhatItWrote) {
  const ScratchFolder folder;
  const UnstructuredGrid grid = sample(2, 200);
  write_vtkhdf(folder / "a.hdf", grid, 3e-6);
  const auto [back, time] = read_vtkhdf(folder / "a.hdf");
  EXPECT_EQ(time, 3e-6);
  EXPECT_EQ(back.points, grid.points);
  EXPECT_EQ(back.connectivity, grid.connectivity);
  EXPECT_EQ(back.offsets, grid.offsets);
  EXPECT_EQ(back.types, grid.types);
  ASSERT_EQ(back.cell_arrays.size(), grid.cell_arrays.size());
  for (std::size_t k = 0; k < grid.cell_arrays.size(); ++k) {
    EXPECT_EQ(back.cell_arrays[k].name, grid.cell_arrays[k].name);
    EXPECT_EQ(back.cell_arrays[k].components, grid.cell_arrays[k].components);
    EXPECT_EQ(back.cell_arrays[k].values, grid.cell_arrays[k].values);
  }
  EXPECT_EQ(find_array(back, "pressure").name, "pressure_GPa");
  EXPECT_THROW(find_array(back, "temperature"), InputError);
}

TEST(Vtkhdf, AnEmptyGridIsAFileToo) {
  const ScratchFolder folder;
  UnstructuredGrid grid;
  grid.cell_arrays = {{"pressure_GPa", 1, std::vector<float>{}},
                      {"velocity_m_per_s", 3, std::vector<double>{}}};
  write_vtkhdf(folder / "a.hdf", grid, 0);
  EXPECT_EQ(read_vtkhdf(folder / "a.hdf").grid.cells(), 0u);
}

TEST(Vtkhdf, CompressionMakesItSmaller) {
  const ScratchFolder folder;
  const UnstructuredGrid grid = sample(3, 5000);
  write_vtkhdf(folder / "plain.hdf", grid, 0, 0);
  write_vtkhdf(folder / "small.hdf", grid, 0, 4);
  EXPECT_LT(std::filesystem::file_size(folder / "small.hdf"),
            std::filesystem::file_size(folder / "plain.hdf") / 2);
}

TEST(Vtkhdf, GridsThatDoNotFitTogetherAreRefused) {
  const ScratchFolder folder;
  UnstructuredGrid grid = sample(2, 3);
  grid.cell_arrays[0].components = 2;
  EXPECT_THROW(write_vtkhdf(folder / "a.hdf", grid, 0), InternalError);
  grid = sample(2, 3);
  grid.connectivity[1] = 99;
  EXPECT_THROW(write_vtkhdf(folder / "a.hdf", grid, 0), InternalError);
  EXPECT_THROW(write_vtkhdf(folder / "none" / "a.hdf", sample(2, 3), 0), EnvironmentError);
  std::ofstream(folder / "text.hdf") << "text";
  EXPECT_THROW(read_vtkhdf(folder / "text.hdf"), InputError);
  const auto files = std::filesystem::directory_iterator(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1) << "a temporary file stayed";
}

TEST(Series, RoundTripAndTheKeysThatParaviewReads) {
  const ScratchFolder folder;
  write_series(folder / "flyer.hdf.series", {{"flyer_000000.hdf", 0}, {"flyer_000001.hdf", 1.0 / 3e6}});
  const auto back = read_series(folder / "flyer.hdf.series");
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(back[1].name, "flyer_000001.hdf");
  EXPECT_EQ(back[1].time_s, 1.0 / 3e6);
  std::ifstream file(folder / "flyer.hdf.series");
  const auto json = nlohmann::json::parse(file);
  EXPECT_EQ(json["file-series-version"], "1.0");
  EXPECT_EQ(json["files"][0]["name"], "flyer_000000.hdf");
  std::ofstream(folder / "bad.hdf.series") << "{\"files\": 3";
  EXPECT_THROW(read_series(folder / "bad.hdf.series"), InputError);
}

}  // namespace
}  // namespace recoil::vtkhdf_test
