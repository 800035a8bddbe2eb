#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

#include "mesh/mesh.hpp"

namespace recoil {

/// What a window shows where the domain ends without being periodic.
enum class Beyond {
  extend,  // mirrored at reflecting edges, constant at open ones
  mirror,  // mirrored at reflecting edges, the value for absent cells at open ones
  nothing  // the value for absent cells at both
};

/// A block and the cells of its level around it, up to `halo` away, read from the block and its neighbours.
/// No block stores ghost cells: a kernel gathers what it reads into a window of its own, as wide as it needs.
template <int Dim>
class Window {
 public:
  /// Where a cell of the window really lives.
  struct Source {
    int slot = -1;       // -1: beyond the edge of the domain or of what exists
    int cell = 0;        // in the block's layout
    unsigned flips = 0;  // bit d: mirrored along axis d
  };

  Window(const Mesh<Dim>& mesh, int slot, int halo) : Window(mesh, slot, halo, mesh.block(slot).cells) {}

  /// @param inner the part of the block that the window surrounds, not empty.
  Window(const Mesh<Dim>& mesh, int slot, int halo, const Box<Dim>& inner)
      : mesh_(mesh), grid_(mesh.grid(slot)), layout_(grid_.layout()), inner_(inner), box_(inner.grown(halo)) {
    const Block<Dim>& block = mesh.block(slot);
    home_ = block.cells.lo;
    for (int d = 0; d < Dim; ++d) map_axis(block, d);
    slots_ = block.neighbour;
  }

  /// Cells of the window, and those of the block that it surrounds, by global index.
  const Box<Dim>& box() const { return box_; }
  const Box<Dim>& inner() const { return inner_; }
  /// Place of an own cell in the block's layout.
  int cell(const Index<Dim>& i) const { return layout_.at(i - home_); }
  /// Index of an own cell from its place in the block's layout.
  Index<Dim> index_of(int cell) const { return home_ + layout_.index(cell); }
  int size() const { return box_.size(); }
  int at(const Index<Dim>& i) const { return box_.at(i); }
  int stride(int d) const { return box_.stride(d); }

  /// The cell that stands at index i of the window under `beyond = extend`.
  Source source(const Index<Dim>& i) const {
    Index<Dim> offset, local;
    unsigned flips = 0;
    for (int d = 0; d < Dim; ++d) {
      const Axis a = axis_[d][i[d] - box_.lo[d]];
      offset[d] = a.offset;
      local[d] = a.local;
      flips |= static_cast<unsigned>(a.flip) << d;
    }
    return {slots_[around().at(offset)], layout_.at(local), flips};
  }
  /// Where point x of the source cell of index i appears: mirrored or moved by a period as the cell is.
  Vec<Dim> appear(const Index<Dim>& i, const Source& from, const Vec<Dim>& x) const {
    const Index<Dim> home = mesh_.block(from.slot).cells.lo + layout_.index(from.cell);
    if (home == i) return x;
    const Vec<Dim> here = grid_.centre(i), there = grid_.centre(home);
    Vec<Dim> y;
    for (int d = 0; d < Dim; ++d) y[d] = here[d] + ((from.flips >> d & 1U) != 0 ? -1 : 1) * (x[d] - there[d]);
    return y;
  }
  /// As source(), but nothing (slot -1) beyond an edge that is not periodic.
  Source source_inside(const Index<Dim>& i) const {
    for (int d = 0; d < Dim; ++d)
      if (axis_[d][i[d] - box_.lo[d]].outside) return {};
    return source(i);
  }

  /// What gather() puts where there is nothing, and the axes (bits) whose mirrors turn the sign.
  template <class T>
  struct Component {
    T missing{};
    unsigned odd_axes = 0;
  };

