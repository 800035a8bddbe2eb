#include "contact/seed_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace recoil {

namespace {

constexpr std::size_t most_terms = 8;  // 1, x, y, z, xy, xz, yz, xyz
using Row = std::array<double, most_terms + 1>;

/// Product of those coordinates whose bit is set in `term`.
double monomial(std::size_t term, int dim, const double* x) {
  double p = 1;
  for (int d = 0; d < dim; ++d)
    if ((term >> d & 1) != 0) p *= x[d];
  return p;
}

/// Gauss elimination with pivots; the right-hand side is column n. @returns whether it is regular.
bool eliminate(std::array<Row, most_terms>& m, std::size_t n) {
  double scale = 0;
  for (std::size_t i = 0; i < n; ++i) scale = std::max(scale, std::abs(m[i][i]));
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < n; ++r)
      if (std::abs(m[r][c]) > std::abs(m[pivot][c])) pivot = r;
    if (!(std::abs(m[pivot][c]) > 1e-10 * scale)) return false;
    std::swap(m[c], m[pivot]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c) continue;
      const double f = m[r][c] / m[c][c];
      for (std::size_t k = c; k <= n; ++k) m[r][k] -= f * m[c][k];
    }
  }
  return true;
}

}  // namespace

bool colliding(double phi_l, double phi_k, double kappa, double dx) {
  return std::abs(phi_l + phi_k) < kappa * dx;
}

double interface_traction(const CollidingNode& first, const CollidingNode& second) {
  const double w1 = first.distance, w2 = second.distance;
  if (!(w1 + w2 > 0)) return 0.5 * (first.traction + second.traction);
  return (w2 * first.traction + w1 * second.traction) / (w1 + w2);
}

bool presses(double traction, double closing, bool was_in_contact) {
  return traction < 0 || (!was_in_contact && closing > 0);
}

Touch join(const ContactSide& first, const ContactSide& second) {
  const double za = first.impedance, zb = second.impedance;
  const double va = free_velocity(first.velocity, first.stress, za);
  const double vb = free_velocity(second.velocity, -second.stress, zb);
  Touch t;
  t.touching = true;
  t.traction = (vb - va) * za * zb / (za + zb);
  t.first_velocity = t.second_velocity = t.work_velocity = (za * va + zb * vb) / (za + zb);
  return t;
}

Touch join_rigid(const ContactSide& body, double wall_velocity) {
  Touch t;
  t.touching = true;
  t.traction = (wall_velocity - free_velocity(body.velocity, body.stress, body.impedance)) * body.impedance;
  t.first_velocity = t.second_velocity = t.work_velocity = wall_velocity;
  return t;
}

bool fit_at_origin(int dim, std::span<const double> places, std::span<const double> values,
                   double& at_origin) {
  const std::size_t terms = std::size_t{1} << dim;
  if (values.size() < terms) return false;
  std::array<Row, most_terms> m{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double* x = places.data() + i * static_cast<std::size_t>(dim);
    for (std::size_t r = 0; r < terms; ++r) {
      const double by = monomial(r, dim, x);
      for (std::size_t c = 0; c < terms; ++c) m[r][c] += by * monomial(c, dim, x);
      m[r][terms] += by * values[i];
    }
  }
  if (!eliminate(m, terms)) return false;
  at_origin = m[0][terms] / m[0][0];  // the coefficient of 1
  return true;
}

}  // namespace recoil
