#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace recoil {

/// Bytes as text of the 64 characters of RFC 4648, padded with '='.
std::string base64(std::string_view bytes);

/// Bytes compressed as a zlib stream. @throws InternalError where zlib fails.
std::string deflated(std::string_view bytes);

/// Whole numbers for a page: the difference of each to the one before, its sign in the lowest bit (zigzag),
/// in groups of 7 bits from the lowest (LEB128); compressed, as text.
std::string packed_integers(std::span<const std::int32_t> values);

/// Numbers for a page: little-endian IEEE single precision, compressed, as text.
std::string packed_floats(std::span<const float> values);

}  // namespace recoil