  /// Copies one value per cell into out [size()]. `of(slot)` gives a block's array or null where it has none.
  template <class T, class Of>
  void gather(Of&& of, T missing, Beyond beyond, T* out, unsigned odd_axes = 0) const {
    gather(of, std::array{Component<T>{missing, odd_axes}}, beyond, out);
  }
  /// Copies several components of every cell into out [components][size()]; they lie one block's layout apart
  /// in the arrays that `of(slot)` gives.
  template <class T, class Of, std::size_t n>
  void gather(Of&& of, const std::array<Component<T>, n>& components, Beyond beyond, T* out) const {
    std::array<const T*, static_cast<std::size_t>(power<Dim>(3))> from{};
    for (std::size_t s = 0; s < from.size(); ++s) from[s] = slots_[s] >= 0 ? of(slots_[s]) : nullptr;
    Index<Dim> row = box_.lo;
    const int rows = box_.size() / box_.extent(0), width = box_.extent(0);
    for (int r = 0; r < rows; ++r) {
      gather_row(row, from, components, beyond, out + static_cast<std::ptrdiff_t>(r) * width);
      for (int d = 1; d < Dim; ++d) {
        if (++row[d] < box_.hi[d]) break;
        row[d] = box_.lo[d];
      }
    }
  }

  static constexpr std::size_t longest = 160;  // block and halo along one axis

 private:
  struct Axis {
    int offset, local;
    bool flip, outside, open;
  };
  /// A run of window cells along axis 0 that lie one after the other (step 1), backwards (-1) or are one (0).
  struct Run {
    int to, n, offset, local, step;
    bool flip, outside, open;
  };

  static constexpr Box<Dim> around() {
    Box<Dim> b;
    for (int d = 0; d < Dim; ++d) b.lo[d] = -1, b.hi[d] = 2;
    return b;
  }

  /// Of a cell that is not the block's own.
  Axis map_index(const Block<Dim>& block, int d, int g) const {
    const int n = grid_.cells[d], nb = grid_.block[d];
    const auto& edge = grid_.edge[d];
    Axis a{};
    if (edge[0] == Edge::periodic) {
      int wrapped = g % n;
      if (wrapped < 0) wrapped += n;
      const int lattice = (n + nb - 1) / nb, home = wrapped / nb;
      const int unwrapped = (g - wrapped) / n * lattice + home;
      a.offset = std::clamp(lattice == 1 ? 0 : unwrapped - block.at[d], -1, 1);
      a.local = wrapped - home * nb;
      return a;
    }
    a.outside = g < 0 || g >= n;
    while (g < 0 || g >= n) {
      const bool low = g < 0;
      if (edge[low ? 0 : 1] == Edge::outflow) {
        g = low ? 0 : n - 1;
        a.open = true;
      } else {
        g = low ? -1 - g : 2 * n - 1 - g;
        a.flip = !a.flip;
      }
    }
    a.offset = g / nb - block.at[d];
    a.local = g % nb;
    return a;
  }

  void map_axis(const Block<Dim>& block, int d) {
    const int n = box_.extent(d), home = block.cells.lo[d], first = box_.lo[d];
    const int lo = std::clamp(home - first, 0, n), hi = std::clamp(block.cells.hi[d] - first, lo, n);
    auto& axis = axis_[static_cast<std::size_t>(d)];
    for (int i = 0; i < lo; ++i) axis[i] = map_index(block, d, first + i);
    for (int i = lo; i < hi; ++i) axis[i] = {0, first + i - home, false, false, false};
    for (int i = hi; i < n; ++i) axis[i] = map_index(block, d, first + i);
    if (d != 0) return;
    runs_ = 0;
    for (int i = 0; i < lo; ++i) add_to_runs(i);
    if (hi > lo) run_[runs_++] = {lo, hi - lo, 0, axis[lo].local, 1, false, false, false};
    for (int i = hi; i < n; ++i) add_to_runs(i);
  }

