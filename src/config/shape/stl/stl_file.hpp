#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "config/shape/stl/closed_surface.hpp"

namespace recoil::config {

/// What an STL file holds, or why it could not be read.
struct StlFile {
  Triangles surface;    // in units of the file; equal points are one
  std::string problem;  // empty: all is well
  std::string help;
  std::string digest = {};  // of the file's bytes: FNV-1a, 64 bits
};

/// Reads an STL file, text ("solid ... facet ... vertex x y z ...") or binary (80 bytes, the number of
/// triangles, 50 bytes each, little-endian). Normals in the file are not used: the order of the corners says
/// where outside is.
StlFile read_stl(const std::filesystem::path& path);

/// The same from the bytes of a file; `name` is what messages call it.
StlFile parse_stl(std::string_view bytes, const std::string& name);

}  // namespace recoil::config
