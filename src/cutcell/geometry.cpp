#include "cutcell/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "cutcell/clip.hpp"
#include "state/level_set_view.hpp"

namespace recoil {

namespace {

constexpr double shared_gap = 0.15;         // closer than this [dx], one surface cuts both
constexpr double shared_contact_gap = 0.5;  // or than this beside cells in contact
constexpr double off_node = 1e-6;           // a surface is kept this far [dx] from nodes
constexpr double exact_band = 3;            // nodes of rigid bodies nearer than this [dx] are exact
constexpr double normal_step = 0.01;        // [dx] either way: a sharp edge is narrow

/// phi at the nodes of one block for one body. Node i is the low corner of cell i.
struct Nodes {
  int body = 0;
  bool rigid = false;
  double* phi = nullptr;
  std::uint32_t* contact = nullptr;  // bits of the partners of the cells around; null for rigid bodies
};

template <int Dim>
Box<Dim> node_box(const Box<Dim>& cells) {
  Box<Dim> b = cells;
  for (int d = 0; d < Dim; ++d) ++b.hi[d];
  return b;
}

/// Offsets into the window of the 2^Dim cells around a node.
template <int Dim>
std::array<int, 1 << Dim> around_node(const Window<Dim>& w) {
  std::array<int, 1 << Dim> offset{};
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

/// phi and the bits of contact of one body in the cells of a window; no contact of rigid bodies.
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
  return cells;
}

/// @param ahead seconds from now to `when`.
template <int Dim>
Nodes node_values(const State<Dim>& state, const Window<Dim>& w, int body, PhiAt when, double ahead,
                  Scratch& scratch) {
  const Body<Dim>& b = state.bodies[body];
  const auto pose = b.rigid ? std::optional(pose_after(*b.rigid, ahead)) : std::nullopt;
  const Box<Dim> nodes = node_box(w.inner());
  Nodes n{body, b.rigid.has_value(), scratch.take<double>(nodes.size()), nullptr};
  const CellValues cells = cell_values(state, w, b, when, scratch);
  if (cells.contact) n.contact = scratch.take<std::uint32_t>(nodes.size());
  const double share = 1.0 / (1 << Dim), push = off_node * state.grid().dx,
               band = exact_band * state.grid().dx;
  const auto around = around_node(w);
  Box<Dim> rows = nodes;
  rows.hi[0] = rows.lo[0] + 1;
  const int width = nodes.extent(0);
  for_each(rows, [&](Index<Dim> i) {
    const double* p = cells.phi + w.at(i);
    double* value = n.phi + nodes.at(i);
#pragma omp simd
    for (int c = 0; c < width; ++c) {
      double sum = 0;
      for (const int o : around) sum += p[c + o];
      value[c] = share * sum;
    }
    if (cells.contact) {
      const std::uint32_t* from = cells.contact + w.at(i);
      std::uint32_t* bits = n.contact + nodes.at(i);
      for (int c = 0; c < width; ++c) {
        bits[c] = 0;
        for (const int o : around) bits[c] |= from[c + o];
      }
    }
    for (int c = 0; pose && c < width; ++c, ++i[0])
      if (std::abs(value[c]) < band && !at_outflow(state.grid(), i))
        value[c] = rigid_node(state.grid(), *b.rigid, *pose, i);
    for (int c = 0; c < width; ++c)
      value[c] = std::abs(value[c]) < push ? (value[c] < 0 ? -push : push) : value[c];
  });
  return n;
}

/// One surface for the two nearest bodies of a node, where they touch.
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
  if (a->body > b->body) std::swap(a, b);
  if (a->rigid && b->rigid) return;
  const double pa = a->phi[k], pb = b->phi[k], gap = pa + pb, push = off_node * dx;
  const auto touched = [k](const Nodes& n, const Nodes& other) {
    return n.contact && (n.contact[k] >> other.body & 1U);
  };
  if (gap >= shared_gap * dx && !(gap < shared_contact_gap * dx && (touched(*a, *b) || touched(*b, *a))))
    return;
  // A wall exactly on a face: the deformable or lower-numbered body is just outside, the other just inside.
  const auto beside_rigid = [&](Nodes& n, Nodes& wall) {
    n.phi[k] = std::abs(wall.phi[k]) <= push ? push : -wall.phi[k];
    if (std::abs(wall.phi[k]) <= push) wall.phi[k] = -push;
  };
  if (b->rigid) return beside_rigid(*a, *b);
  if (a->rigid) return beside_rigid(*b, *a);
  double psi = 0.5 * (pa - pb);
  if (std::abs(psi) < push) psi = push;
  a->phi[k] = psi;
  b->phi[k] = -psi;
}

template <int Dim>
CutCell<Dim> cut_cell(const Grid<Dim>& grid, const Index<Dim>& i, int cell, const Corners<Dim>& corner) {
  CutCell<Dim> c;
  c.cell = cell;
  const double area = grid.dx_power(Dim - 1), volume = grid.dx_power(Dim);
  const auto radius = [&](const Vec<Dim>& x) {
    return grid.axisymmetric ? std::abs(grid.origin[0] + (i[0] + x[0]) * grid.dx) : 1.0;
  };
  const FaceClips<Dim> faces = clip_faces<Dim>(corner);
  for (int d = 0; d < Dim; ++d)
    for (int side = 0; side < 2; ++side) {
      const Clip<Dim>& face = faces[d][side];
      c.open[d][side] = face.fraction * area * (face.fraction > 0 ? radius(face.centroid) : 1);
    }
  const Clip<Dim> fragment = clip<Dim>(corner, faces);
  c.volume = fragment.fraction * volume * radius(fragment.centroid);
  for (int d = 0; d < Dim; ++d) {
    c.centroid[d] = fragment.centroid[d] - 0.5;
    c.point[d] = grid.origin[d] + (i[d] + fragment.middle[d]) * grid.dx;
    c.surface[d] = -(c.open[d][1] - c.open[d][0]);
  }
  if (grid.axisymmetric) {
    c.plane_area = fragment.fraction * volume;
    c.surface[0] += c.plane_area;
  }
  return c;
}

template <int Dim>
void classify(const Grid<Dim>& grid, const Window<Dim>& w, const double* node, Geometry<Dim>& g) {
  const Box<Dim> cells = w.inner(), nodes = node_box(cells);
  std::array<int, 1 << Dim> offset{};
  for (int c = 0; c < 1 << Dim; ++c)
    for (int d = 0; d < Dim; ++d) offset[c] += (c >> d & 1) * nodes.stride(d);
  g.cuts.clear();
  std::fill(g.kind.begin(), g.kind.end(), CellKind::empty);
  std::fill(g.index.begin(), g.index.end(), -1);
  Box<Dim> rows = cells;
  rows.hi[0] = rows.lo[0] + 1;
  const int width = cells.extent(0);
  for_each(rows, [&](Index<Dim> i) {
    const double* p = node + nodes.at(i);
    const int first = w.cell(i);
    CellKind* kind = g.kind.data() + first;
#pragma omp simd
    for (int c = 0; c < width; ++c) {
      int negative = 0;
      for (const int o : offset) negative += p[c + o] < 0 ? 1 : 0;
      kind[c] = negative == 0 ? CellKind::empty : negative == 1 << Dim ? CellKind::full : CellKind::cut;
    }
    for (int c = 0; c < width; ++c, ++i[0]) {
      if (kind[c] != CellKind::cut) continue;
      Corners<Dim> corner{};
      for (std::size_t o = 0; o < corner.size(); ++o) corner[o] = p[c + offset[o]];
      g.index[first + c] = static_cast<int>(g.cuts.size());
      g.cuts.push_back(cut_cell(grid, i, first + c, corner));
    }
  });
}

/// Cells that are the body's by geometry or by volume.
template <int Dim>
Box<Dim> matter_box(const Window<Dim>& w, const BodyBlock<Dim>& b) {
  Box<Dim> box{};
  for_each(w.inner(), [&](const Index<Dim>& i) {
    const int k = w.cell(i);
    if (b.geometry.kind[k] != CellKind::empty || b.volume[k] != 0) extend(box, i);
  });
  return box;
}

}  // namespace

