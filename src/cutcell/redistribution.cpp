#include "cutcell/redistribution.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>

#include "cutcell/geometry.hpp"
#include "cutcell/holders.hpp"
#include "cutcell/merged.hpp"
#include "cutcell/window_contents.hpp"
#include "state/level_set_view.hpp"

namespace recoil {

namespace {

constexpr double member_fill = 0.001;  // least part of a cell that a member fills
constexpr double merge_fill = 0.02;    // least volume of a neighbourhood
// Cells that a negative fragment shares at least (with half of one whole cell it may be nothing), and what it
// is taken to get of its neighbours. Where some are mostly void, the mean density of a small rest means
// nothing.
constexpr double least_shares = 0.25, share_of_others = 0.5, share_beside_voids = 0.2;
constexpr double home_fill = 0.3;  // where lone fragments go
// Differences of density, in parts of it, between the two cells behind a pair: calm ones, and a strong shock.
constexpr double calm_jump = 0.05, shocked_jump = 0.1;
constexpr int reach = 8;  // own cells <- neighbourhoods (2) <- members (2) <- their counts (2 + 2)

double minmod(double a, double b) { return a * b <= 0 ? 0 : std::abs(a) < std::abs(b) ? a : b; }

template <int Dim>
class Redistribution {
 public:
  Redistribution(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters, Scratch& scratch)
      : state_(state),
        grid_(state.grid()),
        body_(body),
        window_(state.mesh, slot, reach, body.at(slot).matter),
        held_(body_, window_),
        counters_(counters),
        scratch_(scratch),
        n_(static_cast<std::size_t>(window_.size())) {}

  void run(BodyBlock<Dim>& block) {
    volume_ = scratch_.take<double>(n_);
    window_.gather([&](int s) { return body_.present(s) ? body_.at(s).volume.data() : nullptr; }, 0.0,
                   Beyond::nothing, volume_);
    index_ = scratch_.take<int>(n_);
    window_.gather([&](int s) { return body_.present(s) ? body_.at(s).geometry.index.data() : nullptr; }, -1,
                   Beyond::nothing, index_);
    role_ = scratch_.take<std::uint8_t>(n_);
    window_.gather([&](int s) { return body_.present(s) ? body_.at(s).role.data() : nullptr; },
                   std::uint8_t{0}, Beyond::nothing, role_);
    if (!find_small()) return;
    gather_phi();
    form_neighbourhoods();
    list_holders();
    write(block);
  }

 private:
  using Q = Contents<Dim>;

  double full(const Index<Dim>& i) const { return grid_.full_volume(i); }

  /// Whether a fragment has become large in this step: fluxes do not see its state yet, so that by itself it
  /// would run away from its neighbours.
  bool has_grown(int k) const { return index_[k] >= 0 && (role_[k] & (donates | regular)) == donates; }

  /// Small fragments whose neighbourhoods may reach an own cell, or be counted by one that does.
  bool find_small() {
    const Box<Dim> inner = window_.inner().grown(reach - 2);
    int count = 0;
    small_ = scratch_.take<Neighbourhood>(static_cast<std::size_t>(inner.size()));
    const int width = inner.extent(0);
    double* target = scratch_.take<double>(static_cast<std::size_t>(width));  // by column
    Index<Dim> column = inner.lo;
    for (int c = 0; c < width; ++c, ++column[0]) target[c] = target_fill * full(column);
    Box<Dim> rows = inner;
    rows.hi[0] = rows.lo[0] + 1;
    for_each(rows, [&](const Index<Dim>& i) {
      const int first = window_.at(i);
      const double* volume = volume_ + first;
      for (int c = 0; c < width; ++c) {
        const int k = first + c;
        if (volume[c] >= target[c] && !has_grown(k)) continue;
        if (volume[c] == 0 && (index_[k] < 0 || held_.nothing(k))) continue;
        small_[count].cell = k;
        small_[count++].alone = false;
      }
    });
    smalls_ = count;
    return count > 0;
  }
  void gather_phi() { phi_ = view_level_set(grid_, body_, window_, &BodyBlock<Dim>::phi, scratch_); }

  void add_member(Neighbourhood& s, const Index<Dim>& i, double& others) {
    const int k = window_.at(i);
    if (volume_[k] <= member_fill * full(i)) return;
    for (int m = 0; m < s.members; ++m)
      if (members_[s.first + m] == k) return;
    members_[s.first + s.members++] = k;
    others += volume_[k];
  }

