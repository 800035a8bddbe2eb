#include "interface/ghosts.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/constants.hpp"
#include "core/marks.hpp"
#include "core/multiversion.hpp"
#include "dynamics/block_work.hpp"
#include "interface/nearest_wall.hpp"
#include "levelset/distance.hpp"
#include "state/level_set_view.hpp"

namespace recoil {

using detail::face_reach;

namespace {

constexpr int wall_reach = 8;    // foot points lie up to 5 cells away, their walls 2 more
constexpr int walls_around = 2;  // cells between a foot point and its wall, along each axis

/// Of every cell around the inner ones of a window whose faces are read there: whether its low face across
/// axis d is open. Marks of the whole window, by axis.
template <int Dim>
std::array<std::uint8_t*, Dim> open_low_faces(const Body<Dim>& body, const Window<Dim>& w,
                                              const CellKind* kind, Scratch& scratch) {
  const auto n = static_cast<std::size_t>(w.size());
  std::array<std::uint8_t*, Dim> open;
  for (auto& marks : open) marks = scratch.take<std::uint8_t>(n + marks_beyond);
  auto* cut = scratch.take<std::uint8_t>(n + marks_beyond);
  for (std::size_t k = 0; k < n; ++k) {
    open[0][k] = kind[k] == CellKind::full ? 1 : 0;
    cut[k] = kind[k] == CellKind::cut ? 1 : 0;
  }
  std::fill_n(cut + n, marks_beyond, std::uint8_t{0});
  for (std::size_t d = 1; d < Dim; ++d) std::copy_n(open[0], n, open[d]);
  Box<Dim> rows = w.inner().grown(face_reach);
  const int width = rows.extent(0);
  rows.hi[0] = rows.lo[0] + 1;
  for_each(rows, [&](const Index<Dim>& row) {
    const int first = w.at(row);
    for_each_set(cut + first, width, [&](int c) {
      Index<Dim> i = row;
      i[0] += c;
      const auto from = w.source(i);
      const Geometry<Dim>& g = body.at(from.slot).geometry;
      const CutCell<Dim>& cell = g.cuts[g.index[from.cell]];
      for (int d = 0; d < Dim; ++d) {
        const int side = (from.flips >> d & 1U) != 0 ? 1 : 0;
        open[static_cast<std::size_t>(d)][first + c] = cell.open[d][side] > 0 ? 1 : 0;
      }
    });
  });
  return open;
}

/// Marks the cells of a row that a face reads and whose own average does not stand in stencils.
/// @param open see open_low_faces(), of the row's first cell.
template <int Dim>
RECOIL_MULTIVERSION void find_ghosts(int count, std::array<const std::uint8_t*, Dim> open,
                                     std::array<int, Dim> stride, const std::uint8_t* role,
                                     std::uint8_t* ghost) {
#pragma GCC ivdep
  for (int c = 0; c < count; ++c) {
    unsigned read = 0;
    for_each_axis<Dim>([&](auto d) RECOIL_INLINE {
      for_each_constant<2 * face_reach>(
          [&](auto o) RECOIL_INLINE { read |= open[d][c + (o + 1 - face_reach) * stride[d]]; });
    });
    ghost[c] = static_cast<std::uint8_t>((role[c] & regular) != 0 ? 0 : read);
  }
}

/// f(i) for the inner cells of a window that find_ghosts() marks.
template <int Dim, class F>
void for_each_read_by_a_face(const Body<Dim>& body, const BodyBlock<Dim>& b, const Window<Dim>& w,
                             const CellKind* kind, Scratch& scratch, F&& f) {
  const auto open = open_low_faces(body, w, kind, scratch);
  std::array<int, Dim> stride;
  for (int d = 0; d < Dim; ++d) stride[static_cast<std::size_t>(d)] = w.stride(d);
  std::array<std::uint8_t, Window<Dim>::longest + marks_beyond> ghost{};
  Box<Dim> rows = w.inner();
  const int width = rows.extent(0);
  rows.hi[0] = rows.lo[0] + 1;
  for_each(rows, [&](const Index<Dim>& row) {
    std::array<const std::uint8_t*, Dim> from;
    for (std::size_t d = 0; d < Dim; ++d) from[d] = open[d] + w.at(row);
    find_ghosts<Dim>(width, from, stride, b.role.data() + w.cell(row), ghost.data());
    for_each_set(ghost.data(), width, [&](int c) {
      Index<Dim> i = row;
      i[0] += c;
      f(i);
    });
  });
}

/// Whether cell i, which is not real, is within three of the face of a real cell, along its axis.
template <int Dim>
bool read_by_a_real_cell(const Window<Dim>& w, const std::uint8_t* role, const Index<Dim>& i) {
  for (int d = 0; d < Dim; ++d)
    for (int o = 1; o <= face_reach; ++o)
      if (((role[w.at(i) + o * w.stride(d)] | role[w.at(i) - o * w.stride(d)]) & regular) != 0) return true;
  return false;
}

template <int Dim>
void put_wall(GhostCell<Dim>& ghost, const NearWall<Dim>& near) {
  ghost.slot = near.slot;
  ghost.wall = near.wall;
  ghost.flips = near.flips;
  ghost.from_wall = near.from_wall;
}

/// For a ghost i whose nearest surface has no wall: that of a fragment too thin for the geometry. Matter
/// beyond the fragment's void reads the ghost as well, and its own wall gives the value.
template <int Dim>
void take_nearest_wall(const State<Dim>& state, const Body<Dim>& body, const Window<Dim>& w, const int* index,
                       const Index<Dim>& i, GhostCell<Dim>& ghost) {
  const Vec<Dim> x = state.grid().centre(i);
  NearWall<Dim> near = nearest_wall(state, body, w, index, x, face_reach);
  if (near.slot < 0) return;
  const Vec<Dim>& surface = body.at(near.slot).geometry.cuts[near.wall].surface;
  const Vec<Dim> own = (1 / norm(surface)) * surface;  // in the wall's frame, as from_wall
  const double distance = dot(near.from_wall, own);
  if (!(distance > 0)) return;
  ghost.normal = flipped(own, near.flips);
  ghost.distance = distance;
  near.from_wall -= distance * own;
  put_wall(ghost, near);
}

}  // namespace

template <int Dim>
void choose_ghosts(const State<Dim>& state, Body<Dim>& body, int slot, Cells cells, Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  b.ghosts.clear();
  if (!b.near_surface || b.reach.size() == 0) return;
  const Grid<Dim>& grid = state.grid();
  const Window<Dim> w(state.mesh, slot, wall_reach, b.reach);
  const auto n = static_cast<std::size_t>(w.size());
  const double* phi = view_level_set(state.grid(), body, w, &BodyBlock<Dim>::phi, scratch);
  auto* kind = scratch.take<CellKind>(n);
  int* index = scratch.take<int>(n);
  w.gather([&](int s) { return body.present(s) ? body.at(s).geometry.kind.data() : nullptr; },
           CellKind::empty, Beyond::extend, kind);
  w.gather([&](int s) { return body.present(s) ? body.at(s).geometry.index.data() : nullptr; }, -1,
           Beyond::mirror, index);
  std::uint8_t* role = nullptr;
  if (cells == Cells::whole) {
    role = scratch.take<std::uint8_t>(n);
    w.gather([&](int s) { return body.present(s) ? body.at(s).role.data() : nullptr; }, std::uint8_t{0},
             Beyond::extend, role);
  }
  const auto add = [&](const Index<Dim>& i) {
    const Foot<Dim> foot = foot_point(grid, w.box(), phi, i);
    GhostCell<Dim> ghost;
    ghost.cell = w.cell(i);
    ghost.normal = foot.normal;
    ghost.distance = foot.distance;
    put_wall(ghost, nearest_wall(state, body, w, index, foot.point, walls_around));
    if (ghost.slot < 0) take_nearest_wall(state, body, w, index, i, ghost);
    b.ghosts.push_back(ghost);
  };
  if (role) {
    for_each(w.inner(), [&](const Index<Dim>& i) {
      if ((b.role[w.cell(i)] & regular) == 0 && read_by_a_real_cell(w, role, i)) add(i);
    });
    return;
  }
  for_each_read_by_a_face(body, b, w, kind, scratch, add);
}

#define RECOIL_INSTANTIATE(Dim) \
  template void choose_ghosts<Dim>(const State<Dim>&, Body<Dim>&, int, Cells, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
