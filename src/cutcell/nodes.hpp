#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "cutcell/geometry.hpp"

namespace recoil {

/// phi at the nodes of one block for one body. Node i is the low corner of cell i.
struct Nodes {
  int body = 0;
  std::string_view name;  // of the body
  bool rigid = false;
  double* phi = nullptr;
  std::uint32_t* contact = nullptr;  // bits of the partners of the cells around; null without contact
};

/// The nodes of a box of cells.
template <int Dim>
Box<Dim> node_box(const Box<Dim>& cells) {
  Box<Dim> b = cells;
  for (int d = 0; d < Dim; ++d) ++b.hi[d];
  return b;
}

/// From the place of a node or cell to those of the 2^Dim cells or nodes around it.
template <int Dim>
using Offsets = std::array<int, 1 << Dim>;

/// Means of phi over the cells around the nodes of the inner cells of a window, taken from the scratch; those
/// of rigid bodies that are near are exact. No surface lies on a node.
/// @param ahead seconds from now to `when`.
template <int Dim>
Nodes node_values(const State<Dim>& state, const Window<Dim>& w, int body, PhiAt when, double ahead,
                  Scratch& scratch);

/// One surface for the two nearest bodies of node k, where they touch.
void share_node(std::span<Nodes> nodes, int k, double dx);

}  // namespace recoil
