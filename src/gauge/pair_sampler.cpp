#include "gauge/pair_sampler.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace recoil {

namespace {

/// Places of the sums and maxima of one pair in a row of ExactSums.
template <int Dim>
struct At {
  static constexpr std::size_t area = 0, traction = 1, velocity = 2, gap = 3, work = 4, force = 5,
                               impulse = force + Dim, place = impulse + Dim, sums = place + Dim;
  static constexpr std::size_t widest = sums, deepest = sums + 1, minus_smallest = sums + 2, maxima = 3;
};

constexpr double near_surface = 1;  // dx from the first surface within which the gap is looked for
constexpr double gap_reach = 5;     // dx from the second

/// The smallest distance between two surfaces in a block [m]: the sum of two signed distances is nowhere
/// less.
double smallest_gap(const FieldArray<double>& first, const FieldArray<double>& second, double dx) {
  constexpr double far = std::numeric_limits<double>::infinity();
  double least = far;
#pragma omp simd reduction(min : least)
  for (std::size_t k = 0; k < first.size(); ++k) {
    const double gap = first[k] + second[k];
    const bool looked_at = std::abs(first[k]) <= near_surface * dx && std::abs(second[k]) < gap_reach * dx;
    least = std::min(least, looked_at ? gap : far);
  }
  return least;
}

template <int Dim>
void add(const ExactVec<Dim>& from, std::span<ExactSum> to) {
  for (std::size_t d = 0; d < Dim; ++d) to[d] += from.c[d];
}

template <int Dim>
std::array<double, 3> take(const double* from) {
  std::array<double, 3> v{};
  for (std::size_t d = 0; d < Dim; ++d) v[d] = from[d];
  return v;
}

}  // namespace

template <int Dim>
PairSampler<Dim>::PairSampler(int bodies, ExactSums& sums) : pairs_(bodies * (bodies - 1) / 2) {
  for (int p = 0; p < pairs_; ++p) {
    const int item = sums.item(At<Dim>::sums, At<Dim>::maxima);
    if (p == 0) first_ = item;
  }
}

template <int Dim>
void PairSampler<Dim>::collect(const State<Dim>& state, ExactSums& sums) const {
  using A = At<Dim>;
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    const auto& pairs = state.ledger[slot].pairs;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const PairRecord<Dim>& r = pairs[p];
      if (r.area.is_zero() && r.exchanged.is_zero()) continue;
      const SumRow to = sums.add(first_ + static_cast<int>(p));
      to[A::area] += r.area, to[A::traction] += r.traction, to[A::velocity] += r.velocity;
      to[A::gap] += r.gap, to[A::work] += r.exchanged.energy;
      add(r.force, to.sums.subspan(A::force, Dim));
      add(r.exchanged.momentum, to.sums.subspan(A::impulse, Dim));
      add(r.place, to.sums.subspan(A::place, Dim));
      if (!r.area.is_zero()) to.raise(A::widest, r.widest_gap), to.raise(A::deepest, -r.deepest_overlap);
    }
  }
  collect_gaps(state, sums);
}

template <int Dim>
void PairSampler<Dim>::collect_gaps(const State<Dim>& state, ExactSums& sums) const {
  const int n = state.count();
  for (int slot = 0; slot < state.mesh.local(); ++slot)
    for (int a = 0; a < n; ++a) {
      const Body<Dim>& first = state.bodies[a];
      if (!first.present(slot) || !first.at(slot).near_surface) continue;
      for (int b = a + 1; b < n; ++b) {
        const Body<Dim>& second = state.bodies[b];
        if (!second.present(slot) || !second.at(slot).near_surface) continue;
        const double gap = smallest_gap(first.at(slot).phi, second.at(slot).phi, state.grid().dx);
        if (!std::isfinite(gap)) continue;
        sums.add(first_ + pair_number(a, b, n)).raise(At<Dim>::minus_smallest, -gap);
      }
    }
}

template <int Dim>
std::vector<PairSample> PairSampler<Dim>::read(const ExactSums& sums) const {
  using A = At<Dim>;
  std::vector<PairSample> all(static_cast<std::size_t>(pairs_));
  for (int p = 0; p < pairs_; ++p) {
    const double* from = sums.total(first_ + p).data();
    PairSample& s = all[p];
    s.area = from[A::area], s.traction = from[A::traction], s.velocity = from[A::velocity],
    s.gap = from[A::gap];
    s.work = from[A::work];
    s.force = take<Dim>(from + A::force);
    s.impulse = take<Dim>(from + A::impulse);
    s.place = take<Dim>(from + A::place);
    s.smallest_gap = -from[A::minus_smallest];
    if (!(s.area > 0)) continue;
    s.widest_gap = std::max(from[A::widest], 0.0);
    s.deepest_overlap = -std::max(from[A::deepest], 0.0);
  }
  return all;
}

template class PairSampler<1>;
template class PairSampler<2>;
template class PairSampler<3>;

}  // namespace recoil