  /// The inward neighbour along the steepest axis; then the other axes and the diagonals towards the inside,
  /// then all cells around, then those around them: until they hold half a cell, and share least_shares.
  void form(Neighbourhood& s) {
    const Index<Dim> i = window_.box().index(s.cell);
    const double target = target_fill * full(i);
    const Vec<Dim> g = phi_normal(window_.box(), phi_, i, grid_.dx);
    std::array<int, Dim> axis{};
    std::iota(axis.begin(), axis.end(), 0);
    std::stable_sort(axis.begin(), axis.end(), [&](int a, int b) { return std::abs(g[a]) > std::abs(g[b]); });
    s.members = 0;
    members_[s.first + s.members++] = s.cell;
    const bool voids = held_.is_beside_voids(s.cell, volume_[s.cell]);
    const double own_volume = volume_[s.cell], shares = least_shares * full(i),
                 share = voids ? share_beside_voids : share_of_others;
    double others = 0;
    const auto enough = [&] {
      return own_volume + others >= target && (own_volume >= 0 || own_volume + share * others >= shares) &&
             (!voids ||
              held_.balances_mass({members_ + s.first, static_cast<std::size_t>(s.members)}, share));
    };
    const auto inward = [&](int d) { return g[d] > 0 ? -1 : 1; };
    s.axis = axis[0];
    s.direction = inward(axis[0]);
    for (const unsigned subset : axes_by_count<Dim>()) {
      if (subset != 1 && enough()) return;
      if (subset != 1) s.axis = -1;
      Index<Dim> j = i;
      for (int d = 0; d < Dim; ++d)
        if ((subset >> d & 1U) != 0) j[axis[d]] += inward(axis[d]);
      add_member(s, j, others);
    }
    if (enough()) return;
    s.axis = -1;
    const bool own = window_.inner().contains(i);
    for (int ring = 1; ring <= 2 && !enough(); ++ring) {
      if (own) ++(ring == 1 ? counters_.wide_neighbourhoods : counters_.widest_neighbourhoods);
      Box<Dim> box{i, i};
      for (int d = 0; d < Dim; ++d) box.lo[d] -= ring, box.hi[d] += ring + 1;
      for_each(box, [&](const Index<Dim>& j) { add_member(s, j, others); });
    }
  }

  void form_neighbourhoods() {
    constexpr int most = power<Dim>(5);
    members_ = scratch_.take<int>(static_cast<std::size_t>(smalls_ * most));
    int used = 0;
    for (int s = 0; s < smalls_; ++s) {
      small_[s].first = used;
      form(small_[s]);
      used += small_[s].members;
    }
  }

  void list_holders() {
    holders_ = list_holders_of(small_, smalls_, members_, n_, scratch_);
    merged_ = scratch_.take<Merged<Dim>>(static_cast<std::size_t>(smalls_));
    for (int s = 0; s < smalls_; ++s) merged_[s].known = false;
  }

  /// Centroid of a fragment, in cells.
  Vec<Dim> centroid(int k) const {
    const Index<Dim> i = window_.box().index(k);
    Vec<Dim> x;
    for (int d = 0; d < Dim; ++d) x[d] = i[d] + 0.5;
    if (index_[k] < 0) return x;
    return x + body_.at(window_.source(i).slot).geometry.cuts[index_[k]].centroid;
  }

  const Merged<Dim>& merged(int s) {
    Merged<Dim>& m = merged_[s];
    if (m.known) return m;
    m = {};
    m.known = true;
    Neighbourhood& h = small_[s];
    double volume = 0;
    for (int j = 0; j < h.members; ++j) {
      const int k = members_[h.first + j];
      const double share = 1.0 / holders_.shares(k);
      volume += share * volume_[k];
      m.centre += share * volume_[k] * centroid(k);
      const Q q = held_.of(k);
      for (std::size_t c = 0; c < q.size(); ++c) m.mean[c] += share * q[c];
    }
    m.possible = volume > merge_fill * full(window_.box().index(h.cell));
    if (!m.possible) {
      h.alone = h.members == 1;
      return m;
    }
    m.centre *= 1 / volume;
    for (double& c : m.mean) c /= volume;
    m.turning = turning_of(h.cell);
    if (h.axis >= 0 && h.members == 2) add_slope(h, m);
    return m;
  }

