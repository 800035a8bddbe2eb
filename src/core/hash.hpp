#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace recoil {

/// 64-bit hash of bytes: FNV-1a over words of eight bytes, the last one filled up with zeros. Tells damage,
/// not malice.
inline std::uint64_t hash_of(const void* data, std::size_t bytes) {
  const auto* from = static_cast<const char*>(data);
  std::uint64_t hash = 14695981039346656037ULL ^ bytes;
  for (std::size_t k = 0; k < bytes; k += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, from + k, std::min(sizeof word, bytes - k));
    hash = (hash ^ word) * 1099511628211ULL;
    hash ^= hash >> 29;
  }
  return hash;
}

}  // namespace recoil