template <int Dim>
void find_geometry(State<Dim>& state, int slot, Surfaces surfaces, PhiAt when, Scratch& scratch,
                   double ahead) {
  Box<Dim> reach{};
  for (const Body<Dim>& body : state.bodies) {
    const BodyBlock<Dim>& b = body.at(slot);
    if (!b.present || !b.near_surface || b.reach.size() == 0) continue;
    extend(reach, b.reach.lo);
    Index<Dim> last = b.reach.hi;
    for (int d = 0; d < Dim; ++d) --last[d];
    extend(reach, last);
  }
  if (reach.size() == 0) return;
  const Window<Dim> w(state.mesh, slot, 1, reach);
  auto* first = scratch.take<Nodes>(state.count());
  std::size_t count = 0;
  for (int m = 0; m < state.count(); ++m) {
    const BodyBlock<Dim>& b = state.bodies[m].at(slot);
    if (b.present && b.near_surface) first[count++] = node_values(state, w, m, when, ahead, scratch);
  }
  const std::span<Nodes> nodes(first, count);
  const int n = node_box(w.inner()).size();
  if (surfaces == Surfaces::shared && nodes.size() > 1)
    for (int k = 0; k < n; ++k) share_node(nodes, k, state.grid().dx);
  for (const Nodes& m : nodes) {
    BodyBlock<Dim>& b = state.bodies[m.body].at(slot);
    classify(state.grid(), w, m.phi, when == PhiAt::midstep ? b.geometry : b.end_geometry);
    if (when == PhiAt::midstep && !m.rigid) b.matter = matter_box(w, b);
  }
}

