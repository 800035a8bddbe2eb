#pragma once

#include <cstddef>

#include "state/body.hpp"

namespace recoil {

/// Where blocks of two levels meet, the coarser one takes the fluxes of the finer ones, and the velocities
/// that feed its stresses: what leaves the one enters the other. A finer block keeps them in BodyBlock::rims:
/// for every side (2 axis + side) [contents, then velocities][faces of the side, in the order of the layout].
template <int Dim>
class RimFluxes {
 public:
  static constexpr std::size_t contents = Components<Dim>::contents, components = contents + Dim;

  explicit RimFluxes(const Grid<Dim>& grid) : layout_(grid.layout()) {}

  std::size_t faces(int axis) const {
    return static_cast<std::size_t>(layout_.size() / layout_.extent(axis));
  }
  std::size_t size() const {
    std::size_t n = 0;
    for (int d = 0; d < Dim; ++d) n += 2 * components * faces(d);
    return n;
  }
  /// Place of a component of the face of a side at a cell of the block (index from its low corner).
  std::size_t at(int axis, int side, std::size_t component, const Index<Dim>& local) const {
    std::size_t first = 0;
    for (int d = 0; d < axis; ++d) first += 2 * components * faces(d);
    first += (static_cast<std::size_t>(side) * components + component) * faces(axis);
    std::size_t k = 0;
    for (int d = Dim - 1; d >= 0; --d)
      if (d != axis) k = k * static_cast<std::size_t>(layout_.extent(d)) + static_cast<std::size_t>(local[d]);
    return first + k;
  }

 private:
  Box<Dim> layout_;
};

}  // namespace recoil
