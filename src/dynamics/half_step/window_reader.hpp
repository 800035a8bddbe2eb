#pragma once

#include <cstddef>

#include "core/multiversion.hpp"
#include "dynamics/half_step/half_step.hpp"

namespace recoil::detail {

/// Differences of the primitives along one axis.
template <int Dim>
struct Differences {
  Primitives<Dim> slope;   // per metre, of fourth order
  Primitives<Dim> fourth;  // the fourth difference
  Primitives<Dim> bend;    // the same, or what stands for it beside surfaces
};

/// Reads cells of the window, and their differences. Open: some cells of the window have no value.
template <int Dim, bool Open>
struct WindowReader {
  const double* primitive;
  const double* impedance;
  const double* open;  // 1 where a cell has a value, 0 where not
  const double* own;   // 1 where that is its own average, 0 where it follows from a wall
  std::size_t wide;
  double per_dx;        // 1/(2 dx)
  const double* shear;  // shear modulus

  /// Of differences: in the slope those to the neighbours below and above and those beyond; the fourth one
  /// where all five cells have averages of their own, and in the bend, with the second one that stands for
  /// it.
  struct Weights {
    double low, high, far = 0, fourth = 0, bend = 0, second = 0;
  };
  [[gnu::always_inline]] Weights weights_of_four(std::ptrdiff_t k, std::ptrdiff_t step) const {
    const double near = 7.0 / 6 * per_dx, far = -per_dx / 6;
    if constexpr (!Open) return {near, near, far, 1, 1, 0};
    const Weights two = weights_of_two(k, step);
    const double all = own[k - 2 * step] * own[k - step] * own[k] * own[k + step] * own[k + 2 * step];
    const double both = open[k - step] * open[k] * open[k + step],
                 valued = open[k - 2 * step] * both * open[k + 2 * step];
    return {all > 0 ? near : two.low, all > 0 ? near : two.high, all * far, all, valued,
            -6 * (1 - valued) * both};
  }
  struct Difference {
    double slope, fourth, bend;
  };
  static RECOIL_INLINE Difference difference(const Weights& w, const double* at, std::ptrdiff_t step) {
    const double below = *at - at[-step], above = at[step] - *at, far_below = at[-step] - at[-2 * step],
                 far_above = at[2 * step] - at[step];
    const double fourth = (far_above - far_below) - 3 * (above - below);
    return {(w.low * below + w.high * above) + w.far * (far_below + far_above), w.fourth * fourth,
            w.bend * fourth + w.second * (above - below)};
  }
  /// Of the differences to the lower and to the upper neighbour in a slope.
  [[gnu::always_inline]] Weights weights_of_two(std::ptrdiff_t k, std::ptrdiff_t step) const {
    if constexpr (!Open) return {per_dx, per_dx};
    const double a = open[k - step], b = open[k + step], both = a + b;
    const double each = open[k] * per_dx * 2 / (both > 0 ? both : 1.0);
    return {a * each, b * each};
  }
  [[gnu::always_inline]] Primitives<Dim> at(std::ptrdiff_t k) const {
    Primitives<Dim> w;
    for_each_constant<Components<Dim>::primitives>([&](auto c)
                                                       RECOIL_INLINE { w[c] = primitive[c * wide + k]; });
    return w;
  }
  /// Central differences of `values` [primitives]: one-sided where one of the neighbours has no value, 0
  /// where both have none or the cell itself has none.
  [[gnu::always_inline]] Primitives<Dim> slope(const double* values, std::ptrdiff_t k,
                                               std::ptrdiff_t step) const {
    const Weights near = weights_of_two(k, step);
    Primitives<Dim> s;
    for_each_constant<Components<Dim>::primitives>([&](auto c) RECOIL_INLINE {
      const double* at = values + c * wide + k;
      s[c] = near.low * (*at - at[-step]) + near.high * (at[step] - *at);
    });
    return s;
  }
  /// Of the primitives of five cells; where one of them has no average of its own as slope(), and no fourth
  /// difference: of ghost values it would brake a body that turns.
  [[gnu::always_inline]] Differences<Dim> differences(std::ptrdiff_t k, std::ptrdiff_t step) const {
    const Weights weights = weights_of_four(k, step);
    Differences<Dim> d;
    for_each_constant<Components<Dim>::primitives>([&](auto c) RECOIL_INLINE {
      const Difference of = difference(weights, primitive + c * wide + k, step);
      d.slope[c] = of.slope;
      d.fourth[c] = of.fourth;
      d.bend[c] = of.bend;
    });
    return d;
  }
  RECOIL_INLINE Response response(std::ptrdiff_t k, const double* loading) const {
    const double z = impedance[k], g = shear[k];
    return {z * z / primitive[k] - 4.0 / 3 * g, g, loading[k]};
  }
};

}  // namespace recoil::detail
