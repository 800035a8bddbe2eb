#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace recoil {

/// A colour, sRGB, 0 to 255 each.
struct Rgb {
  unsigned char r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// A picture: rows from the top, 3 bytes per pixel. Pixel (i, j) covers [i, i+1] x [j, j+1].
struct Image {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;  ///< 3 * width * height

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

/// A picture of one colour. @throws InternalError for an empty or absurd size.
Image make_image(int width, int height, Rgb background);

/// The bytes of a PNG file (8-bit RGB). @throws EnvironmentError where libpng fails.
std::string encode_png(const Image& image);
/// The picture in the bytes of any PNG file, alpha over white. @throws InputError for anything else.
Image decode_png(std::string_view bytes);

/// Writes the file in one step (see write_atomically). @throws EnvironmentError.
void write_png(const std::filesystem::path& path, const Image& image);
/// @throws InputError where there is no PNG file of that name.
Image read_png(const std::filesystem::path& path);

}  // namespace recoil
