#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace recoil {

/// Marks of a row of cells are bytes, 0 or not; behind the last one are marks_beyond more that may be read.
inline constexpr int marks_beyond = 8;

/// Whether any of a row of marks, or of those that fill up the last eight, is not 0.
inline bool any_set(const std::uint8_t* marks, int count) {
  std::uint64_t all = 0;
  for (int c = 0; c < count; c += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, marks + c, sizeof eight);
    all |= eight;
  }
  return all != 0;
}

/// f(c) for every mark c of a row that is not 0. Few are: eight are looked at together.
template <class F>
void for_each_set(const std::uint8_t* marks, int count, F&& f) {
  for (int first = 0; first < count; first += 8) {
    if (!any_set(marks + first, 8)) continue;
    const int end = first + 8 < count ? first + 8 : count;
    for (int c = first; c < end; ++c)
      if (marks[c] != 0) f(c);
  }
}

}  // namespace recoil