template <int Dim>
double open_area(const Grid<Dim>& grid, const Geometry<Dim>& g, int cell, const Index<Dim>& i, int d,
                 int side) {
  if (g.kind[cell] == CellKind::empty) return 0;
  if (g.kind[cell] == CellKind::cut) return g.cuts[g.index[cell]].open[d][side];
  Index<Dim> face = i;
  face[d] += side;
  return grid.full_area(face, d);
}

template <int Dim>
void open_areas(const Grid<Dim>& grid, const Window<Dim>& w, const Geometry<Dim>& g, int d, double* out) {
  const Box<Dim> cells = w.inner();
  Box<Dim> faces = cells;
  ++faces.hi[d];
  const int width = cells.extent(0);
  std::array<double, Window<Dim>::longest + 1> full;  // by the column of a face
  Index<Dim> column;
  for (int c = 0; c <= width; ++c) {
    column[0] = cells.lo[0] + c;
    full[c] = grid.full_area(column, d);
  }
  const auto put_high = [&](const Index<Dim>& i, int cell) {
    if (i[d] == cells.hi[d] - 1) out[faces.at(i) + faces.stride(d)] = open_area(grid, g, cell, i, d, 1);
  };
  Box<Dim> rows = cells;
  rows.hi[0] = std::min(rows.hi[0], rows.lo[0] + 1);
  for_each(rows, [&](Index<Dim> i) {
    const int first = w.cell(i);
    const CellKind* kind = g.kind.data() + first;
    double* to = out + faces.at(i);
    for (int c = 0; c < width; ++c) to[c] = kind[c] == CellKind::empty ? 0.0 : full[c];
    if (d != 0 && i[d] < cells.hi[d] - 1) return;
    for (int c = d == 0 ? width - 1 : 0; c < width; ++c) {
      i[0] = cells.lo[0] + c;
      put_high(i, first + c);
    }
  });
  for (const CutCell<Dim>& cut : g.cuts) {
    const Index<Dim> i = w.index_of(cut.cell);
    if (!cells.contains(i)) continue;
    out[faces.at(i)] = cut.open[d][0];
    put_high(i, cut.cell);
  }
}

