#pragma once

#include <array>
#include <cstddef>

namespace recoil {

/// The index of a cell, node or block; one integer per dimension.
template <int Dim>
struct Index {
  std::array<int, Dim> c{};

  constexpr int& operator[](int d) { return c[d]; }
  constexpr int operator[](int d) const { return c[d]; }
  friend constexpr Index operator+(Index a, const Index& b) {
    for (int d = 0; d < Dim; ++d) a[d] += b[d];
    return a;
  }
  friend constexpr Index operator-(Index a, const Index& b) {
    for (int d = 0; d < Dim; ++d) a[d] -= b[d];
    return a;
  }
  friend constexpr bool operator==(const Index&, const Index&) = default;
};

/// The half-open box of indices lo <= i < hi, numbered with the first axis fastest.
template <int Dim>
struct Box {
  Index<Dim> lo{}, hi{};

  constexpr int extent(int d) const { return hi[d] - lo[d]; }
  constexpr int size() const {
    int n = 1;
    for (int d = 0; d < Dim; ++d) n *= extent(d);
    return n;
  }
  constexpr bool contains(const Index<Dim>& i) const {
    for (int d = 0; d < Dim; ++d)
      if (i[d] < lo[d] || i[d] >= hi[d]) return false;
    return true;
  }
  /// Distance in memory between neighbours along axis d.
  constexpr int stride(int d) const {
    int s = 1;
    for (int e = 0; e < d; ++e) s *= extent(e);
    return s;
  }
  constexpr int at(const Index<Dim>& i) const {
    int k = 0;
    for (int d = Dim - 1; d >= 0; --d) k = k * extent(d) + (i[d] - lo[d]);
    return k;
  }
  constexpr Index<Dim> index(int k) const {
    Index<Dim> i;
    for (int d = 0; d < Dim; ++d) {
      i[d] = lo[d] + k % extent(d);
      k /= extent(d);
    }
    return i;
  }
  constexpr Box grown(int n) const {
    Box b = *this;
    for (int d = 0; d < Dim; ++d) {
      b.lo[d] -= n;
      b.hi[d] += n;
    }
    return b;
  }
  friend constexpr bool operator==(const Box&, const Box&) = default;
};

/// Calls f(index) for every index of the box, first axis fastest.
template <int Dim, class F>
constexpr void for_each(const Box<Dim>& box, F&& f) {
  const Index<Dim> lo = box.lo, hi = box.hi;
  for (int d = 0; d < Dim; ++d)
    if (hi[d] <= lo[d]) return;
  Index<Dim> i = lo;
  for (;;) {
    for (i[0] = lo[0]; i[0] < hi[0]; ++i[0]) f(i);
    int d = 1;
    for (; d < Dim; ++d) {
      if (++i[d] < hi[d]) break;
      i[d] = lo[d];
    }
    if (d == Dim) return;
  }
}

/// x to the power Dim, for small integers.
template <int Dim>
constexpr int power(int x) {
  int p = 1;
  for (int d = 0; d < Dim; ++d) p *= x;
  return p;
}

}  // namespace recoil
