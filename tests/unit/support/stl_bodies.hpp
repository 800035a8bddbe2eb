#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "config/shape/stl/closed_surface.hpp"

/// Closed surfaces for tests, and the bytes of STL files that hold them.
namespace recoil {

/// A prism along z over a polygon, counter-clockwise, whose first corner sees all of its others.
inline config::Triangles prism(const std::vector<std::array<double, 2>>& corners, double low, double high) {
  config::Triangles s;
  const int n = static_cast<int>(corners.size());
  for (const double z : {low, high})
    for (const auto& c : corners) s.points.push_back({{c[0], c[1], z}});
  for (int i = 1; i + 1 < n; ++i) {
    s.corners.push_back({0, i + 1, i});
    s.corners.push_back({n, n + i, n + i + 1});
  }
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    s.corners.push_back({i, j, n + j});
    s.corners.push_back({i, n + j, n + i});
  }
  return s;
}

inline config::Triangles cube(double lo, double hi) {
  return prism({{lo, lo}, {hi, lo}, {hi, hi}, {lo, hi}}, lo, hi);
}

inline std::string stl_text(const config::Triangles& s) {
  std::string text = "solid of a test\n";
  for (const auto& triangle : s.corners) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const int p : triangle) {
      text += "   vertex";
      for (int d = 0; d < 3; ++d) text += ' ' + std::to_string(s.points[static_cast<std::size_t>(p)][d]);
      text += '\n';
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid of a test\n";
}

inline std::string stl_binary(const config::Triangles& s) {
  std::string bytes(80, 'b');
  const auto put = [&](std::uint32_t n) {
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(n >> 8 * i & 0xff);
  };
  put(static_cast<std::uint32_t>(s.corners.size()));
  for (const auto& triangle : s.corners) {
    for (int d = 0; d < 3; ++d) put(0);
    for (const int p : triangle)
      for (int d = 0; d < 3; ++d)
        put(std::bit_cast<std::uint32_t>(static_cast<float>(s.points[static_cast<std::size_t>(p)][d])));
    bytes += std::string(2, '\0');
  }
  return bytes;
}

}  // namespace recoil
