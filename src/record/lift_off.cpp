#include "record/lift_off.hpp"

#include <algorithm>
#include <cstddef>

#include "parallel/archive.hpp"
#include "record/events.hpp"

namespace recoil {

namespace {

constexpr double parted = 0.1;  // dx between surfaces that no longer count as in contact

}  // namespace

template <int Dim>
void LiftOffWatch<Dim>::note(const State<Dim>& state) {
  if (Dim == 1) return;
  const auto n = static_cast<std::size_t>(state.grid().layout().size());
  for (int slot = 0; slot < state.mesh.local(); ++slot)
    for (const Contact<Dim>& c : state.contacts[slot]) {
      const int lower = std::min(c.first, c.second), higher = std::max(c.first, c.second);
      Touched& t = touched_[{slot, pair_number(lower, higher, state.count())}];
      if (t.step.empty()) t = {lower, higher, std::vector<long>(n, -1), std::vector<double>(n, 0.0)};
      t.step[c.cell] = state.step;
      t.time[c.cell] = state.time;
    }
}

template <int Dim>
void LiftOffWatch<Dim>::scan(const State<Dim>& state, int slot, int pair, Touched& t,
                             parallel::Bytes& out) const {
  const Box<Dim> layout = state.grid().layout();
  const auto& first = state.bodies[t.lower].at(slot);
  const auto& second = state.bodies[t.higher].at(slot);
  if (!first.present || !second.present) return;
  for (std::size_t k = 0; k < t.step.size(); ++k) {
    const long since = state.step - t.step[k];
    if (t.step[k] < 0 || since < opening_steps) continue;
    const Index<Dim> i = layout.index(static_cast<int>(k));
    Box<Dim> around{i, i};
    for (int d = 0; d < Dim; ++d) {
      around.lo[d] = std::max(i[d] - 1, layout.lo[d]);
      around.hi[d] = std::min(i[d] + 2, layout.hi[d]);
    }
    bool touching = false, first_near = false, second_near = false;
    for_each(around, [&](const Index<Dim>& j) {
      const auto at = static_cast<std::size_t>(layout.at(j));
      touching = touching || (t.step[at] >= 0 && state.step - t.step[at] < opening_steps);
      first_near = first_near || first.geometry.index[at] >= 0;
      second_near = second_near || second.geometry.index[at] >= 0;
    });
    const bool both_near = first_near && second_near;
    if (both_near && (touching || first.phi[k] + second.phi[k] < parted * state.grid().dx)) continue;
    t.step[k] = -1;  // decided
    if (!both_near) continue;
    parallel::pack(out, state.mesh.block(slot).order);
    parallel::pack(out, Place{pair, t.time[k], state.grid().centre(state.mesh.block(slot).cells.lo + i)});
  }
}

template <int Dim>
std::vector<typename LiftOffWatch<Dim>::Place> LiftOffWatch<Dim>::collect(const State<Dim>& state,
                                                                          const parallel::World& world) {
  if (Dim == 1) return {};
  parallel::Bytes mine;
  for (auto& [key, touched] : touched_) scan(state, key.first, key.second, touched, mine);
  std::vector<std::pair<long, Place>> found;
  for (const auto& bytes : world.gather(mine)) {
    parallel::Unpacker reader(bytes);
    while (!reader.empty()) {
      const long order = reader.read<long>();
      found.emplace_back(order, reader.read<Place>());
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& p, const auto& q) { return p.first < q.first; });
  std::vector<Place> places;
  for (const auto& [order, place] : found) places.push_back(place);
  return places;
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
