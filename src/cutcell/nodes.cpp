#include "cutcell/nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "core/multiversion.hpp"
#include "state/level_set_view.hpp"

namespace recoil {

namespace {

constexpr double shared_gap = 0.15;         // closer than this [dx], one surface cuts both
constexpr double shared_contact_gap = 0.5;  // or than this beside cells in contact
constexpr double off_node = 1e-6;           // a surface is kept this far [dx] from nodes
constexpr double exact_band = 3;            // nodes of rigid bodies nearer than this [dx] are exact

/// Offsets into the window of the 2^Dim cells around a node.
template <int Dim>
Offsets<Dim> around_node(const Window<Dim>& w) {
  Offsets<Dim> offset{};
  for (int c = 0; c < 1 << Dim; ++c)
    for (int d = 0; d < Dim; ++d) offset[c] -= (c >> d & 1) * w.stride(d);
  return offset;
}

/// Distance of a node from a rigid body. A node on an edge of a period is a node on the opposite edge as
/// well: the nearer of what both see.
template <int Dim>
double rigid_node(const Grid<Dim>& grid, const RigidMotion<Dim>& motion, const RigidPose<Dim>& pose,
                  const Index<Dim>& i) {
  int both = 0;
  for (int d = 0; d < Dim; ++d)
    if (grid.periodic(d) && (i[d] == 0 || i[d] == grid.cells[d])) both |= 1 << d;
  double nearest = far_cells * grid.dx;
  for (int c = 0; c < 1 << Dim; ++c) {
    if ((c & both) != c) continue;
    Vec<Dim> x;
    for (int d = 0; d < Dim; ++d) {
      const int at = (both >> d & 1) == 0 ? i[d] : (c >> d & 1) != 0 ? grid.cells[d] : 0;
      x[d] = grid.origin[d] + at * grid.dx;
    }
    nearest = std::min(nearest, distance_at(motion, pose, x));
  }
  return nearest;
}

/// Whether a node lies on an open edge. Such nodes see bodies continued as the first cells are: all alike.
template <int Dim>
bool at_outflow(const Grid<Dim>& grid, const Index<Dim>& i) {
  for (int d = 0; d < Dim; ++d) {
    const auto& edge = grid.edge[d];
    if ((i[d] == 0 && edge[0] == Edge::outflow) || (i[d] == grid.cells[d] && edge[1] == Edge::outflow))
      return true;
  }
  return false;
}

/// phi and the bits of contact of one body in the cells of a window; null where it has no contact.
struct CellValues {
  double* phi = nullptr;
  std::uint32_t* contact = nullptr;
};

template <int Dim>
CellValues cell_values(const State<Dim>& state, const Window<Dim>& w, const Body<Dim>& b, PhiAt when,
                       Scratch& scratch) {
  CellValues cells;
  cells.phi =
      view_level_set(state.grid(), b, w,
                     when == PhiAt::midstep ? &BodyBlock<Dim>::phi_midstep : &BodyBlock<Dim>::phi, scratch);
  if (b.rigid) return cells;
  cells.contact = scratch.take<std::uint32_t>(w.size());
  w.gather([&](int s) { return b.present(s) ? b.at(s).contact.data() : nullptr; }, std::uint32_t{0},
           Beyond::extend, cells.contact);
  if (std::all_of(cells.contact, cells.contact + w.size(), [](std::uint32_t c) { return c == 0; }))
    cells.contact = nullptr;
  return cells;
}

/// The means of the cells around the nodes of a row.
template <int Dim>
RECOIL_MULTIVERSION void mean_around(const double* cell, const Offsets<Dim>& around, int count,
                                     double* node) {
  constexpr double share = 1.0 / (1 << Dim);
#pragma GCC ivdep
  for (int c = 0; c < count; ++c) {
    double sum = 0;
    for (const int o : around) sum += cell[c + o];
    node[c] = share * sum;
  }
}

/// The bits that any of the cells around the nodes of a row has.
template <int Dim>
RECOIL_MULTIVERSION void all_around(const std::uint32_t* cell, const Offsets<Dim>& around, int count,
                                    std::uint32_t* node) {
#pragma GCC ivdep
  for (int c = 0; c < count; ++c) {
    std::uint32_t bits = 0;
    for (const int o : around) bits |= cell[c + o];
    node[c] = bits;
  }
}

/// Keeps the surface off the nodes of a row.
RECOIL_MULTIVERSION void push_off(int count, double push, double* node) {
#pragma GCC ivdep
  for (int c = 0; c < count; ++c) node[c] = std::abs(node[c]) < push ? (node[c] < 0 ? -push : push) : node[c];
}

}  // namespace

template <int Dim>
Nodes node_values(const State<Dim>& state, const Window<Dim>& w, int body, PhiAt when, double ahead,
                  Scratch& scratch) {
  const Body<Dim>& b = state.bodies[body];
  const auto pose = b.rigid ? std::optional(pose_after(*b.rigid, ahead)) : std::nullopt;
  const Box<Dim> nodes = node_box(w.inner());
  Nodes n{body, b.name, b.rigid.has_value(), scratch.take<double>(nodes.size()), nullptr};
  const CellValues cells = cell_values(state, w, b, when, scratch);
  if (cells.contact) n.contact = scratch.take<std::uint32_t>(nodes.size());
  const double push = off_node * state.grid().dx, band = exact_band * state.grid().dx;
  const auto around = around_node(w);
  Box<Dim> rows = nodes;
  rows.hi[0] = rows.lo[0] + 1;
  const int width = nodes.extent(0);
  for_each(rows, [&](Index<Dim> i) {
    const double* p = cells.phi + w.at(i);
    double* value = n.phi + nodes.at(i);
    mean_around<Dim>(p, around, width, value);
    if (cells.contact) all_around<Dim>(cells.contact + w.at(i), around, width, n.contact + nodes.at(i));
    for (int c = 0; pose && c < width; ++c, ++i[0])
      if (std::abs(value[c]) < band && !at_outflow(state.grid(), i))
        value[c] = rigid_node(state.grid(), *b.rigid, *pose, i);
    push_off(width, push, value);
  });
  return n;
}

void share_node(std::span<Nodes> nodes, int k, double dx) {
  Nodes *a = nullptr, *b = nullptr;  // the smallest and the second smallest phi
  for (Nodes& n : nodes) {
    if (!a || n.phi[k] < a->phi[k]) {
      b = a;
      a = &n;
    } else if (!b || n.phi[k] < b->phi[k]) {
      b = &n;
    }
  }
  if (!b || b->phi[k] >= 2 * dx || a->phi[k] < -2.5 * dx) return;
  if (a->rigid && b->rigid) return;
  const double pa = a->phi[k], pb = b->phi[k], gap = pa + pb, push = off_node * dx;
  const auto touched = [k](const Nodes& n, const Nodes& other) {
    return n.contact && (n.contact[k] >> other.body & 1U);
  };
  if (gap >= shared_gap * dx && !(gap < shared_contact_gap * dx && (touched(*a, *b) || touched(*b, *a))))
    return;
  // A wall exactly on a face: the deformable body is just outside, or of two the one whose name comes first;
  // the other is just inside. The order of the bodies does not matter.
  const auto beside_rigid = [&](Nodes& n, Nodes& wall) {
    n.phi[k] = std::abs(wall.phi[k]) <= push ? push : -wall.phi[k];
    if (std::abs(wall.phi[k]) <= push) wall.phi[k] = -push;
  };
  if (b->rigid) return beside_rigid(*a, *b);
  if (a->rigid) return beside_rigid(*b, *a);
  double psi = 0.5 * (pa - pb);
  if (std::abs(psi) < push) psi = a->name < b->name ? push : -push;
  a->phi[k] = psi;
  b->phi[k] = -psi;
}

#define RECOIL_INSTANTIATE(Dim) \
  template Nodes node_values<Dim>(const State<Dim>&, const Window<Dim>&, int, PhiAt, double, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