  void add_to_runs(int i) {
    const Axis a = axis_[0][i];
    if (runs_ > 0) {
      Run& run = run_[runs_ - 1];
      const int step = a.local - (run.local + (run.n - 1) * run.step);
      if (a.offset == run.offset && a.flip == run.flip && a.outside == run.outside && a.open == run.open &&
          step >= -1 && step <= 1 && (run.n == 1 || step == run.step)) {
        run.step = step;
        ++run.n;
        return;
      }
    }
    run_[runs_++] = {i, 1, a.offset, a.local, 1, a.flip, a.outside, a.open};
  }

  template <class T, class From, std::size_t n>
  void gather_row(const Index<Dim>& row, const From& from, const std::array<Component<T>, n>& components,
                  Beyond beyond, T* out) const {
    int block_row = 0, cell_row = 0, block_stride = 3, cell_stride = layout_.extent(0);
    bool outside = false, open = false;
    unsigned flips = 0;
    for (int d = 1; d < Dim; ++d) {
      const Axis& a = axis_[d][row[d] - box_.lo[d]];
      block_row += (a.offset + 1) * block_stride;
      cell_row += a.local * cell_stride;
      block_stride *= 3;
      cell_stride *= layout_.extent(d);
      outside = outside || a.outside;
      open = open || a.open;
      flips |= static_cast<unsigned>(a.flip) << d;
    }
    const auto apart_from = static_cast<std::size_t>(layout_.size()),
               apart = static_cast<std::size_t>(size());
    for (int r = 0; r < runs_; ++r) {
      const Run& run = run_[r];
      const T* base = from[block_row + run.offset + 1];
      const bool nothing = base == nullptr || (beyond == Beyond::nothing && (outside || run.outside)) ||
                           (beyond == Beyond::mirror && (open || run.open));
      const unsigned turned = flips | (run.flip ? 1U : 0U);
      T* const to = out + run.to;
      if (nothing) {
        for (std::size_t c = 0; c < n; ++c)
          std::fill(to + c * apart, to + c * apart + run.n, components[c].missing);
        continue;
      }
      copy_run<n>(base + cell_row + run.local, apart_from, run, to, apart);
      if constexpr (std::is_same_v<T, double>)
        for (std::size_t c = 0; turned != 0 && c < n; ++c)
          if (__builtin_parity(turned & components[c].odd_axes) != 0)
            for (int i = 0; i < run.n; ++i) to[c * apart + i] = -to[c * apart + i];
    }
  }

  /// Copies a run of n components, which lie `apart_from` and `apart` one behind the other.
  template <std::size_t n, class T>
  static void copy_run(const T* from, std::size_t apart_from, const Run& run, T* to, std::size_t apart) {
    constexpr int short_run = 4;  // for which a call of memcpy costs more than it saves
    const int length = run.n;
    const auto each = [&](const auto& copy) {
      for (std::size_t c = 0; c < n; ++c, from += apart_from, to += apart) copy();
    };
    if (run.step == 1 && length > short_run)
      each([&] { std::memcpy(to, from, static_cast<std::size_t>(length) * sizeof(T)); });
    else if (run.step == 1)
      each([&] {
        for (int i = 0; i < length; ++i) to[i] = from[i];
      });
    else if (run.step == -1)
      each([&] {
        for (int i = 0; i < length; ++i) to[i] = from[-i];
      });
    else
      each([&] {
        for (int i = 0; i < length; ++i) to[i] = from[0];
      });
  }

  const Mesh<Dim>& mesh_;
  const Grid<Dim>& grid_;  // of the block's level
  Box<Dim> layout_, inner_, box_;
  Index<Dim> home_{};
  // Left as they are beyond what a window uses: setting them to zero would cost as much as a gather.
  std::array<std::array<Axis, longest>, Dim> axis_;
  std::array<Run, longest> run_;
  int runs_ = 0;
  std::array<int, static_cast<std::size_t>(power<Dim>(3))> slots_{};
};

}  // namespace recoil
