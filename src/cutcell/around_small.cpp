#include "cutcell/around_small.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "cutcell/redistribution.hpp"
#include "state/sent_cells.hpp"

namespace recoil {

namespace {

// A fragment that no surface cuts and that is larger at the start of a step is not small in any of its
// stages.
constexpr double may_be_small = target_fill * (1 + 1e-6);

/// Sets what lies within around_small_cells of a set cell along axis d.
template <int Dim>
void widen(const Box<Dim>& box, int d, const std::uint8_t* near, std::uint8_t* wider) {
  std::fill(wider, wider + box.size(), std::uint8_t{0});
  for_each(box, [&](const Index<Dim>& i) {
    if (near[box.at(i)] == 0) return;
    const int low = std::max(i[d] - around_small_cells, box.lo[d]),
              high = std::min(i[d] + around_small_cells + 1, box.hi[d]);
    std::uint8_t* to = wider + box.at(i);
    for (int j = low; j < high; ++j) to[(j - i[d]) * box.stride(d)] = 1;
  });
}

}  // namespace

template <int Dim>
std::vector<std::uint8_t> mark_around_small(const State<Dim>& state, const Body<Dim>& body, int slot,
                                            Scratch& scratch) {
  std::vector<std::uint8_t> marked;
  if (state.mesh.block(slot).level > 0) return marked;  // no surface is there
  const Window<Dim> w(state.mesh, slot, around_small_cells);
  const auto n = static_cast<std::size_t>(w.size());
  double* volume = scratch.take<double>(n);
  w.gather([&](int s) { return body.present(s) ? body.at(s).volume.data() : nullptr; }, 0.0, Beyond::nothing,
           volume);
  int* index = scratch.take<int>(n);
  w.gather([&](int s) { return body.present(s) ? body.at(s).geometry.index.data() : nullptr; }, -1,
           Beyond::nothing, index);
  auto *near = scratch.take<std::uint8_t>(n), *wider = scratch.take<std::uint8_t>(n);
  for_each(w.box(), [&](const Index<Dim>& i) {
    const int k = w.at(i);
    const bool partial = volume[k] != 0 && volume[k] < may_be_small * state.grid().full_volume(i);
    near[k] = index[k] >= 0 || partial;
  });
  if (std::none_of(near, near + n, [](std::uint8_t v) { return v != 0; })) return marked;
  for (int d = 0; d < Dim; ++d) {
    widen(w.box(), d, near, wider);
    std::swap(near, wider);
  }
  marked.resize(static_cast<std::size_t>(state.grid().layout().size()), 0);
  for_each(w.inner(),
           [&](const Index<Dim>& i) { marked[static_cast<std::size_t>(w.cell(i))] = near[w.at(i)]; });
  return marked;
}

#define RECOIL_INSTANTIATE(Dim)                                                                       \
  template std::vector<std::uint8_t> mark_around_small<Dim>(const State<Dim>&, const Body<Dim>&, int, \
                                                            Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
