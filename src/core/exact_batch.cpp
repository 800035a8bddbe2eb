#include "core/exact_batch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/multiversion.hpp"

namespace recoil {

namespace {

// Terms outside these are added one by one. From the lower one on a term has no bit below those that an
// ExactSum keeps.
constexpr double smallest = 0x1p-100, largest = 0x1p84;
constexpr int spare_bits = 11;  // so that most_terms parts add up without rounding

/// The largest |term|, and whether some must be added one by one.
struct Range {
  double largest = 0;
  bool odd = false;
};

RECOIL_MULTIVERSION
Range find_range(std::span<const double> terms) {
  double most = 0, least = largest, not_finite = 0;
#pragma omp simd reduction(max : most) reduction(min : least) reduction(+ : not_finite)
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const double size = std::abs(terms[k]);
    most = std::max(most, size);
    least = std::min(least, size > 0 ? size : largest);
    not_finite += size - size;
  }
  return {most, !(least >= smallest && most < largest && not_finite == 0)};
}

void add_odd(std::span<double> terms, ExactSum& to) {
  for (double& x : terms) {
    const double size = std::abs(x);
    if (size >= smallest && size < largest) continue;
    to += x;
    x = 0;
  }
}

/// Cuts off the leading parts of all terms. @returns the largest rest.
RECOIL_MULTIVERSION
double cut(std::span<double> terms, double most, ExactSum& to) {
  const double sigma = std::ldexp(1.0, std::ilogb(most) + 1 + spare_bits);
  double sum = 0, rest = 0;
#pragma omp simd reduction(+ : sum) reduction(max : rest)
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const double part = (sigma + terms[k]) - sigma;
    terms[k] -= part;
    sum += part;
    rest = std::max(rest, std::abs(terms[k]));
  }
  to += sum;
  return rest;
}

}  // namespace

void add_all(std::span<double> terms, ExactSum& to) {
  Range range = find_range(terms);
  if (range.odd) {
    add_odd(terms, to);
    range = find_range(terms);
  }
  for (double rest = range.largest; rest > 0;) rest = cut(terms, rest, to);
}

}  // namespace recoil
