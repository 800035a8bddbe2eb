#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/marks.hpp"
#include "cutcell/moves_view.hpp"

/// Transfers of volume and contents between neighbouring cells of a body.
namespace recoil {

/// Something that leaves a cell for another.
template <int Dim>
struct Transfer {
  Index<Dim> to{};
  bool any = false;
  double volume = 0;
  Index<Dim> state_cell{};       // whose state the volume takes along ...
  double factor = 0;             // ... this much of its contents
  bool everything = false;       // the cell is left with nothing
  bool outside = false;          // through an open edge of the domain, `to` is the cell itself
  std::array<double, 3> kept{};  // of `bounded`: what `to` keeps that the volume should have taken along
};

/// Components that cannot fall below zero.
template <int Dim>
inline constexpr std::array<std::size_t, 3> bounded{Components<Dim>::ep, Components<Dim>::temperature_rise,
                                                    Components<Dim>::damage};

/// A neighbour that gives volume at the state of the cell that takes it gives no more plastic strain and heat
/// than it has, and of damage what belongs to the mass that it gives: its own damage stays as it is, and that
/// of the cell that takes becomes a mean by mass.
template <int Dim>
void keep_positive(const MovesView<Dim>& p, Transfer<Dim>& t) {
  if (t.outside || t.volume >= 0) return;
  const Contents<Dim> state = p.contents(t.state_cell), there = p.contents(t.to);
  constexpr std::size_t damage = Components<Dim>::damage;
  if (t.everything) {
    // A mass below zero has no damage: what it is taken off keeps its own.
    if (state[0] < 0 && there[0] > 0) t.kept[2] = state[0] * (there[damage] / there[0]) - state[damage];
    return;
  }
  if (p.volume[p.window.at(t.to)] + t.volume <= 0) return;
  for (std::size_t n = 0; n < bounded<Dim>.size(); ++n) {
    const std::size_t c = bounded<Dim>[n];
    if (c == damage && there[0] > 0) {
      t.kept[n] = t.factor * (state[0] * (there[c] / there[0]) - state[c]);
      continue;
    }
    const double missing = -(std::max(there[c], 0.0) + t.factor * state[c]);
    if (t.factor * state[c] < 0 && missing > 0) t.kept[n] = missing;
  }
}

template <int Dim>
void add_kept(Contents<Dim>& to, const Transfer<Dim>& t, double sign) {
  for (std::size_t n = 0; n < bounded<Dim>.size(); ++n) to[bounded<Dim>[n]] += sign * t.kept[n];
}

/// The cells that may send something: own ones and those around them. `may(kind, volume, full)` says so of a
/// cell by what it is and holds, and by the volume of the whole cell.
template <int Dim, class May>
int* list_senders(const MovesView<Dim>& p, int& count, Scratch& scratch, May&& may) {
  const Box<Dim> box = p.window.inner().grown(1);
  int* cells = scratch.take<int>(box.size());
  const int width = box.extent(0);
  std::array<double, Window<Dim>::longest> full;  // by column
  Index<Dim> column = box.lo;
  for (int c = 0; c < width; ++c, ++column[0]) full[static_cast<std::size_t>(c)] = p.full(column);
  std::array<std::uint8_t, Window<Dim>::longest + marks_beyond> sends{};
  Box<Dim> rows = box;
  rows.hi[0] = std::min(rows.hi[0], rows.lo[0] + 1);
  count = 0;
  for_each(rows, [&](const Index<Dim>& i) {
    const int first = p.window.at(i);
    for (std::size_t c = 0; c < static_cast<std::size_t>(width); ++c)
      sends[c] = may(p.kind[first + c], p.volume[first + c], full[c]) ? 1 : 0;
    for_each_set(sends.data(), width, [&](int c) { cells[count++] = first + c; });
  });
  return cells;
}

/// Applies transfers between cells at most one apart: every own cell loses what it sends and gains what its
/// neighbours send it, in the order of their cells. `decide(i)` must depend on the old state only; only cells
/// of the list are asked.
template <int Dim, class Decide>
void transfer(const MovesView<Dim>& p, BodyBlock<Dim>& b, const int* senders, int count, Scratch& scratch,
              Decide&& decide) {
  const std::size_t n = p.window.size();
  int* sent = scratch.take_filled<int>(n, -1);
  auto* touched = scratch.take_filled<std::uint8_t>(n, 0);
  auto* transfers = scratch.take<Transfer<Dim>>(count);
  for (int s = 0; s < count; ++s) {
    const int k = senders[s];
    transfers[s] = decide(p.window.box().index(k));
    if (!transfers[s].any) continue;
    keep_positive(p, transfers[s]);
    sent[k] = s;
    touched[k] = 1;
    touched[p.window.at(transfers[s].to)] = 1;
  }
  for_each(p.window.inner(), [&](const Index<Dim>& i) {
    const int k = p.window.at(i);
    if (!touched[k]) return;
    Update<Dim> u{p.window.cell(i), p.volume[k], p.contents(i)};
    if (sent[k] >= 0) {
      const Transfer<Dim>& own = transfers[sent[k]];
      u.volume -= own.volume;
      if (own.everything) {
        u.volume = 0;
        u.contents = {};
      } else {
        add_scaled<Dim>(u.contents, p.contents(own.state_cell), -own.factor);
        add_kept(u.contents, own, -1);
      }
    }
    Box<Dim> box{i, i};
    for (int d = 0; d < Dim; ++d) --box.lo[d], box.hi[d] += 2;
    for_each(box, [&](const Index<Dim>& j) {
      const int from = sent[p.window.at(j)];
      if (from < 0 || j == i || !(transfers[from].to == i)) return;
      u.volume += transfers[from].volume;
      add_scaled<Dim>(u.contents, p.contents(transfers[from].state_cell), transfers[from].factor);
      add_kept(u.contents, transfers[from], 1);
    });
    b.updates.push_back(u);
  });
}

}  // namespace recoil
