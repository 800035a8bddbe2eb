#pragma once

#include <cstddef>
#include <vector>

namespace recoil {

/// A colour, sRGB, 0 to 255 each.
struct Rgb {
  unsigned char r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// Pixels: rows from the top, 3 bytes each. Pixel (i, j) covers [i, i+1] x [j, j+1].
struct Image {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;  ///< 3 * width * height

  Image(int columns, int rows)
      : width(columns),
        height(rows),
        rgb(3 * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}

  std::size_t offset(int i, int j) const {
    return 3 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i));
  }
  Rgb at(int i, int j) const {
    const std::size_t o = offset(i, j);
    return {rgb[o], rgb[o + 1], rgb[o + 2]};
  }
  void set(int i, int j, Rgb colour) {
    const std::size_t o = offset(i, j);
    rgb[o] = colour.r, rgb[o + 1] = colour.g, rgb[o + 2] = colour.b;
  }
};

}  // namespace recoil
