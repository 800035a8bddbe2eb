#pragma once

#include <cstdint>

#include "core/vec.hpp"

namespace recoil {

/// The same numbers on every machine: splitmix64 (Steele, Lea & Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  double operator()(double low, double high) {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ z >> 27) * 0x94d049bb133111ebULL;
    z ^= z >> 31;
    return low + (high - low) * static_cast<double>(z >> 11) / 9007199254740992.0;
  }
  template <int Dim>
  Vec<Dim> vector(double low, double high) {
    Vec<Dim> v;
    for (int d = 0; d < Dim; ++d) v[d] = (*this)(low, high);
    return v;
  }

 private:
  std::uint64_t state_;
};

}  // namespace recoil
