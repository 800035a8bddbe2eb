#include "cutcell/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "../core/dimensions.hpp"
#include "bodies.hpp"

namespace recoil::geometry_test {
namespace {

constexpr double pi = 3.14159265358979323846;

template <class D>
struct Geometries : testing::Test {
  static constexpr int dim = D::value;
  Grid<dim> grid = make_test_grid<dim>(20, 10, Edge::outflow);
  Vec<dim> middle = middle_of(grid) + off();
  static Vec<dim> off() {
    Vec<dim> x;
    for (int d = 0; d < dim; ++d) x[d] = 0.03 * (d + 1);
    return x;
  }
  static Vec<dim> tilted() {
    Vec<dim> n;
    for (int d = 0; d < dim; ++d) n[d] = 1 - 0.45 * d;
    return unit(n);
  }
};
TYPED_TEST_SUITE(Geometries, Dimensions);

/// The cut cell of a body at a global index, or null.
template <int Dim>
const CutCell<Dim>* cut_at(const State<Dim>& state, int body, const Index<Dim>& i) {
  Index<Dim> at;
  for (int d = 0; d < Dim; ++d) at[d] = i[d] / state.grid().block[d];
  const int slot = state.mesh.find(Place<Dim>{0, at});
  const auto& g = state.bodies[body].at(slot).geometry;
  const int k = g.index[state.grid().layout().at(i - state.mesh.block(slot).cells.lo)];
  return k < 0 ? nullptr : &g.cuts[k];
}

TYPED_TEST(Geometries, ABallHasItsVolumeAndSurface) {
  constexpr int dim = TestFixture::dim;
  const double radius = 7 * this->grid.dx;
  auto state = make_test_state<dim>(this->grid, {ball(this->middle, radius)});
  cut_all(state);
  double volume = 0, area = 0;
  Vec<dim> closed;
  for_each_piece(state, 0, [&](BodyBlock<dim>& b, const Index<dim>& i, std::size_t k) {
    volume += volume_by_phi(this->grid, b, i, k);
    if (b.end_geometry.kind[k] != CellKind::cut) return;
    const auto& cut = b.end_geometry.cuts[b.end_geometry.index[k]];
    area += norm(cut.surface);
    closed += cut.surface;
    EXPECT_LT(std::abs(norm(cut.point - this->middle) - radius), 0.1 * this->grid.dx);
    if (norm(cut.surface) < 0.1 * this->grid.dx_power(dim - 1)) return;
    EXPECT_GT(dot(unit(cut.surface), unit(cut.point - this->middle)), 0.98);
  });
  const double v = dim == 1 ? 2 * radius : dim == 2 ? pi * radius * radius : 4 * pi / 3 * std::pow(radius, 3);
  const double a = dim == 1 ? 2 : dim == 2 ? 2 * pi * radius : 4 * pi * radius * radius;
  EXPECT_NEAR(volume / v, 1, 0.015 * dim);  // the means at nodes and the chords lose some
  EXPECT_NEAR(area / a, 1, 0.02);
  EXPECT_LT(norm(closed), 1e-12 * a);
}

TYPED_TEST(Geometries, UnderAPlaneVolumesAndNormalsAreExact) {
  constexpr int dim = TestFixture::dim;
  const auto n = TestFixture::tilted();
  auto state = make_test_state<dim>(this->grid, {half_space(this->middle, n)});
  cut_all(state);
  int cuts = 0;
  for_each_piece(state, 0, [&](BodyBlock<dim>& b, const Index<dim>& i, std::size_t k) {
    for (int d = 0; d < dim; ++d)
      if (i[d] == 0 || i[d] == this->grid.cells[d] - 1) return;  // phi is constant beyond open edges
    if (b.geometry.kind[k] != CellKind::cut) return;
    const auto& cut = b.geometry.cuts[b.geometry.index[k]];
    ++cuts;
    EXPECT_LT(norm(cut.surface - dot(cut.surface, n) * n), 1e-12);
    EXPECT_NEAR(dot(cut.point - this->middle, n), 0, 1e-12);
    EXPECT_LT(dot(this->grid.centre(i) + this->grid.dx * cut.centroid - this->middle, n), 0);
  });
  EXPECT_GT(cuts, dim == 1 ? 0 : 8);
}

/// Cells on both sides of a face give it one open area, across the borders of blocks too.
TYPED_TEST(Geometries, NeighboursShareTheOpenAreasOfTheirFaces) {
  constexpr int dim = TestFixture::dim;
  auto state = make_test_state<dim>(this->grid, {ball(this->middle, 6.3 * this->grid.dx)});
  cut_all(state);
  const Box<dim> domain = this->grid.domain();
  const auto n = static_cast<std::size_t>(domain.size());
  for (int d = 0; d < dim; ++d) {
    std::vector<double> low(n), high(n);
    for_each_piece(state, 0, [&](BodyBlock<dim>& b, const Index<dim>& i, std::size_t k) {
      const auto at = static_cast<std::size_t>(domain.at(i));
      low[at] = open_area(this->grid, b.geometry, static_cast<int>(k), i, d, 0);
      high[at] = open_area(this->grid, b.geometry, static_cast<int>(k), i, d, 1);
    });
    int partly = 0;
    for_each(domain, [&](Index<dim> i) {
      const auto at = static_cast<std::size_t>(domain.at(i));
      if (++i[d] == domain.hi[d]) return;
      const double there = low[domain.at(i)];
      ASSERT_EQ(high[at], there);
      partly += there > 0 && there < this->grid.full_area(i, d);
    });
    EXPECT_GT(partly, dim == 1 ? -1 : 10);
    for (int s = 0; s < state.mesh.local(); ++s) {
      Box<dim> faces = state.mesh.block(s).cells;
      ++faces.hi[d];
      std::vector<double> area(static_cast<std::size_t>(faces.size()), -1);
      open_areas(this->grid, Window<dim>(state.mesh, s, 1), state.bodies[0].at(s).geometry, d, area.data());
      for_each(state.mesh.block(s).cells, [&](Index<dim> i) {
        ASSERT_EQ(area[faces.at(i)], low[domain.at(i)]);
        const double h = high[domain.at(i)];
        ++i[d];
        ASSERT_EQ(area[faces.at(i)], h);
      });
    }
  }
}

TYPED_TEST(Geometries, AWallOnAFaceCutsNothing) {
  constexpr int dim = TestFixture::dim;
  Vec<dim> point = this->grid.origin, normal;
  point[0] += 8 * this->grid.dx;
  normal[0] = 1;
  auto state = make_test_state<dim>(this->grid, {half_space(point, normal)});
  cut_all(state);
  for_each_piece(state, 0, [&](BodyBlock<dim>& b, const Index<dim>& i, std::size_t k) {
    const double part = volume_by_phi(this->grid, b, i, k) / this->grid.full_volume(i);
    EXPECT_NEAR(part, i[0] < 8 ? 1 : 0, 2e-6);
  });
}

template <int Dim>
struct Pair {
  State<Dim> state;
  int both = 0, opposite = 0;

