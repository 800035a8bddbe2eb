#pragma once

#include <functional>
#include <numbers>
#include <vector>

#include "core/vec.hpp"

namespace recoil {

/// A pressure from outside on the free surface of a deformable body.
template <int Dim>
struct SurfaceLoad {
  int body = 0;
  Vec<Dim> facing;  // length 1: it acts where the outward normal is within 45 degrees of it; 0: everywhere
  /// Its mean between two times [s] at a place [m], in Pa. For several threads at once.
  std::function<double(const Vec<Dim>& x, double from, double to)> pressure;
};

/// The pressure of all loads on a body at a point x of its surface with the outward normal n, as a mean
/// between two times [Pa].
template <int Dim>
double pressure_of(const std::vector<SurfaceLoad<Dim>>& loads, int body, const Vec<Dim>& x, const Vec<Dim>& n,
                   double from, double to) {
  constexpr double least_cosine = 1 / std::numbers::sqrt2;  // of 45 degrees
  double sum = 0;
  for (const SurfaceLoad<Dim>& load : loads) {
    if (load.body != body) continue;
    if (load.facing != Vec<Dim>{} && !(dot(load.facing, n) > least_cosine)) continue;
    sum += load.pressure(x, from, to);
  }
  return sum;
}

}  // namespace recoil
