#pragma once

#include <cstddef>

#include "field/components.hpp"
#include "material/damage/damage.hpp"
#include "state/body.hpp"

namespace recoil {

/// f(cell, its place in the block's arrays) for all cells of a block.
template <int Dim, class F>
void for_each_place(const State<Dim>& state, int slot, F&& f) {
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = state.grid(slot).layout();
  for_each(cells, [&](const Index<Dim>& i) { f(i, static_cast<std::size_t>(layout.at(i - cells.lo))); });
}

/// Whether the fragment at a place of a block has failed.
template <int Dim>
[[gnu::always_inline]] inline bool has_failed(const BodyBlock<Dim>& b, std::size_t k) {
  return b.contents[Components<Dim>::damage * b.volume.size() + k] >= failed_damage * b.contents[k];
}

/// Whether the fragment at a place had failed when averages were last taken, or is too small to have one.
template <int Dim>
[[gnu::always_inline]] inline bool may_have_failed(const BodyBlock<Dim>& b, std::size_t k) {
  const bool averages = !b.average.empty();
  const auto& w = averages ? b.average : b.stencil;
  if (w.empty() || (b.role[k] & (averages ? donates : valued)) == 0) return true;
  return w[Components<Dim>::damage * b.volume.size() + k] >= failed_damage;
}

/// Whether the average at a place is that of a cell with a void: failed matter without pressure.
template <int Dim>
[[gnu::always_inline]] inline bool has_void(const BodyBlock<Dim>& b, std::size_t k) {
  using C = Components<Dim>;
  const std::size_t n = b.volume.size();
  return (b.role[k] & donates) != 0 && b.average[C::p * n + k] == 0 &&
         b.average[C::damage * n + k] >= failed_damage;
}
/// Whether a block has such a cell.
template <int Dim>
bool has_voids(const BodyBlock<Dim>& b) {
  for (std::size_t k = 0; k < b.volume.size(); ++k)
    if (has_void(b, k)) return true;
  return false;
}

}  // namespace recoil