  /// Two bodies that face each other across a plane with a gap [dx] between them.
  Pair(const Grid<Dim>& grid, const Vec<Dim>& point, const Vec<Dim>& normal, double gap)
      : state(make_test_state<Dim>(grid, {half_space(point - 0.5 * gap * grid.dx * normal, normal),
                                          half_space(point + 0.5 * gap * grid.dx * normal, -normal)})) {}

  /// Counts the cells that both cut, and those of them that they cut with the same surface, to round-off.
  void count() {
    both = opposite = 0;
    for_each(state.grid().domain(), [&](const Index<Dim>& i) {
      const auto *a = cut_at(state, 0, i), *b = cut_at(state, 1, i);
      if (!a || !b) return;
      ++both;
      const double face = state.grid().dx_power(Dim - 1);
      opposite += norm(a->surface + b->surface) < 1e-13 * face && norm(a->point - b->point) < 1e-13;
    });
  }
};

TYPED_TEST(Geometries, OneSurfaceCutsTwoBodiesThatTouch) {
  constexpr int dim = TestFixture::dim;
  for (const double gap : {-0.2, 0.0, 0.14}) {
    Pair<dim> pair(this->grid, this->middle, TestFixture::tilted(), gap);
    cut_all(pair.state, Surfaces::shared);
    pair.count();
    EXPECT_GT(pair.both, dim == 1 ? 0 : 8) << gap;
    EXPECT_EQ(pair.opposite, pair.both) << gap;
    // What is not of one body is of the other.
    const Box<dim> inner = this->grid.domain().grown(-1);
    for_each(inner, [&](const Index<dim>& i) {
      const auto *a = cut_at(pair.state, 0, i), *b = cut_at(pair.state, 1, i);
      ASSERT_EQ(a == nullptr, b == nullptr);
      if (!a) return;
      ASSERT_NEAR(a->volume + b->volume, this->grid.full_volume(i), 1e-12);
    });
  }
}

TYPED_TEST(Geometries, BodiesApartKeepTheirOwnSurfacesUnlessTheyTouched) {
  constexpr int dim = TestFixture::dim;
  Pair<dim> pair(this->grid, this->middle, TestFixture::tilted(), 0.3);
  cut_all(pair.state, Surfaces::shared);
  pair.count();
  EXPECT_EQ(pair.opposite, 0);
  for (auto& b : pair.state.bodies[1].blocks)
    std::fill(b.contact.begin(), b.contact.end(), 1U);  // touched body 0
  cut_all(pair.state, Surfaces::shared);
  pair.count();
  EXPECT_GT(pair.both, 0);
  EXPECT_EQ(pair.opposite, pair.both);
  cut_all(pair.state, Surfaces::own);
  pair.count();
  EXPECT_EQ(pair.opposite, 0);
}

TYPED_TEST(Geometries, ARigidBodyKeepsItsSurfaceAndCutsTheOther) {
  constexpr int dim = TestFixture::dim;
  const Vec<dim> n = TestFixture::tilted();
  Pair<dim> pair(this->grid, this->middle, n, 0.1);
  pair.state.bodies[1].rigid.emplace().distance = half_space(this->middle + 0.05 * this->grid.dx * n, -n);
  cut_all(pair.state, Surfaces::own);
  std::vector<Vec<dim>> own;
  for_each(this->grid.domain(), [&](const Index<dim>& i) {
    const auto* cut = cut_at(pair.state, 1, i);
    own.push_back(cut ? cut->surface : Vec<dim>{});
  });
  cut_all(pair.state, Surfaces::shared);
  pair.count();
  EXPECT_GT(pair.both, 0);
  EXPECT_EQ(pair.opposite, pair.both);
  std::size_t k = 0;
  for_each(this->grid.domain(), [&](const Index<dim>& i) {
    const auto* cut = cut_at(pair.state, 1, i);
    EXPECT_EQ(cut ? cut->surface : Vec<dim>{}, own[k++]);
  });
}

/// Means of phi round a corner away; the distance itself does not.
TYPED_TEST(Geometries, NodesOfRigidBodiesAreExact) {
  constexpr int dim = TestFixture::dim;
  if constexpr (dim == 2) {
    const double dx = this->grid.dx;
    Vec<2> tip = this->middle;
    for (int d = 0; d < 2; ++d)
      tip[d] = this->grid.origin[d] + (std::floor((tip[d] - this->grid.origin[d]) / dx) + 0.1) * dx;
    const Distance<2> quarter = [=](const Vec<2>& x) { return std::max(tip[0] - x[0], tip[1] - x[1]); };
    auto state = make_test_state<2>(this->grid, {quarter});
    state.bodies[0].rigid.emplace().distance = quarter;
    cut_all(state);
    const auto* cut = cut_at(state, 0, this->grid.cell_of(tip));
    ASSERT_NE(cut, nullptr);
    // Three corners of the cell are outside by 0.1 dx, the fourth is inside by 0.9 dx.
    EXPECT_NEAR(cut->open[0][1], 0.9 * dx, 1e-12);
    EXPECT_NEAR(cut->open[1][1], 0.9 * dx, 1e-12);
  }
}

TYPED_TEST(Geometries, NormalsOfRigidBodies) {
  constexpr int dim = TestFixture::dim;
  const double dx = this->grid.dx, thickness = 0.8 * dx;
  const Vec<dim> n = TestFixture::tilted();
  RigidMotion<dim> slab;
  slab.distance = [=, this](const Vec<dim>& x) {
    return std::abs(dot(x - this->middle, n)) - 0.5 * thickness;
  };
  const auto pose = pose_after(slab, 0);
  for (const double side : {-1.0, 1.0})
    EXPECT_LT(
        norm(rigid_normal(this->grid, slab, pose, this->middle + 0.5 * side * thickness * n) - side * n),
        1e-12);
  // A hundredth of a cell beside the ridge of a wedge the other flank does not show.
  RigidMotion<dim> wedge;
  const double c = std::cos(0.13), z = std::sin(0.13);
  wedge.distance = [=, this](const Vec<dim>& x) {
    const Vec<dim> r = x - this->middle;
    return dim == 1 ? r[0] : c * std::abs(r[0]) + z * r[dim - 1];
  };
  Vec<dim> flank = this->middle, out;
  out[0] = c;
  if (dim > 1) {
    flank[0] += 0.015 * dx;
    flank[dim - 1] -= 0.015 * dx * c / z;
    out[dim - 1] = z;
  } else {
    out[0] = 1;
  }
  EXPECT_LT(norm(rigid_normal(this->grid, wedge, pose_after(wedge, 0), flank) - out), 1e-9);
  // At a plane of symmetry a ball's normal lies in the plane.
  auto mirrored = this->grid;
  mirrored.edge[0] = {Edge::reflect, Edge::reflect};
  Vec<dim> centre = this->middle;
  centre[0] = mirrored.origin[0];
  RigidMotion<dim> round;
  round.distance = ball(centre, 3 * dx);
  Vec<dim> pole = centre;
  pole[dim - 1] += 3 * dx;
  EXPECT_NEAR(rigid_normal(mirrored, round, pose_after(round, 0), pole)[dim - 1], 1, 1e-12);
}

/// Fragments of a cone r < a + b z: exact by Pappus's rule, whatever the tilt of its mantle.
TEST(AxisymmetricGeometry, AConeHasItsVolumeAndItsSurfacesClose) {
  const auto grid = make_axisymmetric_grid(24, 24, 12);
  const double slope = 0.37, at_origin = 1.6;
  const Distance<2> cone = [&](const Vec<2>& x) {
    return (x[0] - at_origin - slope * x[1]) / std::sqrt(1 + slope * slope);
  };
  auto state = make_test_state<2>(grid, {cone});
  cut_all(state);
  double volume = 0, mantle = 0;
  for_each_piece(state, 0, [&](BodyBlock<2>& b, const Index<2>& i, std::size_t k) {
    if (i[1] == 0 || i[1] == 23) return;  // phi is constant beyond open edges
    volume += volume_by_phi(grid, b, i, k);
    if (b.end_geometry.kind[k] != CellKind::cut) return;
    const auto& cut = b.end_geometry.cuts[b.end_geometry.index[k]];
    mantle += norm(cut.surface);
    EXPECT_NEAR(cut.surface[1], -slope * cut.surface[0], 1e-13);
    EXPECT_NEAR(cut.open[0][1] - cut.open[0][0] + cut.surface[0], cut.hoop_area, 1e-15);
    EXPECT_NEAR(cut.open[1][1] - cut.open[1][0] + cut.surface[1], 0, 1e-15);
  });
  const double z0 = grid.origin[1] + grid.dx, z1 = grid.origin[1] + 23 * grid.dx;
  const auto cubed = [&](double z) { return std::pow(at_origin + slope * z, 3); };
  const auto squared = [&](double z) { return std::pow(at_origin + slope * z, 2); };
  EXPECT_NEAR(volume, (cubed(z1) - cubed(z0)) / (6 * slope), 1e-12);
  EXPECT_NEAR(mantle, std::sqrt(1 + slope * slope) * (squared(z1) - squared(z0)) / (2 * slope), 1e-12);
}

TEST(AxisymmetricGeometry, ABallOnTheAxis) {
  const auto grid = make_axisymmetric_grid(24, 24, 12);
  const Vec<2> centre{{0, grid.origin[1] + 12.3 * grid.dx}};
  const double radius = 9 * grid.dx;
  auto state = make_test_state<2>(grid, {ball(centre, radius)});
  cut_all(state);
  double volume = 0, area = 0, along = 0;
  for_each_piece(state, 0, [&](BodyBlock<2>& b, const Index<2>& i, std::size_t k) {
    volume += volume_by_phi(grid, b, i, k);
    if (b.end_geometry.kind[k] != CellKind::cut) return;
    const auto& cut = b.end_geometry.cuts[b.end_geometry.index[k]];
    area += norm(cut.surface);
    along += cut.surface[1];
  });
  EXPECT_NEAR(volume / (2.0 / 3 * std::pow(radius, 3)), 1, 0.01);
  EXPECT_NEAR(area / (2 * radius * radius), 1, 0.01);
  EXPECT_NEAR(along, 0, 1e-13);
}

TYPED_TEST(Geometries, NormalsAndInterpolationAreExactForLinearFunctions) {
  constexpr int dim = TestFixture::dim;
  Random random(8);
  const auto n = unit(random.vector<dim>(-1, 1));
  const auto mesh = make_test_mesh(this->grid);
  const Window<dim> w(mesh, 0, 2);
  std::vector<double> phi(static_cast<std::size_t>(w.size()));
  for_each(w.box(), [&](const Index<dim>& i) { phi[w.at(i)] = 0.3 + dot(n, this->grid.centre(i)); });
  for_each(w.inner(), [&](const Index<dim>& i) {
    EXPECT_LT(norm(phi_normal(w.box(), phi.data(), i, this->grid.dx) - n), 1e-12);
    const auto x = this->grid.centre(i) + this->grid.dx * random.vector<dim>(-1, 1);
    EXPECT_NEAR(interpolate(this->grid, w.box(), phi.data(), x), 0.3 + dot(n, x), 1e-12);
  });
}

/// Of a level set that is no number a foot point is none either: it is looked up within the window.
TYPED_TEST(Geometries, InterpolationAtNoPlaceStaysInTheWindow) {
  constexpr int dim = TestFixture::dim;
  const auto mesh = make_test_mesh(this->grid);
  const Window<dim> w(mesh, 0, 2);
  const std::vector<double> phi(static_cast<std::size_t>(w.size()), 0.25);
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), 1e300, -1e300}) {
    Vec<dim> at = this->grid.centre(w.inner().lo);
    at[dim - 1] = x;
    EXPECT_EQ(interpolate(this->grid, w.box(), phi.data(), at), 0.25) << x;
  }
}

/// On a ridge the central differences cancel: the steeper side counts.
TEST(PhiNormal, ARidgeStillHasANormal) {
  const Box<1> window{{{0}}, {{3}}};
  const double phi[3] = {-1.2, -0.2, -1.2};
  EXPECT_EQ(std::abs(phi_normal<1>(window, phi, {{1}}, 1.0)[0]), 1);
}

}  // namespace
}  // namespace recoil::geometry_test
