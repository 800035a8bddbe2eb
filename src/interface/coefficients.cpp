#include "interface/coefficients.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "core/constants.hpp"
#include "core/multiversion.hpp"

namespace recoil {

namespace {

// In the mean of a fit donors count more than in its gradient the nearer they lie to the surface's normal
// through the surface point: by this part there, falling along the surface at this rate [1/dx^2]. A mean of
// all alike would average away waves along the surface that are two cells long: the wall would not answer to
// its own cell, and these waves would grow (docs/decisions/0066).
constexpr double middle_part = 0.5, decay_middle = 2;
// Beside contact, in matter that never yields, the mean is that of the nearest donors, with weights that fall
// faster by this rate in all directions: reconstructions have less dissipation there (docs/decisions/0043).
constexpr double decay_nearest = 1.8;
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

/// The weight of a donor in the mean, over that in the gradient. @param at its place from the surface point
/// [dx].
template <int Dim>
double in_mean(const Vec<Dim>& at, const Vec<Dim>& normal, bool by_nearest) {
  const double square = dot(at, at);
  if (by_nearest) return std::exp(-decay_nearest * square);
  if (Dim == 1) return 1;
  const double across = dot(at, normal);
  return 1 + middle_part * std::exp(-decay_middle * (square - across * across));
}

}  // namespace

template <int Dim>
void find_coefficients(Wall<Dim>& wall, Donors<Dim>& donors, const Vec<Dim>& normal, bool by_nearest) {
  Donor<Dim>* const first = donors.parts.data() + wall.first_donor;
  Moments<Dim> sums;
  find_moments<Dim>(first, wall.donors, sums);
  Matrix<Dim>& second = sums.second;
  const Vec<Dim> mean = sums.first * (1 / sums.total);
  for (int d = 0; d < Dim; ++d)
    for (int e = d; e < Dim; ++e) second[d][e] = second[e][d] = second[d][e] - sums.total * mean[d] * mean[e];
  const Matrix<Dim> a = damped_inverse<Dim>(second, fit_ridge * sums.total);
  double weights = 0;
  wall.donor_centre = {};
  for (Donor<Dim>* it = first; it != first + wall.donors; ++it) {
    const Vec<Dim> at = it->slope_weight, x = at - mean;
    for (int d = 0; d < Dim; ++d) it->slope_weight[d] = it->weight * dot(a[d], x);
    it->weight *= in_mean(at, normal, by_nearest);
    weights += it->weight;
    wall.donor_centre += it->weight * at;
  }
  wall.donor_centre *= 1 / weights;
  for (Donor<Dim>* it = first; it != first + wall.donors; ++it) it->weight /= weights;
}

#define RECOIL_INSTANTIATE(Dim) \
  template void find_coefficients<Dim>(Wall<Dim>&, Donors<Dim>&, const Vec<Dim>&, bool);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
