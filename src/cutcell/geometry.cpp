#include "cutcell/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "core/multiversion.hpp"
#include "cutcell/clip.hpp"
#include "cutcell/nodes.hpp"

namespace recoil {

namespace {

constexpr double normal_step = 0.01;  // [dx] either way: a sharp edge is narrow

template <int Dim>
CutCell<Dim> cut_cell(const Grid<Dim>& grid, const Index<Dim>& i, int cell, const Corners<Dim>& corner,
                      const FaceClips<Dim>& faces) {
  CutCell<Dim> c;
  c.cell = cell;
  const double area = grid.dx_power(Dim - 1), volume = grid.dx_power(Dim);
  const auto radius = [&](const Vec<Dim>& x) { return grid.origin[0] + (i[0] + x[0]) * grid.dx; };
  for (int d = 0; d < Dim; ++d)
    for (int side = 0; side < 2; ++side) {
      const Clip<Dim>& face = faces[d][side];
      c.open[d][side] =
          face.fraction * area * (face.fraction > 0 ? grid.weight_at(radius(face.centroid)) : 1);
      if (face.fraction > 0 && face.fraction < 1)
        for (int e = 0; e < Dim; ++e)
          if (e != d) c.open_middle[d][side][e] = face.centroid[e] - 0.5;
    }
  const Clip<Dim> fragment = clip<Dim>(corner, faces);
  const double middle = radius(fragment.centroid);
  c.volume = fragment.fraction * volume * grid.weight_at(middle);
  for (int d = 0; d < Dim; ++d) {
    c.centroid[d] = fragment.centroid[d] - 0.5;
    c.point[d] = grid.origin[d] + (i[d] + fragment.middle[d]) * grid.dx;
    c.surface[d] = -(c.open[d][1] - c.open[d][0]);
  }
  if (grid.radial_power == 1) c.hoop_area = fragment.fraction * volume;
  if (grid.radial_power == 2) {
    const double length = fragment.fraction * grid.dx;
    c.volume += length * length * length / 12;
    c.hoop_area = 2 * middle * length;
  }
  c.surface[0] += c.hoop_area;
  return c;
}

/// Least and largest value of some rows of nodes.
struct Bounds {
  double least = std::numeric_limits<double>::infinity(), largest = -least;
};

RECOIL_MULTIVERSION void extend_bounds(const double* node, int count, Bounds& bounds) {
  double least = bounds.least, largest = bounds.largest;
#pragma omp simd reduction(min : least) reduction(max : largest)
  for (int c = 0; c < count; ++c) {
    least = node[c] < least ? node[c] : least;
    largest = node[c] > largest ? node[c] : largest;
  }
  bounds = {least, largest};
}

/// What the nodes of a row of cells say of each. Cells are empty before. @returns whether any is cut.
template <int Dim>
bool find_kinds(const double* node, const Offsets<Dim>& corner, int count, CellKind* kind) {
  Bounds bounds;
  for (std::size_t o = 0; o < corner.size(); o += 2) extend_bounds(node + corner[o], count + 1, bounds);
  if (bounds.least >= 0) return false;
  if (bounds.largest < 0) {
    std::fill_n(kind, count, CellKind::full);
    return false;
  }
  bool any = false;
  for (int c = 0; c < count; ++c) {
    int negative = 0;
    for (const int o : corner) negative += node[c + o] < 0 ? 1 : 0;
    kind[c] = negative == 0 ? CellKind::empty : negative == 1 << Dim ? CellKind::full : CellKind::cut;
    any = any || kind[c] == CellKind::cut;
  }
  return any;
}

/// Clips the faces of the cell that is to be the next cut one. A face that it shares with a cut cell before
/// it has been clipped with that.
template <int Dim>
void clip_beside(const Box<Dim>& layout, const Box<Dim>& cells, const Index<Dim>& i, int cell,
                 const Corners<Dim>& corner, const Geometry<Dim>& g, FaceClips<Dim>* faces) {
  FaceClips<Dim>& own = faces[g.cuts.size()];
  for (int d = 0; d < Dim; ++d) {
    const int below = i[d] > cells.lo[d] ? g.index[cell - layout.stride(d)] : -1;
    own[d][1] = clip_face<Dim>(corner, d, 1);
    own[d][0] = below < 0 ? clip_face<Dim>(corner, d, 0) : faces[below][d][1];
    own[d][0].centroid[d] = 0;
  }
}

template <int Dim>
void classify(const Grid<Dim>& grid, const Window<Dim>& w, const double* node, Geometry<Dim>& g,
              Scratch& scratch) {
  const Scratch::Frame frame(scratch);
  auto* faces = scratch.take<FaceClips<Dim>>(static_cast<std::size_t>(w.inner().size()));  // of the cut cells
  const Box<Dim> cells = w.inner(), nodes = node_box(cells);
  Offsets<Dim> offset{};
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
    if (!find_kinds<Dim>(p, offset, width, kind)) return;
    for (int c = 0; c < width; ++c, ++i[0]) {
      if (kind[c] != CellKind::cut) continue;
      Corners<Dim> corner{};
      for (std::size_t o = 0; o < corner.size(); ++o) corner[o] = p[c + offset[o]];
      g.index[first + c] = static_cast<int>(g.cuts.size());
      clip_beside<Dim>(grid.layout(), cells, i, first + c, corner, g, faces);
      g.cuts.push_back(cut_cell<Dim>(grid, i, first + c, corner, faces[g.cuts.size()]));
    }
  });
}

/// Cells that are the body's by geometry or by volume.
template <int Dim>
Box<Dim> matter_box(const Window<Dim>& w, const BodyBlock<Dim>& b) {
  Box<Dim> box{}, rows = w.inner();
  const int width = rows.extent(0);
  rows.hi[0] = rows.lo[0] + 1;
  for_each(rows, [&](Index<Dim> i) {
    const CellKind* kind = b.geometry.kind.data() + w.cell(i);
    const double* volume = b.volume.data() + w.cell(i);
    const auto holds = [&](int c) { return kind[c] != CellKind::empty || volume[c] != 0; };
    int first = 0, last = width - 1;
    while (first < width && !holds(first)) ++first;
    if (first == width) return;
    while (!holds(last)) --last;
    const int low = i[0];
    for (const int c : {first, last}) {
      i[0] = low + c;
      extend(box, i);
    }
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
    classify(state.grid(), w, m.phi, when == PhiAt::midstep ? b.geometry : b.end_geometry, scratch);
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
    // A place that is not a number counts as the window's first one: of a state that is none, a run tells
    // later.
    const double at = (x[d] - grid.origin[d]) / grid.dx - 0.5, first = window.lo[d],
                 a = at > first ? std::min(at, window.hi[d] - 1.001) : first;
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
