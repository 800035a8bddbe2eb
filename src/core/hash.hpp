#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace recoil {

/// 64-bit hash of bytes: FNV-1a over words of eight bytes, the last one filled up with zeros. Tells damage,
/// not malice.
inline std::uint64_t hash_of(const void* data, std::size_t bytes) {
  const auto* from = static_cast<const char*>(data);
  std::uint64_t hash = 14695981039346656037ULL ^ bytes;
  const auto mix = [&](std::uint64_t word) {
    hash = (hash ^ word) * 1099511628211ULL;
    hash ^= hash >> 29;
  };
  std::uint64_t word = 0;
  std::size_t k = 0;
  for (; k + sizeof word <= bytes; k += sizeof word) {
    std::memcpy(&word, from + k, sizeof word);
    mix(word);
  }
  if (k < bytes) {
    word = 0;
    std::memcpy(&word, from + k, bytes - k);
    mix(word);
  }
  return hash;
}

}  // namespace recoil
