#pragma once

#include <cmath>

namespace recoil {

/// a b + c, rounded once where the processor has such an instruction. The compiler never contracts on its own
/// (docs/decisions/0001): only where this stands are the two operations one, and so in every copy of a loop
/// alike.
[[gnu::always_inline]] inline double mul_add(double a, double b, double c) {
#ifdef __FMA__
  return std::fma(a, b, c);
#else
  return a * b + c;
#endif
}

}  // namespace recoil
