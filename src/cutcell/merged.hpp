#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "state/body.hpp"

namespace recoil {

/// How a neighbourhood of redistribution turns as a rigid body about its centre: the antisymmetric part of
/// the velocity gradient of its small fragment's fit. One velocity for all its members would take angular
/// momentum from matter that turns.
template <int Dim>
class Turning {
 public:
  Turning() = default;
  /// What the donors of the fit differ by is the most that velocities change by in a cell: where these lie
  /// close together, as in torn matter, the gradient means little.
  /// @param part of the turning that is kept.
  Turning(const Wall<Dim>& wall, double part) {
    constexpr auto u = static_cast<std::size_t>(Components<Dim>::u);
    const double most = wall.velocity_range();
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j) {
        const double rate = 0.5 * (wall.gradient[u + i][j] - wall.gradient[u + j][i]);
        rate_[i][j] = part * std::clamp(rate, -most, most);
      }
  }

  /// What it adds to densities of the given mean at x [cells] from the centre: momentum, and the kinetic
  /// energy that goes with it to first order. Linear in x, so that it adds nothing to the sum over the
  /// members.
  Contents<Dim> change(const Contents<Dim>& mean, const Vec<Dim>& x) const {
    using C = Components<Dim>;
    Contents<Dim> q{};
    for (int d = 0; d < Dim; ++d) {
      const double velocity = dot(rate_[d], x);
      q[C::u + d] = mean[C::rho] * velocity;
      q[C::energy] += mean[C::u + d] * velocity;
    }
    return q;
  }

 private:
  std::array<Vec<Dim>, Dim> rate_{};
};

/// The densities that a neighbourhood shares: their mean, how they turn, and a slope along one axis.
template <int Dim>
struct Merged {
  bool known = false, possible = false;
  Vec<Dim> centre;  // in cells
  Contents<Dim> mean{}, slope{};
  Turning<Dim> turning;

  /// What it gives a fragment. @param axis of the slope, -1: none.
  Contents<Dim> at(const Vec<Dim>& centroid, int axis) const {
    const Vec<Dim> x = centroid - centre;
    Contents<Dim> q = turning.change(mean, x);
    for (std::size_t c = 0; c < q.size(); ++c) q[c] = mean[c] + (axis >= 0 ? slope[c] * x[axis] : 0) + q[c];
    return q;
  }
};

}  // namespace recoil
