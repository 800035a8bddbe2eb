#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace recoil {

/// Cells of a block that lie one after the other in its layout.
struct CellRun {
  int first = 0, cells = 0;
};

/// The cells of a block that lie near blocks of some process: what it reads of its copy.
struct NearCells {
  std::vector<CellRun> runs;  // in the order of the layout
  std::vector<char> holds;    // whether a cell is one of them, by place in the layout
  int count = 0;
};

/// The cells of a leaf that are at most `reach` cells away from a leaf of process `rank` which touches it.
/// Towards leaves of another level as many as their stand-ins are made from. Owner and holder of a copy find
/// the same cells, because both know all leaves of either process that touch the block.
template <int Dim>
NearCells cells_near(const Mesh<Dim>& mesh, int slot, int rank, int reach);

}  // namespace recoil
