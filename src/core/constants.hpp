#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include "core/multiversion.hpp"

namespace recoil {

/// f(k) for k from 0 to n - 1, each k a constant to the compiler (std::integral_constant<int, k>). A loop
/// over cells with such inner loops is one for vectors; with ordinary ones g++ leaves it to scalar code.
template <int n, class F>
RECOIL_INLINE constexpr void for_each_constant(F&& f) {
  [&]<int... k>(std::integer_sequence<int, k...>) RECOIL_INLINE {
    (f(std::integral_constant<int, k>{}), ...);
  }
  (std::make_integer_sequence<int, n>{});
}

/// The same for every axis.
template <int Dim, class F>
RECOIL_INLINE constexpr void for_each_axis(F&& f) {
  for_each_constant<Dim>(std::forward<F>(f));
}

}  // namespace recoil
