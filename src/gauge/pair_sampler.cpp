#include "gauge/pair_sampler.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace recoil {

namespace {

/// Places of the sums and maxima of one pair in a row of OrderedSums.
template <int Dim>
struct At {
  static constexpr std::size_t area = 0, traction = 1, velocity = 2, gap = 3, work = 4, force = 5,
                               impulse = force + Dim, place = impulse + Dim, sums = place + Dim;
  static constexpr std::size_t widest = sums, deepest = sums + 1;
};

template <int Dim>
void put(const Vec<Dim>& v, double* to) {
  for (int d = 0; d < Dim; ++d) to[d] = v[d];
}

template <int Dim>
std::array<double, 3> take(const double* from) {
  std::array<double, 3> v{};
  for (std::size_t d = 0; d < Dim; ++d) v[d] = from[d];
  return v;
}

}  // namespace

template <int Dim>
PairSampler<Dim>::PairSampler(int bodies, OrderedSums& sums) : pairs_(bodies * (bodies - 1) / 2) {
  for (int p = 0; p < pairs_; ++p) {
    const int item = sums.item(At<Dim>::sums, 2);
    if (p == 0) first_ = item;
  }
}

template <int Dim>
void PairSampler<Dim>::collect(const State<Dim>& state, OrderedSums& sums) const {
  using A = At<Dim>;
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    const auto& pairs = state.ledger[slot].pairs;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const PairRecord<Dim>& r = pairs[p];
      if (r.area == 0 && r.exchanged.energy == 0 && r.exchanged.momentum == Vec<Dim>{}) continue;
      double* to = sums.add(first_ + static_cast<int>(p), state.mesh.block(slot).order).data();
      to[A::area] = r.area, to[A::traction] = r.traction, to[A::velocity] = r.velocity, to[A::gap] = r.gap;
      to[A::work] = r.exchanged.energy;
      put(r.force, to + A::force);
      put(r.exchanged.momentum, to + A::impulse);
      put(r.place, to + A::place);
      if (r.area > 0) to[A::widest] = r.widest_gap, to[A::deepest] = -r.deepest_overlap;
    }
  }
}

template <int Dim>
std::vector<PairSample> PairSampler<Dim>::read(const OrderedSums& sums) const {
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
