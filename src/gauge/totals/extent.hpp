#pragma once

#include <cstddef>

#include "gauge/totals/body_sums.hpp"
#include "parallel/exact_sums.hpp"
#include "state/body.hpp"

namespace recoil {

/// Deeper cells give the surface less accurately [dx of the finest level].
inline constexpr double extent_depth = 2;

/// A ball of radius |phi| about a place x inside lies within the body, and touches its surface, so the
/// farthest such ball shows how far the body reaches.
template <int Dim>
void reach_out(const Vec<Dim>& x, double phi, double finest, const SumRow& out) {
  using A = BodySums<Dim>;
  if (!(phi < 0) || phi < -extent_depth * finest) return;
  for (std::size_t d = 0; d < Dim; ++d) {
    const double c = x[static_cast<int>(d)];
    out.raise(A::highest + d, c - phi);
    out.raise(A::minus_lowest + d, -(c + phi));
  }
}

/// In 1-D a body that reaches a plane of symmetry or the centre ends there.
template <int Dim>
void reach_mirrors(const Grid<Dim>& grid, const BodyBlock<Dim>& b, const Box<Dim>& cells, const SumRow& out) {
  using A = BodySums<Dim>;
  if constexpr (Dim == 1)
    for (const int side : {0, 1}) {
      const Index<1> i{{side == 0 ? 0 : grid.cells[0] - 1}};
      if (grid.edge[0][static_cast<std::size_t>(side)] != Edge::reflect || !cells.contains(i)) continue;
      if (!(b.phi[static_cast<std::size_t>(grid.layout().at(i - cells.lo))] < 0)) continue;
      const double end = grid.origin[0] + (i[0] + side) * grid.dx;
      out.raise(side == 0 ? A::minus_lowest : A::highest, side == 0 ? -end : end);
    }
}

template <int Dim>
void find_extent(const Grid<Dim>& grid, double finest, const BodyBlock<Dim>& b, const Box<Dim>& cells,
                 const SumRow& out) {
  const Box<Dim> layout = grid.layout();
  for_each(cells, [&](const Index<Dim>& i) {
    reach_out(grid.centre(i), b.phi[static_cast<std::size_t>(layout.at(i - cells.lo))], finest, out);
  });
  reach_mirrors(grid, b, cells, out);
}

/// The same of a rigid body, of which coarse cells know little: by its distance from the cells of the finest
/// level in a block of any level. Cells farther from the surface than their own corners hold nothing of it.
template <int Dim>
void find_rigid_extent(const State<Dim>& state, const RigidMotion<Dim>& motion, int slot, const SumRow& out) {
  const Grid<Dim>&finest = state.grid(), &grid = state.grid(slot);
  const RigidPose<Dim> pose{motion.centre, motion.turn};
  const Block<Dim>& block = state.mesh.block(slot);
  const auto may_hold = [&](const Box<Dim>& cells, double dx) {
    Vec<Dim> middle, half;
    for (int d = 0; d < Dim; ++d) {
      half[d] = 0.5 * cells.extent(d) * dx;
      middle[d] = grid.origin[d] + cells.lo[d] * dx + half[d];
    }
    const double phi = distance_at(motion, pose, middle);
    return phi < norm(half) && phi > -norm(half) - extent_depth * finest.dx;
  };
  if (!may_hold(block.cells, grid.dx)) return;
  for_each(block.cells, [&](const Index<Dim>& i) {
    Box<Dim> own{i, i};
    for (int d = 0; d < Dim; ++d) own.lo[d] <<= block.level, own.hi[d] = (i[d] + 1) << block.level;
    if (block.level > 0 && !may_hold(own, finest.dx)) return;
    for_each(own, [&](const Index<Dim>& j) {
      const Vec<Dim> x = finest.centre(j);
      reach_out(x, distance_at(motion, pose, x), finest.dx, out);
    });
  });
}

}  // namespace recoil
