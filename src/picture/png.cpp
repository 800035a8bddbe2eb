#include "picture/png.hpp"

#include <fmt/format.h>
#include <png.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "core/error.hpp"
#include "format/json_files.hpp"

namespace recoil {
namespace {

/// libpng's simplified interface: a plain struct that must be freed on every path.
struct PngHandle {
  png_image image{};
  explicit PngHandle() { image.version = PNG_IMAGE_VERSION; }
  PngHandle(const PngHandle&) = delete;
  PngHandle& operator=(const PngHandle&) = delete;
  ~PngHandle() { png_image_free(&image); }
};

}  // namespace

Image make_image(int width, int height, Rgb background) {
  require(width > 0 && height > 0 && width <= 32768 && height <= 32768, "size of a picture in 1..32768");
  Image image{width, height, {}};
  image.rgb.resize(image.offset(0, height));
  for (std::size_t o = 0; o < image.rgb.size(); o += 3) {
    image.rgb[o] = background.r;
    image.rgb[o + 1] = background.g;
    image.rgb[o + 2] = background.b;
  }
  return image;
}

std::string encode_png(const Image& image) {
  require(image.rgb.size() == image.offset(0, image.height), "a picture has 3 bytes per pixel");
  PngHandle png;
  png.image.width = static_cast<png_uint_32>(image.width);
  png.image.height = static_cast<png_uint_32>(image.height);
  png.image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&png.image, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) == 0)
    throw EnvironmentError(fmt::format("cannot encode a PNG picture: {}", png.image.message));
  bytes.resize(size);
  return bytes;
}

Image decode_png(std::string_view bytes) {
  PngHandle png;
  if (png_image_begin_read_from_memory(&png.image, bytes.data(), bytes.size()) == 0)
    throw InputError(fmt::format("error: not a PNG picture: {}", png.image.message));
  png.image.format = PNG_FORMAT_RGB;
  Image image = make_image(static_cast<int>(png.image.width), static_cast<int>(png.image.height), {});
  const png_color white{255, 255, 255};
  if (png_image_finish_read(&png.image, &white, image.rgb.data(), 0, nullptr) == 0)
    throw InputError(fmt::format("error: damaged PNG picture: {}", png.image.message));
  return image;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  write_atomically(path, encode_png(image));
}

Image read_png(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("error: cannot read the picture '{}'", path.string()));
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return decode_png(bytes);
}

}  // namespace recoil
