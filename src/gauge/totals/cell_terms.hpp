#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/exact_batch.hpp"
#include "gauge/totals/body_sums.hpp"
#include "state/body.hpp"

namespace recoil {

/// The terms of cells, which are added up many at a time.
template <int Dim>
class CellTerms {
 public:
  /// Adds a row of cells along x.
  /// @param first its first cell in the block, whose centre is `start`. @param to by BodySums<Dim>.
  void add_row(const BodyBlock<Dim>& b, std::size_t first, std::size_t count, const Grid<Dim>& grid,
               Index<Dim> start, std::span<ExactSum> to) {
    while (count > 0) {
      if (used_ == capacity) flush(to);
      const std::size_t part = std::min(count, capacity - used_);
      add_contents(b, first, part);
      if (b.near_surface && !b.extension_velocity.empty()) correct_slivers(b, first, part, grid, start);
      add_moments(b, first, part, grid, start);
      used_ += part, first += part, count -= part;
      start[0] += static_cast<int>(part);
    }
  }
  void flush(std::span<ExactSum> to) {
    for (std::size_t k = 0; k < BodySums<Dim>::sums; ++k) add_all({terms(k), used_}, to[k]);
    used_ = 0;
  }

 private:
  using C = Components<Dim>;
  using A = BodySums<Dim>;
  static constexpr std::size_t capacity = 256;
  static constexpr double least_fill = 0.1;  // part of a cell from which on its p/m is a velocity
  double* terms(std::size_t sum) { return terms_.data() + sum * capacity; }

  void add_contents(const BodyBlock<Dim>& b, std::size_t first, std::size_t count) {
    const std::size_t n = b.volume.size();
    const double *q = b.contents.data() + first, *v = b.volume.data() + first, *damage = q + C::damage * n;
    double *mass = terms(A::mass) + used_, *kinetic = terms(A::kinetic) + used_,
           *energy = terms(A::energy) + used_, *volume = terms(A::volume) + used_,
           *speed = terms(A::speed) + used_, *cells = terms(A::cells) + used_,
           *failed = terms(A::failed) + used_, *momentum = terms(A::momentum) + used_;
#pragma omp simd
    for (std::size_t k = 0; k < count; ++k) {
      double p2 = 0;
      for (std::size_t d = 0; d < Dim; ++d) {
        const double p = q[(C::u + d) * n + k];
        momentum[d * capacity + k] = p;
        p2 += p * p;
      }
      const double m = q[k];
      mass[k] = m;
      kinetic[k] = m > 0 ? 0.5 * p2 / m : 0.0;
      energy[k] = q[C::energy * n + k];
      volume[k] = v[k];
      speed[k] = std::sqrt(p2);
      cells[k] = v[k] != 0 || m != 0 ? 1.0 : 0.0;
      failed[k] = damage[k] > 0 && damage[k] >= failed_damage * m ? m : 0.0;
    }
  }
  /// What cells have passed on with a neighbour's state may leave a sliver a mass about or below zero, and a
  /// momentum over that mass which is no velocity. Its kinetic energy goes with the velocity u of the surface
  /// there, where that is known: p u - m u^2/2, which differs from p^2/2m by m (p/m - u)^2/2.
  void correct_slivers(const BodyBlock<Dim>& b, std::size_t first, std::size_t count, const Grid<Dim>& grid,
                       Index<Dim> i) {
    const std::size_t n = b.volume.size();
    double* kinetic = terms(A::kinetic) + used_;
    for (std::size_t k = 0; k < count; ++k, ++i[0]) {
      const std::size_t cell = first + k;
      const double m = b.contents[cell];
      if (m > 0 && b.volume[cell] >= least_fill * grid.full_volume(i)) continue;
      Vec<Dim> u, p;
      for (std::size_t d = 0; d < Dim; ++d) {
        u[static_cast<int>(d)] = b.extension_velocity[d * n + cell];
        p[static_cast<int>(d)] = b.contents[(C::u + d) * n + cell];
      }
      if (u != Vec<Dim>{}) kinetic[k] = dot(p, u) - 0.5 * m * dot(u, u);
    }
  }
  void add_moments(const BodyBlock<Dim>& b, std::size_t first, std::size_t count, const Grid<Dim>& grid,
                   Index<Dim> i) {
    const std::size_t n = b.volume.size();
    double *place = terms(A::place) + used_, *angular = terms(A::angular) + used_;
    for (std::size_t k = 0; k < count; ++k, ++i[0]) {
      const Vec<Dim> x = grid.centre(i);
      Vec<Dim> momentum;
      for (std::size_t d = 0; d < Dim; ++d) {
        momentum[static_cast<int>(d)] = b.contents[(C::u + d) * n + first + k];
        place[d * capacity + k] = b.contents[first + k] * x[static_cast<int>(d)];
      }
      const Vec<3> turning = cross(x, momentum);
      for (std::size_t d = 0; d < 3; ++d) angular[d * capacity + k] = turning[static_cast<int>(d)];
    }
  }

  std::vector<double> terms_ = std::vector<double>(BodySums<Dim>::sums * capacity);
  std::size_t used_ = 0;
};

}  // namespace recoil
