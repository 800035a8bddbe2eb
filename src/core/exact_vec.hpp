#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/exact_sum.hpp"
#include "core/vec.hpp"

namespace recoil {

/// A sum of vectors without rounding (ExactSum).
template <int Dim>
struct ExactVec {
  std::array<ExactSum, static_cast<std::size_t>(Dim)> c{};

  ExactVec& operator+=(const Vec<Dim>& b) {
    for (int d = 0; d < Dim; ++d) c[d] += b[d];
    return *this;
  }
  ExactVec& operator+=(const ExactVec& b) {
    for (int d = 0; d < Dim; ++d) c[d] += b.c[d];
    return *this;
  }
  ExactVec& operator-=(const ExactVec& b) {
    for (int d = 0; d < Dim; ++d) c[d] -= b.c[d];
    return *this;
  }
  ExactSum& operator[](int d) { return c[d]; }
  const ExactSum& operator[](int d) const { return c[d]; }

  bool is_zero() const {
    return std::all_of(c.begin(), c.end(), [](const ExactSum& sum) { return sum.is_zero(); });
  }
  /// Each component rounded once.
  Vec<Dim> value() const {
    Vec<Dim> v;
    for (int d = 0; d < Dim; ++d) v[d] = c[d].value();
    return v;
  }
};

}  // namespace recoil
