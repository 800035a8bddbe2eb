#include "state/near_cells.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace recoil {

namespace {

/// How far into a block the process reads which may own a leaf at `offset`; 0: it owns none there.
template <int Dim>
int reach_from(const Mesh<Dim>& mesh, int beside, const Index<Dim>& offset, int rank, int reach) {
  const auto is_its = [&](int s) { return s >= 0 && mesh.owner(mesh.block(s).order) == rank; };
  if (beside < 0) return 0;
  if (!mesh.is_stand_in(beside)) return is_its(beside) ? reach : 0;
  const StandIn<Dim>& by = mesh.stand_in(beside);
  bool any = by.from_coarser && is_its(by.from[0]);
  for (unsigned c = 0; !by.from_coarser && c < by.from.size(); ++c)
    any = any || (child_touches(c, offset) && is_its(by.from[c]));
  // A coarser leaf reads two of these cells for each of a stand-in; a finer one half as many, and one more
  // for slopes.
  return any ? std::max(reach, 2 * stand_in_reach) : 0;
}

NearCells runs_of(std::vector<char>&& holds) {
  NearCells near;
  const int n = static_cast<int>(holds.size());
  for (int k = 0; k < n; ++k) {
    if (holds[static_cast<std::size_t>(k)] == 0) continue;
    if (near.runs.empty() || near.runs.back().first + near.runs.back().cells != k)
      near.runs.push_back({k, 0});
    ++near.runs.back().cells;
    ++near.count;
  }
  near.holds = std::move(holds);
  return near;
}

}  // namespace

template <int Dim>
NearCells cells_near(const Mesh<Dim>& mesh, int slot, int rank, int reach) {
  const Block<Dim>& block = mesh.block(slot);
  const Box<Dim> layout = mesh.grid(slot).layout();
  std::vector<char> holds(static_cast<std::size_t>(layout.size()), 0);
  Box<Dim> around;
  for (int d = 0; d < Dim; ++d) around.lo[d] = -1, around.hi[d] = 2;
  for_each(around, [&](const Index<Dim>& o) {
    if (o == Index<Dim>{}) return;
    const int deep =
        reach_from(mesh, block.neighbour[static_cast<std::size_t>(around.at(o))], o, rank, reach);
    if (deep == 0) return;
    Box<Dim> rim{{}, block.cells.hi - block.cells.lo};
    for (int d = 0; d < Dim; ++d) {
      if (o[d] < 0) rim.hi[d] = std::min(rim.hi[d], deep);
      if (o[d] > 0) rim.lo[d] = std::max(rim.lo[d], rim.hi[d] - deep);
    }
    for_each(rim, [&](const Index<Dim>& i) { holds[static_cast<std::size_t>(layout.at(i))] = 1; });
  });
  return runs_of(std::move(holds));
}

template NearCells cells_near<1>(const Mesh<1>&, int, int, int);
template NearCells cells_near<2>(const Mesh<2>&, int, int, int);
template NearCells cells_near<3>(const Mesh<3>&, int, int, int);

}  // namespace recoil
