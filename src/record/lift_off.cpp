#include "record/lift_off.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "field/exchange.hpp"
#include "field/window.hpp"
#include "parallel/archive.hpp"

namespace recoil {

namespace {

constexpr double parted = 0.1;  // dx between surfaces that no longer count as in contact

/// Whether a body's surface runs through a cell; the slot may be a copy.
template <int Dim>
bool has_surface(const State<Dim>& state, int body, int slot, int cell) {
  const BodyBlock<Dim>& b = state.bodies[body].at(slot);
  if (!b.present) return false;
  const double half_diagonal = 0.5 * std::sqrt(static_cast<double>(Dim)) * state.grid().dx;
  return std::abs(b.phi[cell]) <= half_diagonal;
}

}  // namespace

template <int Dim>
void LiftOffWatch<Dim>::note(const State<Dim>& state) {
  if (Dim == 1) return;
  const auto n = static_cast<std::size_t>(state.grid().layout().size());
  for (int slot = 0; slot < state.mesh.local(); ++slot)
    for (const Contact<Dim>& c : state.contacts[slot]) {
      const int lower = std::min(c.first, c.second), higher = std::max(c.first, c.second);
      Touched& t = touched_[{slot, pair_number(lower, higher, state.count())}];
      if (t.time.empty()) t = {lower, higher, state.mesh.block(slot).at, std::vector<double>(n, -1.0)};
      t.time[c.cell] = state.time;
    }
}

template <int Dim>
typename LiftOffWatch<Dim>::Copies LiftOffWatch<Dim>::look_at_copies(const State<Dim>& state,
                                                                     const parallel::World& world) const {
  const auto pack_slot = [&](int slot, int /*rank*/, parallel::Bytes& bytes) {
    std::vector<std::array<int, 2>> cells;  // pair, cell
    for (auto at = touched_.lower_bound({slot, 0}); at != touched_.end() && at->first.first == slot; ++at)
      for (std::size_t k = 0; k < at->second.time.size(); ++k)
        if (lately(state.time, at->first.second, at->second.time[k]))
          cells.push_back({at->first.second, static_cast<int>(k)});
    parallel::pack(bytes, cells.size());
    parallel::pack(bytes, cells.data(), cells.size());
  };
  Copies copies;
  exchange(state.mesh, world, pack_slot, [&](int slot, parallel::Unpacker& reader) {
    for (auto left = reader.read<std::size_t>(); left > 0; --left) {
      const auto [pair, cell] = reader.read<std::array<int, 2>>();
      copies[{slot, pair}].push_back(cell);
    }
  });
  return copies;
}

template <int Dim>
void LiftOffWatch<Dim>::scan(const State<Dim>& state, int slot, int pair, Touched& t, const Copies& copies,
                             std::vector<Place>& out) const {
  const Box<Dim> layout = state.grid().layout();
  const BodyBlock<Dim>&first = state.bodies[t.lower].at(slot), &second = state.bodies[t.higher].at(slot);
  if (!first.present || !second.present) return;
  const Index<Dim> home = state.mesh.block(slot).cells.lo;
  const Window<Dim> window(state.mesh, slot, 1);
  const double dx = state.grid().dx;
  const auto touched_lately = [&](int s, int cell) {
    if (const auto own = touched_.find({s, pair}); own != touched_.end())
      return lately(state.time, pair, own->second.time[static_cast<std::size_t>(cell)]);
    const auto copy = copies.find({s, pair});
    return copy != copies.end() && std::ranges::binary_search(copy->second, cell);
  };
  for (std::size_t k = 0; k < t.time.size(); ++k) {
    if (t.time[k] < 0 || lately(state.time, pair, t.time[k])) continue;
    const Index<Dim> i = layout.index(static_cast<int>(k));
    Box<Dim> around{i, i};
    for (int d = 0; d < Dim; ++d) --around.lo[d], around.hi[d] += 2;
    bool touching = false, first_near = false, second_near = false;
    for_each(around, [&](const Index<Dim>& j) {
      const auto from = window.source_inside(home + j);
      if (from.slot < 0) return;
      first_near = first_near || has_surface(state, t.lower, from.slot, from.cell);
      second_near = second_near || has_surface(state, t.higher, from.slot, from.cell);
      touching = touching || touched_lately(from.slot, from.cell);
    });
    const bool both_near = first_near && second_near;
    if (both_near && (touching || first.phi[k] + second.phi[k] < parted * dx)) continue;
    const double time = std::exchange(t.time[k], -1.0);  // decided
    if (both_near) out.push_back({pair, time, state.grid().centre(home + i)});
  }
}

template <int Dim>
std::vector<typename LiftOffWatch<Dim>::Place> LiftOffWatch<Dim>::collect(const State<Dim>& state,
                                                                          const parallel::World& world) {
  if (Dim == 1) return {};
  const Copies copies = look_at_copies(state, world);
  std::vector<Place> mine, places;
  for (auto& [key, touched] : touched_) scan(state, key.first, key.second, touched, copies, mine);
  parallel::Bytes bytes;
  parallel::pack(bytes, mine.data(), mine.size());
  for (const auto& from : world.gather(bytes))
    for (parallel::Unpacker reader(from); !reader.empty();) places.push_back(reader.template read<Place>());
  std::ranges::sort(places, [](const Place& p, const Place& q) {
    if (p.time != q.time) return p.time < q.time;
    if (p.at != q.at)
      return std::ranges::lexicographical_compare(p.at.c.rbegin(), p.at.c.rend(), q.at.c.rbegin(),
                                                  q.at.c.rend());
    return p.pair < q.pair;
  });
  return places;
}

template <int Dim>
void LiftOffWatch<Dim>::follow_blocks(const State<Dim>& state, const parallel::World& world) {
  std::map<std::pair<int, int>, Touched> here;
  std::vector<std::pair<int, Touched>> elsewhere;
  const auto sort_in = [&](int pair, Touched& t) {
    const int slot = state.mesh.find(recoil::Place<Dim>{0, t.at});
    if (slot < 0 || slot >= state.mesh.local()) return false;
    here[{slot, pair}] = std::move(t);
    return true;
  };
  for (auto& [key, touched] : touched_)
    if (!sort_in(key.second, touched)) elsewhere.emplace_back(key.second, std::move(touched));
  touched_ = std::move(here);
  if (world.size() == 1 || !world.any(!elsewhere.empty())) return;
  here = std::move(touched_);
  parallel::Bytes bytes, all;
  parallel::ArchiveWriter archive(bytes);
  archive(elsewhere);
  for (const parallel::Bytes& one : world.gather(bytes)) all.insert(all.end(), one.begin(), one.end());
  world.broadcast(all);
  parallel::Unpacker reader(all);
  while (!reader.empty()) {
    std::vector<std::pair<int, Touched>> some;
    parallel::ArchiveReader reads(reader);
    reads(some);
    for (auto& [pair, touched] : some) sort_in(pair, touched);
  }
  touched_ = std::move(here);
}

template <int Dim>
void LiftOffWatch<Dim>::pack(int slot, parallel::Bytes& bytes) const {
  std::vector<std::pair<int, Touched>> here;
  for (const auto& [key, touched] : touched_)
    if (key.first == slot) here.emplace_back(key.second, touched);
  parallel::ArchiveWriter archive(bytes);
  archive(here);
}

template <int Dim>
void LiftOffWatch<Dim>::unpack(int slot, parallel::Unpacker& from) {
  std::vector<std::pair<int, Touched>> here;
  parallel::ArchiveReader archive(from);
  archive(here);
  for (auto& [pair, touched] : here) touched_[{slot, pair}] = std::move(touched);
}

template class LiftOffWatch<1>;
template class LiftOffWatch<2>;
template class LiftOffWatch<3>;

}  // namespace recoil