template <int Dim>
Vec<Dim> phi_normal(const Box<Dim>& window, const double* phi, const Index<Dim>& i, double dx) {
  const int k = window.at(i);
  Vec<Dim> g;
  for (int d = 0; d < Dim; ++d) g[d] = phi[k + window.stride(d)] - phi[k - window.stride(d)];
  if (norm(g) < dx)
    for (int d = 0; d < Dim; ++d) {
      const double up = phi[k + window.stride(d)] - phi[k], down = phi[k] - phi[k - window.stride(d)];
      g[d] = std::abs(up) > std::abs(down) ? up : down;
    }
  return unit(g);
}

template <int Dim>
Vec<Dim> rigid_normal(const Grid<Dim>& grid, const RigidMotion<Dim>& motion, const RigidPose<Dim>& pose,
                      const Vec<Dim>& x) {
  const double half = normal_step * grid.dx;
  Vec<Dim> g;
  for (int d = 0; d < Dim; ++d) {
    const auto& edge = grid.edge[d];
    const double lo = grid.origin[d], hi = lo + grid.cells[d] * grid.dx;
    Vec<Dim> low = x, high = x;
    low[d] -= half;
    high[d] += half;
    if (low[d] < lo) low[d] = edge[0] == Edge::reflect ? 2 * lo - low[d] : std::min(lo, x[d]);
    if (high[d] > hi) high[d] = edge[1] == Edge::reflect ? 2 * hi - high[d] : std::max(hi, x[d]);
    const double width = low[d] < high[d] && high[d] - low[d] < 2 * half ? high[d] - low[d] : 2 * half;
    g[d] = (distance_at(motion, pose, high) - distance_at(motion, pose, low)) * (2 * half / width);
  }
  return unit(g);
}

template <int Dim>
double interpolate(const Grid<Dim>& grid, const Box<Dim>& window, const double* phi, const Vec<Dim>& x) {
  Index<Dim> i;
  Vec<Dim> t;
  for (int d = 0; d < Dim; ++d) {
    const double a = std::clamp((x[d] - grid.origin[d]) / grid.dx - 0.5, static_cast<double>(window.lo[d]),
                                window.hi[d] - 1.001);
    i[d] = static_cast<int>(std::floor(a));
    t[d] = a - i[d];
  }
  const int k = window.at(i);
  double sum = 0;
  for (int c = 0; c < 1 << Dim; ++c) {
    double weight = 1;
    int o = 0;
    for (int d = 0; d < Dim; ++d) {
      const bool high = (c >> d & 1) != 0;
      weight *= high ? t[d] : 1 - t[d];
      o += high ? window.stride(d) : 0;
    }
    sum += weight * phi[k + o];
  }
  return sum;
}

#define RECOIL_INSTANTIATE(Dim)                                                                             \
  template void find_geometry<Dim>(State<Dim>&, int, Surfaces, PhiAt, Scratch&, double);                    \
  template double open_area<Dim>(const Grid<Dim>&, const Geometry<Dim>&, int, const Index<Dim>&, int, int); \
  template void open_areas<Dim>(const Grid<Dim>&, const Window<Dim>&, const Geometry<Dim>&, int, double*);  \
  template Vec<Dim> phi_normal<Dim>(const Box<Dim>&, const double*, const Index<Dim>&, double);             \
  template Vec<Dim> rigid_normal<Dim>(const Grid<Dim>&, const RigidMotion<Dim>&, const RigidPose<Dim>&,     \
                                      const Vec<Dim>&);                                                     \
  template double interpolate<Dim>(const Grid<Dim>&, const Box<Dim>&, const double*, const Vec<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
