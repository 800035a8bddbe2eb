#include "format/vtkhdf.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>
#include <variant>

#include "core/error.hpp"
#include "format/hdf5_handle.hpp"
#include "format/json_files.hpp"

namespace recoil {
namespace {

constexpr const char* time_array = "TimeValue";  // of the field data: VTK knows it by this name

/// Writes a table of `columns` per row (a plain list where columns = 1), in compressed pieces of about 1 MB.
template <class T>
void write_dataset(hid_t group, const std::string& name, const std::vector<T>& values, std::size_t columns,
                   int deflate_level) {
  const hsize_t rows = values.size() / columns;
  const std::array<hsize_t, 2> shape{rows, columns};
  const int rank = columns == 1 ? 1 : 2;
  const Hdf5Handle space(H5Screate_simple(rank, shape.data(), nullptr), H5Sclose, "describe a data set");
  const Hdf5Handle options(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "set the options of a data set");
  if (rows > 64 && deflate_level > 0) {
    const std::array<hsize_t, 2> chunk{
        std::min<hsize_t>(rows, std::max<hsize_t>(64, (1 << 20) / (columns * sizeof(T)))), columns};
    Hdf5Handle::check(H5Pset_chunk(options, rank, chunk.data()), "set the options of a data set");
    Hdf5Handle::check(H5Pset_shuffle(options), "set the options of a data set");
    Hdf5Handle::check(H5Pset_deflate(options, static_cast<unsigned>(deflate_level)), "compress a data set");
  }
  const Hdf5Handle set(
      H5Dcreate2(group, name.c_str(), hdf5_type<T>(), space, H5P_DEFAULT, options, H5P_DEFAULT), H5Dclose,
      "create a data set");
  if (rows > 0)
    Hdf5Handle::check(H5Dwrite(set, hdf5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
                      "write a data set: is the disk full?");
}

void write_array(hid_t group, const NamedArray& array, int deflate_level) {
  std::visit(
      [&](const auto& values) {
        write_dataset(group, array.name, values, static_cast<std::size_t>(array.components), deflate_level);
      },
      array.values);
}

/// The marks by which a reader knows the layout. The type must be a string of fixed length, without which
/// VTK 9.1 does not read the file.
void write_layout_marks(hid_t root) {
  const std::array<std::int64_t, 2> version{1, 0};
  const hsize_t two = 2;
  const Hdf5Handle pair(H5Screate_simple(1, &two, nullptr), H5Sclose, "describe an attribute");
  const Hdf5Handle number(H5Acreate2(root, "Version", H5T_NATIVE_INT64, pair, H5P_DEFAULT, H5P_DEFAULT),
                          H5Aclose, "create an attribute");
  Hdf5Handle::check(H5Awrite(number, H5T_NATIVE_INT64, version.data()), "write an attribute");

  const std::string kind = "UnstructuredGrid";
  const Hdf5Handle text(H5Tcopy(H5T_C_S1), H5Tclose, "describe a text");
  Hdf5Handle::check(H5Tset_size(text, kind.size()), "describe a text");
  Hdf5Handle::check(H5Tset_strpad(text, H5T_STR_NULLPAD), "describe a text");
  const Hdf5Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, "describe an attribute");
  const Hdf5Handle type(H5Acreate2(root, "Type", text, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                        "create an attribute");
  Hdf5Handle::check(H5Awrite(type, text, kind.data()), "write an attribute");
}

Hdf5Handle new_group(hid_t parent, const char* name) {
  return {H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "create a group"};
}

void write_grid(hid_t root, const UnstructuredGrid& grid, int level) {
  const auto count = [](std::size_t n) { return std::vector<std::int64_t>{static_cast<std::int64_t>(n)}; };
  write_dataset(root, "NumberOfPoints", count(grid.points.size() / 3), 1, 0);
  write_dataset(root, "NumberOfCells", count(grid.cells()), 1, 0);
  write_dataset(root, "NumberOfConnectivityIds", count(grid.connectivity.size()), 1, 0);
  write_dataset(root, "Points", grid.points, 3, level);
  write_dataset(root, "Connectivity", grid.connectivity, 1, level);
  write_dataset(root, "Offsets", grid.offsets, 1, level);
  write_dataset(root, "Types", grid.types, 1, level);
}

[[noreturn]] void not_ours(const std::filesystem::path& path, const std::string& why) {
  throw InputError(fmt::format("error: '{}' is not a field file of recoil: {}", path.string(), why));
}

Hdf5Handle open_group(hid_t parent, const char* name, const std::filesystem::path& path) {
  const hid_t id = H5Gopen2(parent, name, H5P_DEFAULT);
  if (id < 0) not_ours(path, fmt::format("it has no group '{}'", name));
  return {id, H5Gclose, "open a group"};
}

Hdf5Handle open_for_reading(hid_t parent, const char* name, const std::filesystem::path& path) {
  const hid_t id = H5Dopen2(parent, name, H5P_DEFAULT);
  if (id < 0) not_ours(path, fmt::format("it has no data set '{}'", name));
  return {id, H5Dclose, "open a data set"};
}

template <class T>
std::vector<T> read_values(hid_t set) {
  const Hdf5Handle space(H5Dget_space(set), H5Sclose, "describe a data set");
  std::vector<T> values(static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space))));
  if (!values.empty())
    Hdf5Handle::check(H5Dread(set, hdf5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
                      "read a data set");
  return values;
}

template <class T>
std::vector<T> read_dataset(hid_t root, const char* name, const std::filesystem::path& path) {
  const Hdf5Handle set = open_for_reading(root, name, path);
  return read_values<T>(set);
}

NamedArray read_array(hid_t group, const std::string& name, const std::filesystem::path& path) {
  const Hdf5Handle set = open_for_reading(group, name.c_str(), path);
  const Hdf5Handle space(H5Dget_space(set), H5Sclose, "describe a data set");
  std::array<hsize_t, 2> shape{0, 1};
  if (H5Sget_simple_extent_ndims(space) > 2) not_ours(path, fmt::format("'{}' has three dimensions", name));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  const Hdf5Handle type(H5Dget_type(set), H5Tclose, "describe a data set");
  NamedArray array{name, static_cast<int>(shape[1]), {}};
  if (H5Tget_class(type) == H5T_INTEGER)
    array.values = read_values<std::int32_t>(set);
  else if (H5Tget_size(type) == sizeof(float))
    array.values = read_values<float>(set);
  else
    array.values = read_values<double>(set);
  return array;
}

std::vector<std::string> names_in(hid_t group) {
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  Hdf5Handle::check(H5Literate(group, H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, add, &names) >= 0
                        ? 0
                        : H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names),
                    "list the arrays");
  return names;
}

}  // namespace

