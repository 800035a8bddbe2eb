#pragma once

#include <array>
#include <cmath>

namespace recoil {

/// A vector of Dim components (m, m/s, ... as the caller says).
template <int Dim>
struct Vec {
  std::array<double, Dim> c{};

  constexpr double& operator[](int d) { return c[d]; }
  constexpr double operator[](int d) const { return c[d]; }

  constexpr Vec& operator+=(const Vec& b) {
    for (int d = 0; d < Dim; ++d) (*this)[d] += b[d];
    return *this;
  }
  constexpr Vec& operator-=(const Vec& b) {
    for (int d = 0; d < Dim; ++d) (*this)[d] -= b[d];
    return *this;
  }
  constexpr Vec& operator*=(double s) {
    for (int d = 0; d < Dim; ++d) (*this)[d] *= s;
    return *this;
  }
  friend constexpr Vec operator+(Vec a, const Vec& b) { return a += b; }
  friend constexpr Vec operator-(Vec a, const Vec& b) { return a -= b; }
  friend constexpr Vec operator-(Vec a) { return a *= -1.0; }
  friend constexpr Vec operator*(Vec a, double s) { return a *= s; }
  friend constexpr Vec operator*(double s, Vec a) { return a *= s; }
  friend constexpr bool operator==(const Vec&, const Vec&) = default;
};

template <int Dim>
constexpr double dot(const Vec<Dim>& a, const Vec<Dim>& b) {
  double s = 0;
  for (int d = 0; d < Dim; ++d) s += a[d] * b[d];
  return s;
}

template <int Dim>
inline double norm(const Vec<Dim>& a) {
  return std::sqrt(dot(a, a));
}

/// a / |a|, or the zero vector where a is zero.
template <int Dim>
inline Vec<Dim> unit(const Vec<Dim>& a) {
  const double n = norm(a);
  return n > 0 ? a * (1 / n) : Vec<Dim>{};
}

/// The axis along which |a| is largest; the lower one of equals.
template <int Dim>
constexpr int main_axis(const Vec<Dim>& a) {
  int best = 0;
  for (int d = 1; d < Dim; ++d)
    if ((a[d] < 0 ? -a[d] : a[d]) > (a[best] < 0 ? -a[best] : a[best])) best = d;
  return best;
}

}  // namespace recoil