  /// How the matter around a cut cell turns, by its fit; not in front of a strong shock.
  Turning<Dim> turning_of(int k) const {
    if (index_[k] < 0) return {};
    const auto& walls = body_.at(window_.source(window_.box().index(k)).slot).walls;
    const auto at = static_cast<std::size_t>(index_[k]);
    if (at >= walls.size() || walls[at].donors == 0) return {};
    const double rho = walls[at].value[Components<Dim>::rho], range = walls[at].range[Components<Dim>::rho];
    return {walls[at], slope_kept_by(rho, rho + range)};
  }

  /// A pair along an axis keeps the slope towards the two cells behind it, if these are whole enough.
  void add_slope(const Neighbourhood& h, Merged<Dim>& m) const {
    const int step = h.direction * window_.stride(h.axis), one = members_[h.first + 1] + step,
              two = one + step;
    const Index<Dim> i1 = window_.box().index(one), i2 = window_.box().index(two);
    if (volume_[one] < target_fill * full(i1) || volume_[two] < target_fill * full(i2)) return;
    const double x0 = m.centre[h.axis], x1 = centroid(one)[h.axis], x2 = centroid(two)[h.axis];
    const Q q1 = held_.of(one), q2 = held_.of(two);
    const double calm = slope_kept_by(q1[0] / volume_[one], q2[0] / volume_[two]);
    const Q turn1 = m.turning.change(m.mean, centroid(one) - m.centre),
            turn2 = m.turning.change(m.mean, centroid(two) - m.centre);
    for (std::size_t c = 0; c < q1.size(); ++c) {
      const double u1 = q1[c] / volume_[one] - turn1[c], u2 = q2[c] / volume_[two] - turn2[c];
      m.slope[c] = calm * minmod((m.mean[c] - u1) / (x0 - x1), (u1 - u2) / (x1 - x2));
    }
    for (int c = Components<Dim>::ep; c < Components<Dim>::contents; ++c) keep_positive(h, m, c);
    keep_damage_whole(h, m);
  }

  /// Which part of its slope a pair keeps in front of a strong shock, by the densities behind it. The foot of
  /// the shock is convex: drawn on outwards it ends below the state ahead, in a tension that grows from step
  /// to step.
  double slope_kept_by(double rho1, double rho2) const {
    if (!has_tension(body_.material.eos)) return 1;
    const double jump = std::abs(rho1 - rho2) / std::min(rho1, rho2);
    return std::clamp((shocked_jump - jump) / (shocked_jump - calm_jump), 0.0, 1.0);
  }

  /// Damage of the pair that the slopes of it and of the density would take beyond 1 is uniform by mass.
  void keep_damage_whole(const Neighbourhood& h, Merged<Dim>& m) const {
    constexpr std::size_t damage = Components<Dim>::damage;
    if (!(m.mean[0] > 0) || m.mean[damage] > m.mean[0]) return;
    for (int j = 0; j < h.members; ++j) {
      const double z = centroid(members_[h.first + j])[h.axis] - m.centre[h.axis];
      if (m.mean[damage] + m.slope[damage] * z <= m.mean[0] + m.slope[0] * z) continue;
      m.slope[damage] = m.slope[0] * (m.mean[damage] / m.mean[0]);
      return;
    }
  }

  /// Flattens the slope of what cannot fall below zero until neither of the pair does.
  void keep_positive(const Neighbourhood& h, Merged<Dim>& m, int c) const {
    const auto at = static_cast<std::size_t>(c);
    double lowest = 0;
    for (int j = 0; j < h.members; ++j)
      lowest = std::min(lowest, m.slope[at] * (centroid(members_[h.first + j])[h.axis] - m.centre[h.axis]));
    if (m.mean[at] + lowest < 0) m.slope[at] *= m.mean[at] > 0 ? -m.mean[at] / lowest : 0;
  }

  /// Of a cell without volume: what has flowed in stays its own where a neighbourhood is too small to share.
  Q contents_without_volume(int k) {
    double part = 0;
    for (const int s : holders_.of(k))
      if (!merged(s).possible) part += 1.0 / holders_.shares(k);
    Q q = held_.of(k);
    for (double& c : q) c *= part;
    return q;
  }