void write_vtkhdf(const std::filesystem::path& path, const UnstructuredGrid& grid, double time_s,
                  int deflate_level) {
  check_grid(grid);
  const QuietHdf5 quiet;
  Hdf5Image file;
  {
    const Hdf5Handle order(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "set the options of a group");
    H5Pset_link_creation_order(order, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    const Hdf5Handle root = new_group(file, "VTKHDF");
    write_layout_marks(root);
    write_grid(root, grid, deflate_level);
    const Hdf5Handle cells(H5Gcreate2(root, "CellData", H5P_DEFAULT, order, H5P_DEFAULT), H5Gclose,
                           "create a group");
    for (const auto& array : grid.cell_arrays) write_array(cells, array, deflate_level);
    const Hdf5Handle points = new_group(root, "PointData");
    const Hdf5Handle fields = new_group(root, "FieldData");
    write_dataset(fields, time_array, std::vector<double>{time_s}, 1, 0);
    for (const auto& array : grid.whole_arrays) write_array(fields, array, deflate_level);
  }
  write_atomically(path, file.bytes());
}

bool can_read_vtkhdf(const std::filesystem::path& path) {
  const QuietHdf5 quiet;
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id >= 0) H5Fclose(id);
  return id >= 0;
}

VtkhdfFile read_vtkhdf(const std::filesystem::path& path) {
  const QuietHdf5 quiet;
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0)
    throw InputError(fmt::format(
        "error: cannot read the field file '{}'\n   = help: it is damaged or cut off: run the case again",
        path.string()));
  const Hdf5Handle file(id, H5Fclose, "open a file");
  const Hdf5Handle root = open_group(file, "VTKHDF", path);
  VtkhdfFile result;
  result.grid.points = read_dataset<double>(root, "Points", path);
  result.grid.connectivity = read_dataset<std::int64_t>(root, "Connectivity", path);
  result.grid.offsets = read_dataset<std::int64_t>(root, "Offsets", path);
  result.grid.types = read_dataset<unsigned char>(root, "Types", path);
  const Hdf5Handle fields = open_group(root, "FieldData", path);
  const auto time = read_dataset<double>(fields, time_array, path);
  if (time.size() != 1) not_ours(path, "it has no time");
  result.time_s = time.front();
  for (const auto& name : names_in(fields))
    if (name != time_array) result.grid.whole_arrays.push_back(read_array(fields, name, path));
  const Hdf5Handle cells = open_group(root, "CellData", path);
  for (const auto& name : names_in(cells)) result.grid.cell_arrays.push_back(read_array(cells, name, path));
  try {
    check_grid(result.grid);
  } catch (const InternalError& error) {
    not_ours(path, error.what());
  }
  return result;
}

void write_series(const std::filesystem::path& path, const std::vector<SeriesEntry>& entries) {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const auto& entry : entries) files.push_back({{"name", entry.name}, {"time", entry.time_s}});
  nlohmann::ordered_json root;
  root["file-series-version"] = "1.0";
  root["files"] = std::move(files);
  write_atomically(path, root.dump(1) + "\n");
}

std::vector<SeriesEntry> read_series(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("error: cannot read '{}'", path.string()));
  std::vector<SeriesEntry> entries;
  try {
    const auto root = nlohmann::json::parse(file);
    for (const auto& entry : root.at("files"))
      entries.push_back({entry.at("name").get<std::string>(), entry.at("time").get<double>()});
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("error: '{}' is not a file series: {}", path.string(), error.what()));
  }
  return entries;
}

}  // namespace recoil
