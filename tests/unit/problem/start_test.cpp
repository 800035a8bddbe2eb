#include "problem/start.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "../core/dimensions.hpp"
#include "../material/samples.hpp"
#include "../parallel/session.hpp"
#include "cases.hpp"
#include "core/error.hpp"
#include "problem/overlaps.hpp"

namespace recoil::start_test {
namespace {

using config::Boundary;
using config::Geometry;

constexpr double pi = 3.14159265358979323846;

config::Case planar_case(config::Vector lo, config::Vector hi, double dx) {
  config::Case c;
  c.domain = domain_of(Geometry::planar, lo, hi);
  c.mesh.finest = dx;
  return c;
}

TEST(MakeGrid, OpenAxesAreShiftedByTheOffset) {
  auto c = planar_case(vector_of(-1, 0), vector_of(2, 5), 0.25);
  EXPECT_EQ(make_grid<2>(c).cells, (Index<2>{{12, 20}}));
  c.mesh.offset = 0.37;
  const auto grid = make_grid<2>(c);
  EXPECT_DOUBLE_EQ(grid.origin[0], -1 - 0.37 * 0.25);
  EXPECT_EQ(grid.cells, (Index<2>{{13, 21}}));  // the whole domain is still covered
  EXPECT_EQ(grid.radial_power, 0);
}

TEST(MakeGrid, ClosedEndsStayWhereTheDomainSays) {
  auto c = planar_case(vector_of(-1, 0), vector_of(2.1, 5), 0.25);
  c.mesh.offset = 0.37;
  c.domain.boundary[0] = {Boundary::symmetry, Boundary::outflow};
  auto grid = make_grid<2>(c);
  EXPECT_DOUBLE_EQ(grid.origin[0], -1);
  EXPECT_EQ(grid.cells[0], 13);
  EXPECT_EQ(grid.edge[0][0], Edge::reflect);
  c.domain.boundary[0] = {Boundary::outflow, Boundary::symmetry};
  grid = make_grid<2>(c);
  EXPECT_DOUBLE_EQ(grid.origin[0] + grid.cells[0] * grid.dx, 2.1);
}

TEST(MakeGrid, TheAxisIsAMirror) {
  config::Case c;
  c.domain = domain_of(Geometry::axisymmetric, vector_of(0, -1), vector_of(2, 1));
  c.mesh.finest = 0.1;
  c.mesh.offset = 0.5;
  const auto grid = make_grid<2>(c);
  EXPECT_EQ(grid.radial_power, 1);
  EXPECT_EQ(grid.edge[0][0], Edge::reflect);
  EXPECT_EQ(grid.origin[0], 0);
  EXPECT_EQ(grid.cells[0], 20);
}

TEST(MakeGrid, ClosedAxesNeedWholeCells) {
  auto c = planar_case(vector_of(-1, 0), vector_of(2.1, 5), 0.25);
  for (const Boundary b : {Boundary::symmetry, Boundary::periodic}) {
    c.domain.boundary[0] = {b, b};
    try {
      make_grid<2>(c);
      FAIL();
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("the domain is 12.4 cells long along x"), std::string::npos)
          << e.what();
      EXPECT_NE(std::string(e.what()).find("gives 12 cells"), std::string::npos) << e.what();
    }
  }
}

struct Picture : testing::Test {
  void SetUp() override { start_parallel(); }
  parallel::World world;
};

TEST_F(Picture, ADiscHasItsVolumeMassAndMomentum) {
  auto c = planar_case(vector_of(-4, -4), vector_of(4, 4), 0.2);
  c.mesh.offset = 0.31;
  c.mesh.block = 10;
  c.bodies = {body_of("disc", ball_shape(vector_of(0.3, -0.2), 2), vector_of(30, -20))};
  const auto material = samples::copper();
  const auto state = make_state<2>(c, {material}, world);
  double volume = 0, mass = 0, energy = 0;
  Vec<2> momentum;
  for (int s = 0; s < state.mesh.local(); ++s) {
    const auto& b = state.bodies[0].at(s);
    const std::size_t n = b.volume.size();
    for (std::size_t k = 0; k < n; ++k) {
      volume += b.volume[k];
      mass += b.contents[k];
      momentum += Vec<2>{{b.contents[n + k], b.contents[2 * n + k]}};
      energy += b.contents[3 * n + k];
    }
  }
  EXPECT_NEAR(volume / (4 * pi), 1, 1e-4);
  EXPECT_NEAR(mass / volume, density(material), 1e-9);
  EXPECT_NEAR(momentum[0] / mass, 30, 1e-10);
  EXPECT_NEAR(momentum[1] / mass, -20, 1e-10);
  EXPECT_NEAR(energy / mass, 650, 1e-9);
}

TEST_F(Picture, SpinningBodiesTurnAboutTheirCentre) {
  auto c = planar_case(vector_of(-4, -4), vector_of(4, 4), 0.2);
  c.bodies = {body_of("disc", ball_shape(vector_of(1, 0), 2), vector_of(5, 0))};
  c.bodies[0].spin = vector_of(0, 0, 100);
  c.bodies[0].spin_centre = vector_of(1, 0);
  const auto state = make_state<2>(c, {samples::copper()}, world);
  for (int s = 0; s < state.mesh.local(); ++s) {
    const auto& b = state.bodies[0].at(s);
    if (!b.present) continue;
    for_each(state.mesh.block(s).cells, [&](const Index<2>& i) {
      const auto k = static_cast<std::size_t>(state.grid().layout().at(i - state.mesh.block(s).cells.lo));
      if (b.contents[k] == 0) return;
      const Vec<2> x = state.grid().centre(i);
      ASSERT_NEAR(b.contents[b.volume.size() + k] / b.contents[k], 5 - 100 * x[1], 1e-9);
      ASSERT_NEAR(b.contents[2 * b.volume.size() + k] / b.contents[k], 100 * (x[0] - 1), 1e-9);
    });
  }
}

TEST_F(Picture, SpinInSpace) {
  config::Case c;
  c.domain = domain_of(Geometry::space, vector_of(-1, -1, -1), vector_of(1, 1, 1));
  c.mesh.finest = 0.2;
  c.bodies = {body_of("ball", ball_shape(vector_of(0, 0, 0), 0.9))};
  c.bodies[0].spin = vector_of(3, 5, 7);
  const auto state = make_state<3>(c, {samples::copper()}, world);
  const auto& b = state.bodies[0].at(0);
  for_each(state.mesh.block(0).cells, [&](const Index<3>& i) {
    const auto k = static_cast<std::size_t>(state.grid().layout().at(i));
    if (b.contents[k] == 0) return;
    const Vec<3> x = state.grid().centre(i),
                 exact{{5 * x[2] - 7 * x[1], 7 * x[0] - 3 * x[2], 3 * x[1] - 5 * x[0]}};
    for (std::size_t d = 0; d < 3; ++d)
      ASSERT_NEAR(b.contents[(1 + d) * b.volume.size() + k] / b.contents[k], exact[static_cast<int>(d)],
                  1e-12);
  });
}

/// The speed of a body that flies away from the origin, falling from radius 1 on, at a distance of the centre
/// of a cell. Calls f(distance, speed) for all cells.
template <int Dim, class F>
void for_each_radial_speed(config::Case c, const parallel::World& world, F&& f) {
  c.mesh.finest = 0.25;
  c.bodies = {body_of("ball", ball_shape(vector_of(0, 0, 0), 2.5))};
  c.bodies[0].radial_velocity = -300;
  c.bodies[0].radial_falls_from = 1;
  c.bodies[0].radial_from_axis =
      c.domain.geometry == Geometry::axisymmetric && Dim == 2 && c.domain.lo[1] < -2;
  const auto state = make_state<Dim>(c, {samples::copper()}, world);
  for (int s = 0; s < state.mesh.local(); ++s) {
    const auto& b = state.bodies[0].at(s);
    if (!b.present) continue;
    for_each(state.mesh.block(s).cells, [&](const Index<Dim>& i) {
      const auto k = static_cast<std::size_t>(state.grid().layout().at(i - state.mesh.block(s).cells.lo));
      if (b.contents[k] == 0) return;
      Vec<Dim> u, x = state.grid().centre(i);
      for (int d = 0; d < Dim; ++d)
        u[d] = b.contents[static_cast<std::size_t>(1 + d) * b.volume.size() + k] / b.contents[k];
      if (c.bodies[0].radial_from_axis)
        for (int d = 1; d < Dim; ++d) x[d] = 0;
      f(norm(x), dot(u, unit(x)));
    });
  }
}

/// As in matter of constant density: with the inverse of the distance from an axis, of its square from a
/// point.
TEST_F(Picture, RadialVelocityFallsWithTheDistance) {
  const auto expect = [](double distance, double speed, int power) {
    ASSERT_NEAR(speed, -300 / std::pow(std::max(distance, 1.0), power), 1e-9);
  };
  config::Case planar = planar_case(vector_of(-3, -3), vector_of(3, 3), 0.25), axis, point, space;
  for_each_radial_speed<2>(planar, world, [&](double r, double u) { expect(r, u, 1); });
  axis.domain = domain_of(Geometry::axisymmetric, vector_of(0, -3), vector_of(3, 3));
  for_each_radial_speed<2>(axis, world, [&](double r, double u) { expect(r, u, 1); });
  point.domain = domain_of(Geometry::axisymmetric, vector_of(0, 0), vector_of(3, 3));
  for_each_radial_speed<2>(point, world, [&](double r, double u) { expect(r, u, 2); });
  space.domain = domain_of(Geometry::space, vector_of(0, 0, 0), vector_of(3, 3, 3));
  for_each_radial_speed<3>(space, world, [&](double r, double u) { expect(r, u, 2); });
}

TEST_F(Picture, RigidBodiesHoldNoMatter) {
  auto c = planar_case(vector_of(-4, -4), vector_of(4, 4), 0.2);
  c.bodies = {body_of("disc", ball_shape(vector_of(-1.5, 0), 1)),
              body_of("wall", box_shape(vector_of(2, -4), vector_of(4, 4)), vector_of(-7, 0))};
  c.bodies[1].rigid = true;
  const auto state = make_state<2>(c, {samples::copper(), Material{}}, world);
  ASSERT_TRUE(state.bodies[1].rigid.has_value());
  EXPECT_EQ(state.bodies[1].rigid->velocity, (Vec<2>{{-7, 0}}));
  EXPECT_DOUBLE_EQ(state.bodies[1].rigid->distance({{1.5, 3.9}}), 0.5);
  for (const auto& b : state.bodies[1].blocks) EXPECT_TRUE(b.contents.empty());
  ASSERT_EQ(state.ledger[0].pairs.size(), 1U);
  ASSERT_EQ(state.ledger[0].edges.size(), 2U);
}

TEST_F(Picture, BlocksWithoutTheBodyAreEmpty) {
  config::Case c;
  c.domain = domain_of(Geometry::line, vector_of(0), vector_of(100));
  c.mesh.finest = 0.5;
  c.mesh.block = 20;
  c.bodies = {body_of("plate", box_shape(vector_of(30), vector_of(35)))};
  const auto state = make_state<1>(c, {samples::copper()}, world);
  for (int s = 0; s < state.mesh.local(); ++s) {
    const int at = state.mesh.block(s).at[0];  // 10 mm each
    EXPECT_EQ(state.bodies[0].present(s), at == 2 || at == 3) << at;
  }
}

TEST(FindOverlaps, SaysWhichWhereAndHowDeep) {
  auto c = planar_case(vector_of(-0.004, -0.004), vector_of(0.004, 0.004), 0.1e-3);
  c.bodies = {body_of("flyer", box_shape(vector_of(-0.002, -0.001), vector_of(0.0003, 0.001))),
              body_of("target", box_shape(vector_of(0, -0.003), vector_of(0.003, 0.003)))};
  config::Diagnostics found;
  find_overlaps(c, found);
  EXPECT_EQ(found.error_count(), 1);
  EXPECT_NE(found.text().find("bodies 'flyer' and 'target' overlap by 0.3 mm near (0."), std::string::npos)
      << found.text();
  c.bodies[0].shape = box_shape(vector_of(-0.002, -0.001), vector_of(0, 0.001));  // touching is fine
  config::Diagnostics none;
  find_overlaps(c, none);
  EXPECT_EQ(none.text(), "");
}

TEST(FindOverlaps, LooksAtEveryPair) {
  config::Case c;
  c.domain = domain_of(Geometry::line, vector_of(0), vector_of(0.01));
  c.mesh.finest = 1e-4;
  c.bodies = {body_of("a", box_shape(vector_of(0.001), vector_of(0.003))),
              body_of("b", box_shape(vector_of(0.002), vector_of(0.005))),
              body_of("c", box_shape(vector_of(0.0045), vector_of(0.006)))};
  config::Diagnostics found;
  find_overlaps(c, found);
  EXPECT_EQ(found.error_count(), 2);
}

/// What `recoil check` says of a mesh of several levels is what the run starts with.
TEST(MakeState, StartsWithAsManyCellsAsForetold) {
  start_parallel();
  auto c = planar_case(vector_of(-0.01, -0.01), vector_of(0.05, 0.05), 1e-4);
  c.bodies.push_back(body_of("block", box_shape(vector_of(0, 0), vector_of(0.04, 0.04))));
  c.mesh.levels = 4;
  const auto state = make_state<2>(c, {samples::copper()}, parallel::World{});
  double held = 0, finest = 0;
  for (int s = 0; s < state.mesh.local(); ++s) {
    if (!state.bodies[0].present(s)) continue;
    held += state.mesh.block(s).cells.size();
    finest += state.mesh.block(s).level == 0 ? state.mesh.block(s).cells.size() : 0;
  }
  double foretold = 0;
  for (const double n : cells_at_start<2>(c)) foretold += n;
  EXPECT_NEAR(foretold / held, 1, 0.2);
  EXPECT_LT(held, 0.75 * 400 * 400);
  EXPECT_GT(finest, 0.3 * held);
}

TEST(MakeGrid, ADomainHoldsWholeCellsOfAllLevels) {
  auto c = planar_case(vector_of(0, 0), vector_of(1, 1), 0.1);
  c.mesh.levels = 3;
  EXPECT_EQ(make_grid<2>(c).cells, (Index<2>{{12, 12}}));
  for (auto& ends : c.domain.boundary) ends = {Boundary::symmetry, Boundary::symmetry};
  EXPECT_THROW(make_grid<2>(c), InputError);
  c.domain.hi = vector_of(1.2, 1.2);
  EXPECT_EQ(make_grid<2>(c).cells, (Index<2>{{12, 12}}));
  c.method.scheme = "ghost-fluid";
  EXPECT_THROW(make_grid<2>(c), InputError);
}

}  // namespace
}  // namespace recoil::start_test
