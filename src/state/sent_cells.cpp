#include "state/sent_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/error.hpp"

namespace recoil {

namespace {

constexpr double rounding = 1e-14;  // part of a cell: below what moves of volume take for an excess

/// Whether a move of volume may begin in a cell.
bool may_move(CellKind kind, double volume, double full) {
  if (kind == CellKind::empty) return volume != 0;
  return kind == CellKind::cut || std::abs(volume - full) > rounding * full;
}

/// Where volume may move from within one cell. Of the cells beyond the block nothing is known yet, so that
/// all of its outermost layer is sent.
template <int Dim>
void choose_around_moves(const State<Dim>& state, const BodyBlock<Dim>& b, int slot,
                         std::vector<std::uint8_t>& chosen) {
  const Grid<Dim>& grid = state.grid(slot);
  const Box<Dim> layout = grid.layout(), cells = state.mesh.block(slot).cells;
  const Box<Dim> own{{}, cells.hi - cells.lo};
  const auto& kind = b.end_geometry.kind.raw();
  const auto& volume = b.volume.raw();
  for_each(own, [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(layout.at(i));
    Box<Dim> around{i, i};
    bool outermost = false;
    for (int d = 0; d < Dim; ++d) {
      outermost = outermost || i[d] == 0 || i[d] + 1 == own.hi[d];
      around.lo[d] = std::max(i[d] - 1, 0);
      around.hi[d] = std::min(i[d] + 2, own.hi[d]);
    }
    if (outermost) chosen[k] = 1;
    if (!may_move(kind[k], volume[k], grid.full_volume(cells.lo + i))) return;
    for_each(around, [&](const Index<Dim>& j) { chosen[static_cast<std::size_t>(layout.at(j))] = 1; });
  });
}

/// Each cell once.
void put_cells(parallel::Bytes& bytes, std::vector<int>& cells) {
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  parallel::pack(bytes, static_cast<std::uint32_t>(cells.size()));
  parallel::pack(bytes, cells.data(), cells.size());
}

/// @param cells of a block.
void mark_cells(parallel::Unpacker& from, std::size_t cells, std::vector<std::uint8_t>& marked) {
  std::vector<int> list(from.read<std::uint32_t>());
  from.read(list.data(), list.size());
  if (!list.empty()) marked.assign(cells, 0);
  for (const int cell : list) marked[static_cast<std::size_t>(cell)] = 1;
}

}  // namespace

template <int Dim>
std::vector<std::uint8_t> cells_with_sent_contents(const State<Dim>& state, const Body<Dim>& body, int slot,
                                                   const ReadAround& read) {
  if (read.contents == ContentsSent::all || read.contents == ContentsSent::between_steps) return {};
  const BodyBlock<Dim>& b = body.at(slot);
  std::vector<std::uint8_t> chosen;
  if (read.contents == ContentsSent::around_small_fragments) {
    require(read.around_small != nullptr, "cells around small fragments were marked");
    chosen = read.around_small->of(slot, static_cast<std::size_t>(&body - state.bodies.data()));
  }
  chosen.resize(static_cast<std::size_t>(state.grid(slot).layout().size()), 0);
  if (read.contents == ContentsSent::around_moves) choose_around_moves(state, b, slot, chosen);
  if (read.contents == ContentsSent::of_cut_cells)
    for (const CutCell<Dim>& cut : b.end_geometry.cuts.raw()) chosen[static_cast<std::size_t>(cut.cell)] = 1;
  return chosen;
}

template <int Dim>
parallel::Bytes ask_for_cells(const State<Dim>& state, const typename Mesh<Dim>::Peer& peer) {
  const Mesh<Dim>& mesh = state.mesh;
  std::vector<int> place(static_cast<std::size_t>(mesh.slots()), -1);  // in Peer::receive
  for (std::size_t r = 0; r < peer.receive.size(); ++r)
    place[static_cast<std::size_t>(peer.receive[r])] = static_cast<int>(r);
  parallel::Bytes bytes;
  for (const Body<Dim>& body : state.bodies) {
    if (body.rigid) continue;
    std::vector<std::vector<int>> donors(peer.receive.size()), walls(peer.receive.size());
    for (const int slot : peer.send) {  // others touch none of its blocks
      const BodyBlock<Dim>& b = body.at(slot);
      for (const DonorCell& donor : b.donors.cells.raw())
        if (const int r = place[static_cast<std::size_t>(donor.slot)]; r >= 0)
          donors[static_cast<std::size_t>(r)].push_back(donor.cell);
      for (const GhostCell<Dim>& ghost : b.ghosts.raw())
        if (const int r = ghost.slot < 0 ? -1 : place[static_cast<std::size_t>(ghost.slot)]; r >= 0)
          walls[static_cast<std::size_t>(r)].push_back(
              body.at(ghost.slot).geometry.cuts.raw()[static_cast<std::size_t>(ghost.wall)].cell);
    }
    for (std::size_t r = 0; r < peer.receive.size(); ++r)
      put_cells(bytes, donors[r]), put_cells(bytes, walls[r]);
  }
  return bytes;
}

template <int Dim>
AskedCells take_asked_cells(const State<Dim>& state, const typename Mesh<Dim>::Peer& peer,
                            const parallel::Bytes& bytes) {
  const std::size_t bodies = state.bodies.size(),
                    cells = static_cast<std::size_t>(state.grid().layout().size());
  AskedCells asked;
  for (MarkedCells* marks : {&asked.donors, &asked.walls}) {
    marks->bodies = bodies;
    marks->lists.resize(static_cast<std::size_t>(state.mesh.local()) * bodies);
  }
  parallel::Unpacker from(bytes);
  for (std::size_t m = 0; m < bodies; ++m) {
    if (state.bodies[m].rigid) continue;
    for (const int slot : peer.send)
      for (MarkedCells* marks : {&asked.donors, &asked.walls}) mark_cells(from, cells, marks->of(slot, m));
  }
  require(from.empty(), "a message of cells that are asked for");
  return asked;
}

template <int Dim>
void pack_motion(const Wall<Dim>& wall, parallel::Bytes& bytes) {
  using C = Components<Dim>;
  parallel::pack(bytes, wall.donors);
  parallel::pack(bytes, wall.value[C::rho]);
  parallel::pack(bytes, wall.range[C::rho]);
  parallel::pack(bytes, &wall.range[C::u], Dim);
  parallel::pack(bytes, &wall.gradient[C::u], Dim);
  parallel::pack(bytes, wall.mean_velocity);
}

template <int Dim>
Wall<Dim> unpack_motion(parallel::Unpacker& from) {
  using C = Components<Dim>;
  Wall<Dim> wall;
#ifndef NDEBUG
  wall.value.fill(std::numeric_limits<double>::quiet_NaN());
  wall.range.fill(std::numeric_limits<double>::quiet_NaN());
#endif
  from.read(&wall.donors, 1);
  from.read(&wall.value[C::rho], 1);
  from.read(&wall.range[C::rho], 1);
  from.read(&wall.range[C::u], Dim);
  from.read(&wall.gradient[C::u], Dim);
  from.read(&wall.mean_velocity, 1);
  return wall;
}

#define RECOIL_INSTANTIATE(Dim)                                                                              \
  template std::vector<std::uint8_t> cells_with_sent_contents<Dim>(const State<Dim>&, const Body<Dim>&, int, \
                                                                   const ReadAround&);                       \
  template parallel::Bytes ask_for_cells<Dim>(const State<Dim>&, const Mesh<Dim>::Peer&);                    \
  template AskedCells take_asked_cells<Dim>(const State<Dim>&, const Mesh<Dim>::Peer&,                       \
                                            const parallel::Bytes&);                                         \
  template void pack_motion<Dim>(const Wall<Dim>&, parallel::Bytes&);                                        \
  template Wall<Dim> unpack_motion<Dim>(parallel::Unpacker&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