  Q new_contents(int k) {
    if (volume_[k] == 0) return contents_without_volume(k);
    const Q old = held_.of(k);
    const double per_volume = 1 / volume_[k];
    Q sum{};
    if (!holders_.is_small[k])
      for (std::size_t c = 0; c < old.size(); ++c) sum[c] = old[c] * per_volume;
    for (const int s : holders_.of(k)) {
      const Merged<Dim>& m = merged(s);
      const Q shared = m.possible ? m.at(centroid(k), small_[s].axis) : Q{};
      for (std::size_t c = 0; c < old.size(); ++c) sum[c] += m.possible ? shared[c] : old[c] * per_volume;
    }
    const double share = volume_[k] / holders_.shares(k);
    for (double& c : sum) c *= share;
    return sum;
  }

  /// The nearest fragment above 0.3 of a cell within three cells, or -1.
  int home_of(int k) const {
    const Index<Dim> i = window_.box().index(k);
    Box<Dim> box = window_.box();
    for (int d = 0; d < Dim; ++d)
      box.lo[d] = std::max(i[d] - 3, box.lo[d]), box.hi[d] = std::min(i[d] + 4, box.hi[d]);
    int best = -1, nearest = 1 << 20;
    for_each(box, [&](const Index<Dim>& j) {
      int r2 = 0;
      for (int d = 0; d < Dim; ++d) r2 += (j[d] - i[d]) * (j[d] - i[d]);
      if (r2 == 0 || r2 >= nearest || volume_[window_.at(j)] < home_fill * full(j)) return;
      nearest = r2;
      best = window_.at(j);
    });
    return best;
  }

  void write(BodyBlock<Dim>& block) {
    const Box<Dim> inner = window_.inner();
    // Lone fragments near enough to be sent to an own cell, or to leave one.
    int lone = 0;
    int* lone_cell = scratch_.take<int>(static_cast<std::size_t>(smalls_));
    int* lone_home = scratch_.take<int>(static_cast<std::size_t>(smalls_));
    for (int s = 0; s < smalls_; ++s) {
      const Index<Dim> i = window_.box().index(small_[s].cell);
      if (!inner.grown(3).contains(i) || merged(s).possible) continue;
      if (inner.contains(i)) ++counters_.unmerged_fragments;
      // One that others hold is shared by them; what it would then take along depends on cells beyond the
      // window.
      if (!small_[s].alone || holders_.of(small_[s].cell).size() > 1) continue;
      const int home = home_of(small_[s].cell);
      if (home < 0) continue;
      lone_cell[lone] = small_[s].cell;
      lone_home[lone++] = home;
      if (inner.contains(i)) ++counters_.lone_fragments_moved;
    }
    for_each(inner, [&](const Index<Dim>& i) {
      const int k = window_.at(i);
      bool involved = holders_.any(k);
      for (int l = 0; l < lone; ++l) involved = involved || lone_home[l] == k;
      if (!involved) return;
      Update<Dim> u;
      u.cell = window_.cell(i);
      u.volume = volume_[k];
      u.contents = holders_.any(k) ? new_contents(k) : held_.of(k);
      for (int l = 0; l < lone; ++l) {
        if (lone_cell[l] == k) u.volume = 0, u.contents = {};
        if (lone_home[l] != k) continue;
        u.volume += volume_[lone_cell[l]];
        const Q q = new_contents(lone_cell[l]);
        for (std::size_t c = 0; c < q.size(); ++c) u.contents[c] += q[c];
      }
      block.updates.push_back(u);
    });
  }

  const State<Dim>& state_;
  const Grid<Dim>& grid_;
  Body<Dim>& body_;
  Window<Dim> window_;
  WindowContents<Dim> held_;
  Counters& counters_;
  Scratch& scratch_;
  std::size_t n_;
  double *volume_ = nullptr, *phi_ = nullptr;
  Neighbourhood* small_ = nullptr;
  int smalls_ = 0;
  int* index_ = nullptr;          // of cut cells
  std::uint8_t* role_ = nullptr;  // of the start of the step
  int* members_ = nullptr;
  Holders holders_;
  Merged<Dim>* merged_ = nullptr;
};

}  // namespace

template <int Dim>
void redistribute(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters, Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  b.updates.clear();
  if (b.near_surface && b.matter.size() > 0) Redistribution<Dim>(state, body, slot, counters, scratch).run(b);
}

template void redistribute<1>(const State<1>&, Body<1>&, int, Counters&, Scratch&);
template void redistribute<2>(const State<2>&, Body<2>&, int, Counters&, Scratch&);
template void redistribute<3>(const State<3>&, Body<3>&, int, Counters&, Scratch&);

}  // namespace recoil
