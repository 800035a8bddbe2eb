#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/scratch.hpp"
#include "cutcell/geometry.hpp"
#include "cutcell/window_contents.hpp"
#include "state/body.hpp"
#include "state/level_set_view.hpp"

namespace recoil {

/// A window on the end-of-step geometry, volumes and contents of one body: what a move of volume or contents
/// between cells is decided by. It reads the state only; its arrays are the caller's scratch memory.
template <int Dim>
class MovesView {
 public:
  MovesView(const State<Dim>& state, const Body<Dim>& body, int slot, int halo, Scratch& scratch)
      : grid(state.grid(slot)),
        window(state.mesh, slot, halo, body.at(slot).reach),
        state_(state),
        body_(body),
        slot_(slot),
        scratch_(scratch) {
    const std::size_t n = window.size();
    volume = scratch.take<double>(n);
    kind = scratch.take<CellKind>(n);
    window.gather([&](int s) { return body.present(s) ? body.at(s).volume.data() : nullptr; }, 0.0,
                  Beyond::nothing, volume);
    window.gather([&](int s) { return body.present(s) ? body.at(s).end_geometry.kind.data() : nullptr; },
                  CellKind::empty, Beyond::nothing, kind);
  }

  void gather_phi() { phi = view_level_set(grid, body_, window, &BodyBlock<Dim>::phi, scratch_); }

  /// Finds what the other bodies that can be deformed hold in the cells of the window.
  void gather_others() {
    const auto n = static_cast<std::size_t>(window.size());
    double* one = nullptr;
    for (const Body<Dim>& other : state_.bodies) {
      if (&other == &body_ || other.rigid || !is_near(other)) continue;
      if (!others) others = scratch_.take_filled<double>(n, 0.0);
      if (!one) one = scratch_.take<double>(n);
      window.gather([&](int s) { return other.present(s) ? other.at(s).volume.data() : nullptr; }, 0.0,
                    Beyond::nothing, one);
      for (std::size_t k = 0; k < n; ++k) others[k] += one[k];
    }
  }

  /// Volume of a cell that no body has. Needs gather_others().
  double room(const Index<Dim>& i) const {
    const int k = window.at(i);
    return full(i) - volume[k] - (others ? others[k] : 0);
  }
  /// Whether another body has a part of a cell.
  bool is_shared(const Index<Dim>& i) const { return others && others[window.at(i)] > 0; }

  /// Whether the centre of a cell is in a rigid body, or within half a cell of one.
  bool is_beside_rigid(const Index<Dim>& i) const {
    const auto from = window.source_inside(i);
    return std::any_of(state_.bodies.begin(), state_.bodies.end(), [&](const Body<Dim>& other) {
      return other.rigid && other.present(from.slot) && other.at(from.slot).phi[from.cell] < 0.5 * grid.dx;
    });
  }

  bool exists(const Index<Dim>& i) const { return window.source_inside(i).slot >= 0; }
  double full(const Index<Dim>& i) const { return grid.full_volume(i); }

  Contents<Dim> contents(const Index<Dim>& i) const { return contents_at(body_, window, i); }

  /// The cut cell of the end-of-step geometry there, or null.
  const CutCell<Dim>* cut(const Index<Dim>& i) const {
    if (kind[window.at(i)] != CellKind::cut) return nullptr;
    const auto from = window.source_inside(i);
    const auto& g = body_.at(from.slot).end_geometry;
    return &g.cuts[g.index[from.cell]];
  }

  /// The neighbour along sign * grad phi, on its main axis; along the next one where the domain ends. i
  /// itself: none.
  Index<Dim> neighbour(const Index<Dim>& i, int sign) const {
    const Vec<Dim> g = phi_normal(window.box(), phi, i, grid.dx);
    std::array<bool, Dim> tried{};
    for (int n = 0; n < Dim; ++n) {
      int axis = -1;
      for (int d = 0; d < Dim; ++d)
        if (!tried[d] && (axis < 0 || std::abs(g[d]) > std::abs(g[axis]))) axis = d;
      tried[axis] = true;
      Index<Dim> j = i;
      j[axis] += g[axis] * sign > 0 ? 1 : -1;
      if (exists(j)) return j;
    }
    return i;
  }

  /// Whether a cell surely takes part in moves, here or on the process that holds it: near enough to the
  /// surface to lie within its block's reach, or with matter. What was sent elsewhere would be lost. Needs
  /// gather_phi().
  bool can_take(const Index<Dim>& i) const {
    const int k = window.at(i);
    return phi[k] < (reach_cells - drift) * grid.dx || volume[k] != 0;
  }

  /// Whether the blocks beside a cell surely move volume as well, here or on the process that holds them: the
  /// cell is near enough to the surface. What was sent to others would be lost. Needs gather_phi().
  bool takes_part(const Index<Dim>& i) const {
    return std::abs(phi[window.at(i)]) < (far_cells - drift) * grid.dx;
  }

  /// Whether the body is thinner than about two cells here: least sum over an axis of V/full over five cells.
  bool thin(const Index<Dim>& i) const {
    for (int d = 0; d < Dim; ++d) {
      double sum = 0;
      for (int o = -2; o <= 2; ++o) {
        Index<Dim> j = i;
        j[d] += o;
        sum += std::max(volume[window.at(j)], 0.0) / full(j);
      }
      if (sum < thin_sum) return true;
    }
    return false;
  }

  const Grid<Dim>& grid;
  Window<Dim> window;
  double *volume = nullptr, *phi = nullptr;  // [window]; phi after gather_phi()
  double* others = nullptr;  // [window], after gather_others(); null where there is no other body
  CellKind* kind = nullptr;  // [window]

 private:
  /// Whether a body is present in the block or beside it: at their common border both blocks have to find the
  /// same room, or what passes there would not be the same for both.
  bool is_near(const Body<Dim>& other) const {
    const auto& beside = state_.mesh.block(slot_).neighbour;
    return other.present(slot_) ||
           std::any_of(beside.begin(), beside.end(), [&](int s) { return s >= 0 && other.present(s); });
  }

  static constexpr double drift = 1.5;  // cells that a surface may move since the reach was found

  // A body with less than so many cells of matter in five is thin.
  static constexpr double thin_sum = 1.75;

  const State<Dim>& state_;
  const Body<Dim>& body_;
  int slot_;
  Scratch& scratch_;
};

/// to += factor q.
template <int Dim>
void add_scaled(Contents<Dim>& to, const Contents<Dim>& q, double factor) {
  for (std::size_t c = 0; c < to.size(); ++c) to[c] += factor * q[c];
}

/// Velocity of what a cell holds [m/s]; 0 without mass.
template <int Dim>
Vec<Dim> velocity(const Contents<Dim>& q) {
  Vec<Dim> u{};
  if (q[Components<Dim>::rho] != 0)
    for (int d = 0; d < Dim; ++d) u[d] = q[Components<Dim>::u + d] / q[Components<Dim>::rho];
  return u;
}

}  // namespace recoil
