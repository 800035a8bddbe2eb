#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "format/unstructured_grid.hpp"

namespace recoil {

/// Writes a VTKHDF file of the type UnstructuredGrid, version 1.0 (the layout that VTK 9.1 and ParaView 5.11
/// read), to a temporary name first. The name should end in ".hdf".
/// @param time_s time of the fields [s], kept as the field array TimeValue.
/// @param deflate_level 0 (none) to 9.
/// @throws EnvironmentError where the disk or HDF5 refuses; InternalError for a grid that does not fit
/// together.
void write_vtkhdf(const std::filesystem::path& path, const UnstructuredGrid& grid, double time_s,
                  int deflate_level = 4);

/// What such a file holds.
struct VtkhdfFile {
  UnstructuredGrid grid;
  double time_s = 0;
};

/// Whether a file is whole, as far as opening it tells: one that was cut off is not.
bool can_read_vtkhdf(const std::filesystem::path& path);

/// Reads a file of write_vtkhdf. @throws InputError for a file that is not one.
VtkhdfFile read_vtkhdf(const std::filesystem::path& path);

/// One dump of a series.
struct SeriesEntry {
  std::string name;  ///< of the file, relative to the series file
  double time_s = 0;
};

/// Writes the ".hdf.series" file (JSON) that tells ParaView the times of the dumps. In one step.
void write_series(const std::filesystem::path& path, const std::vector<SeriesEntry>& entries);

/// Reads it. @throws InputError for a file that is not one.
std::vector<SeriesEntry> read_series(const std::filesystem::path& path);

}  // namespace recoil
