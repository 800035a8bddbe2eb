#include "format/packed.hpp"

#include <zlib.h>

#include <bit>
#include <cstddef>

#include "core/error.hpp"

namespace recoil {

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t three = 0;
    for (std::size_t n = 0; n < 3; ++n)
      three = three << 8 | (k + n < bytes.size() ? static_cast<unsigned char>(bytes[k + n]) : 0U);
    for (std::size_t n = 0; n < 4; ++n)
      text += k + n <= bytes.size() ? digits[three >> (18 - 6 * n) & 63U] : '=';
  }
  return text;
}

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  const int done =
      compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), 6);
  require(done == Z_OK, "zlib compresses what fits into memory");
  out.resize(size);
  return out;
}

std::string packed_integers(std::span<const std::int32_t> values) {
  std::string bytes;
  bytes.reserve(values.size() + values.size() / 4);
  std::int64_t before = 0;
  for (const std::int64_t v : values) {
    const std::int64_t step = v - before;
    auto left = static_cast<std::uint64_t>(step >= 0 ? 2 * step : -2 * step - 1);
    for (; left > 127; left >>= 7) bytes += static_cast<char>((left & 127U) | 128U);
    bytes += static_cast<char>(left);
    before = v;
  }
  return base64(deflated(bytes));
}

std::string packed_floats(std::span<const float> values) {
  static_assert(std::endian::native == std::endian::little, "pages hold little-endian numbers");
  return base64(deflated({reinterpret_cast<const char*>(values.data()), values.size_bytes()}));
}

}  // namespace recoil
