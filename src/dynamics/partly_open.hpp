#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/scratch.hpp"
#include "dynamics/block_work.hpp"

namespace recoil::detail {

/// The faces across one axis that are open in part. A reconstruction gives the value at the middle of a face;
/// through the open part flows what is at the middle of that. For a body that turns the difference of the
/// velocities is a strain and a flux of momentum whose moment always has the same sign, so that it gains 10 %
/// of its spin in a turn (docs/decisions/0049). Only the turning is made up for: what ghost values show of
/// strain across a free surface is not the matter's.
template <int Dim>
struct PartlyOpen {
  const std::uint8_t* is = nullptr;  // 1 where a face is open in part; null: none is
  const Vec<Dim>* middle = nullptr;  // of the open part there, from the middle of the face [dx]
};

/// Finds them among the faces across axis d of the inner cells of a window.
template <int Dim>
PartlyOpen<Dim> find_partly_open(const Window<Dim>& w, const Geometry<Dim>& g, int d, const Box<Dim>& faces,
                                 Scratch& scratch) {
  if (Dim == 1 || g.cuts.empty()) return {};
  const auto n = static_cast<std::size_t>(faces.size());
  auto* is = scratch.take_filled<std::uint8_t>(n, 0);
  auto* middle = scratch.take<Vec<Dim>>(n);
  const auto put = [&](int face, const Vec<Dim>& x) {
    if (x == Vec<Dim>{}) return;
    is[face] = 1;
    middle[face] = x;
  };
  for (const CutCell<Dim>& cut : g.cuts) {
    const Index<Dim> i = w.index_of(cut.cell);
    if (!w.inner().contains(i)) continue;
    put(faces.at(i), cut.open_middle[d][0]);
    if (i[d] == w.inner().hi[d] - 1) put(faces.at(i) + faces.stride(d), cut.open_middle[d][1]);
  }
  return {is, middle};
}

/// How a component of the velocity changes at cell k along an axis, per dx: by central differences, but no
/// more than twice either one-sided one (van Leer), so that what is torn, where neighbours have nothing to do
/// with each other, does not turn; by a one-sided one where only one neighbour has a value.
/// @param step distance in memory along the axis. @param low, high whether the neighbours have a value.
[[gnu::always_inline]] inline double velocity_slope(const double* u, std::ptrdiff_t step, bool low,
                                                    bool high) {
  const double below = u[0] - u[-step], above = u[step] - u[0];
  if (!low || !high) return high ? above : low ? below : 0.0;
  if (below * above <= 0) return 0;
  const double most = 2 * std::min(std::abs(below), std::abs(above));
  return std::clamp(0.5 * (below + above), -most, most);
}

/// The velocity at x [dx] from the middle of cell k, less that in the middle, of a rigid body that turns like
/// the matter there.
template <int Dim>
Vec<Dim> turning_velocity(const Work<Dim>& w, std::ptrdiff_t k, const Vec<Dim>& x) {
  const double* u = w.primitive + static_cast<std::size_t>(Components<Dim>::u) * w.wide + k;
  std::array<Vec<Dim>, Dim> slope{};  // [axis][component]
  for (int d = 0; d < Dim; ++d) {
    const std::ptrdiff_t step = w.window.stride(d);
    const bool low = !w.role || (w.role[k - step] & valued) != 0,
               high = !w.role || (w.role[k + step] & valued) != 0;
    for (int c = 0; c < Dim; ++c)
      if (c != d) slope[d][c] = velocity_slope(u + c * w.wide, step, low, high);
  }
  Vec<Dim> v;
  for (int c = 1; c < Dim; ++c)
    for (int d = 0; d < c; ++d) {
      const double rate = 0.5 * (slope[d][c] - slope[c][d]);
      v[c] += rate * x[d];
      v[d] -= rate * x[c];
    }
  return v;
}

/// Moves the velocities on both sides of a row of faces to the middles of their open parts. Face i of the row
/// is face `face + i`, the cell above it cell `cell + i`; its values stand at place i + left_from of `left`
/// and at place i + right_from of `right`.
template <int Dim>
void move_to_open_parts(const Work<Dim>& w, const PartlyOpen<Dim>& partly, int count, int face,
                        std::ptrdiff_t cell, std::ptrdiff_t step, FaceValues<Dim>& left, int left_from,
                        FaceValues<Dim>& right, int right_from) {
  using C = Components<Dim>;
  if (!partly.is) return;
  for (int i = 0; i < count; ++i) {
    if (partly.is[face + i] == 0) continue;
    const Vec<Dim>& x = partly.middle[face + i];
    const Vec<Dim> below = turning_velocity(w, cell + i - step, x), above = turning_velocity(w, cell + i, x);
    for (int c = 0; c < Dim; ++c) {
      left.value[C::u + c][i + left_from] += below[c];
      right.value[C::u + c][i + right_from] += above[c];
    }
  }
}

}  // namespace recoil::detail
