#include "interface/coefficients.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "core/constants.hpp"
#include "core/multiversion.hpp"

namespace recoil {

namespace {

// Second moments of the donors [dx^2] below which a gradient is damped (damped_inverse()).
constexpr double fit_ridge = 0.006;

/// Four numbers that are computed with at once.
using Four [[gnu::vector_size(32)]] = double;

template <int Dim>
using Matrix = std::array<Vec<Dim>, Dim>;

/// Inverse of a symmetric positive matrix by its adjugate.
template <int Dim>
Matrix<Dim> inverse(const Matrix<Dim>& m) {
  Matrix<Dim> a;
  if constexpr (Dim == 1) {
    a[0][0] = 1 / m[0][0];
  } else if constexpr (Dim == 2) {
    const double det = 1 / (m[0][0] * m[1][1] - m[0][1] * m[0][1]);
    a[0][0] = m[1][1] * det;
    a[1][1] = m[0][0] * det;
    a[0][1] = a[1][0] = -m[0][1] * det;
  } else {
    const double c00 = m[1][1] * m[2][2] - m[1][2] * m[1][2], c01 = m[0][2] * m[1][2] - m[0][1] * m[2][2],
                 c02 = m[0][1] * m[1][2] - m[0][2] * m[1][1];
    const double det = 1 / (m[0][0] * c00 + m[0][1] * c01 + m[0][2] * c02);
    a[0][0] = c00 * det;
    a[0][1] = a[1][0] = c01 * det;
    a[0][2] = a[2][0] = c02 * det;
    a[1][1] = (m[0][0] * m[2][2] - m[0][2] * m[0][2]) * det;
    a[1][2] = a[2][1] = (m[0][2] * m[0][1] - m[0][0] * m[1][2]) * det;
    a[2][2] = (m[0][0] * m[1][1] - m[0][1] * m[0][1]) * det;
  }
  return a;
}

/// m (m m + r^2)^-1, which stands for the inverse of a symmetric matrix m of second moments (Tikhonov's
/// regularisation of the least-squares problem of m itself). Of an eigenvalue far above r it is 1/m less the
/// part (r/m)^2, at r as much as (m + r)^-1, and 0 at 0. (m + r)^-1 takes the part r/m of every gradient, 1
/// to 3 %, and so brakes a body that turns (docs/decisions/0049).
template <int Dim>
Matrix<Dim> damped_inverse(const Matrix<Dim>& m, double r) {
  Matrix<Dim> square{}, a{};
  for (int d = 0; d < Dim; ++d)
    for (int e = 0; e < Dim; ++e) square[d][e] = dot(m[d], m[e]) + (d == e ? r * r : 0);
  const Matrix<Dim> inverted = inverse<Dim>(square);
  for (int d = 0; d < Dim; ++d)
    for (int e = 0; e < Dim; ++e) a[d][e] = dot(m[d], inverted[e]);
  return a;
}

/// The weight of a donor and, behind it, its place (kept in slope_weight).
template <int Dim>
[[gnu::always_inline]] inline void read_donor(const Donor<Dim>& donor, Four& v) {
  static_assert(offsetof(Donor<Dim>, slope_weight) == offsetof(Donor<Dim>, weight) + sizeof(double));
  v = Four{};
  std::memcpy(&v, &donor.weight, (1 + Dim) * sizeof(double));
}

/// Sums over donors: of the weights, of these times the places, and times the places once more.
template <int Dim>
struct Moments {
  double total = 0;
  Vec<Dim> first;
  Matrix<Dim> second;
};

template <int Dim>
RECOIL_MULTIVERSION void find_moments(const Donor<Dim>* donors, int count, Moments<Dim>& out) {
  double total = 0;
  Four first{};
  std::array<Four, Dim> second{};
  for (int k = 0; k < count; ++k) {
    Four donor;
    read_donor(donors[k], donor);
    const Four weighted = donor[0] * donor;
    total += donor[0];
    first += weighted;
    for_each_axis<Dim>([&](auto d) RECOIL_INLINE { second[d] += weighted[d + 1] * donor; });
  }
  out.total = total;
  for_each_axis<Dim>([&](auto d) RECOIL_INLINE {
    out.first[d] = first[d + 1];
    for_each_axis<Dim>([&](auto e) RECOIL_INLINE { out.second[d][e] = second[d][e + 1]; });
  });
}

/// From the places of donors to the coefficients of the gradient: weight times a (place - mean).
template <int Dim>
RECOIL_MULTIVERSION void set_slope_weights(const Matrix<Dim>& a, const Vec<Dim>& mean, int count,
                                           Donor<Dim>* donors) {
  Four middle{};
  std::array<Four, Dim> column{};
  for_each_axis<Dim>([&](auto d) RECOIL_INLINE {
    middle[d + 1] = mean[d];
    for_each_axis<Dim>([&](auto e) RECOIL_INLINE { column[e][d + 1] = a[d][e]; });
  });
  for (int k = 0; k < count; ++k) {
    Four donor, sum{};
    read_donor(donors[k], donor);
    const Four x = donor - middle;
    for_each_axis<Dim>([&](auto e) RECOIL_INLINE { sum += column[e] * x[e + 1]; });
    const Four slope = donor[0] * sum;
    for_each_axis<Dim>([&](auto d) RECOIL_INLINE { donors[k].slope_weight[d] = slope[d + 1]; });
  }
}

}  // namespace

template <int Dim>
void find_coefficients(Wall<Dim>& wall, FieldArray<Donor<Dim>>& donors, const Vec<Dim>& normal,
                       const Narrower& mean_by) {
  Donor<Dim>* const first = donors.data() + wall.first_donor;
  Moments<Dim> sums;
  find_moments<Dim>(first, wall.donors, sums);
  Matrix<Dim>& second = sums.second;
  const Vec<Dim> mean = sums.first * (1 / sums.total);
  for (int d = 0; d < Dim; ++d)
    for (int e = d; e < Dim; ++e) second[d][e] = second[e][d] = second[d][e] - sums.total * mean[d] * mean[e];
  const Matrix<Dim> a = damped_inverse<Dim>(second, fit_ridge * sums.total);
  double weights = sums.total;
  if (mean_by.along > 0 || mean_by.around > 0) {
    weights = 0;
    wall.donor_centre = {};
    for (Donor<Dim>* it = first; it != first + wall.donors; ++it) {
      const Vec<Dim> at = it->slope_weight, x = at - mean;
      for (int d = 0; d < Dim; ++d) it->slope_weight[d] = it->weight * dot(a[d], x);
      const double across = dot(at, normal), square = dot(at, at);
      it->weight *= std::exp(-mean_by.along * (square - across * across) - mean_by.around * square);
      weights += it->weight;
      wall.donor_centre += it->weight * at;
    }
    wall.donor_centre *= 1 / weights;
  } else {
    wall.donor_centre = mean;
    set_slope_weights<Dim>(a, mean, wall.donors, first);
  }
  for (Donor<Dim>* it = first; it != first + wall.donors; ++it) it->weight /= weights;
}

#define RECOIL_INSTANTIATE(Dim) \
  template void find_coefficients<Dim>(Wall<Dim>&, FieldArray<Donor<Dim>>&, const Vec<Dim>&, const Narrower&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
