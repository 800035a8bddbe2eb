#include "interface/ghost_walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "../core/dimensions.hpp"
#include "interface/opposite.hpp"
#include "interface/seed_walls.hpp"
#include "interface/walls.hpp"
#include "prepared.hpp"
#include "state/contact_sums.hpp"

/// The walls of both ghost-fluid schemes.
namespace recoil::ghost_walls_test {
namespace {

enum class Kind { improved, seed };

template <int Dim>
void find_all(Prepared<Dim>& p, Kind kind, double dt, double weight) {
  cut_all(p.state, Surfaces::own);
  p.evaluate();
  Scratch scratch;
  for (int s = 0; s < p.state.mesh.local(); ++s) {
    const Scratch::Frame frame(scratch);
    if (kind == Kind::improved)
      find_ghost_walls(p.state, s, dt, weight, scratch);
    else
      find_seed_walls(p.state, s, 0.5, dt, weight, scratch);
  }
}

template <class D>
struct GhostWalls : testing::Test {
  static constexpr int dim = D::value;
  Grid<dim> grid = make_test_grid<dim>(20, 10, Edge::outflow);
  Material material = samples::copper();
  Vec<dim> middle = middle_of(grid) + 0.2 * grid.dx * tilted(), normal = tilted();
  const double z = density(material) * longitudinal_speed(material), dt = 1e-5;

  static Vec<dim> tilted() {
    Vec<dim> n;
    for (int d = 0; d < dim; ++d) n[d] = 1 - 0.45 * d;
    return unit(n);
  }
  bool inside(const Index<dim>& i) const { return grid.domain().grown(-5).contains(i); }
  Prepared<dim> facing(const Vec<dim>& below, const Vec<dim>& above) {
    return {grid,
            {half_space(middle, normal), half_space(middle, -normal)},
            {moving(material, below), moving(material, above)}};
  }
  /// A copper half-space that moves along its normal into a rigid one that turns about a point of the
  /// surface.
  Prepared<dim> on_turning_wall(double speed, const Vec<3>& spin) {
    auto p = facing(speed * normal, {});
    auto& rigid = p.state.bodies[1].rigid.emplace();
    rigid.distance = half_space(middle, -normal);
    rigid.start_centre = rigid.centre = middle;
    set_moving(rigid, -3.0 * normal, spin);
    p.prepare();
    return p;
  }
};
TYPED_TEST_SUITE(GhostWalls, Dimensions);

/// The wall's velocity is that of the rigid body's material point: the traction follows the spin.
TYPED_TEST(GhostWalls, ATurningRigidBodyPressesAsItsSurfaceMoves) {
  constexpr int dim = TestFixture::dim;
  const double speed = 50;
  const Vec<3> spin{{dim == 3 ? 2.0 : 0.0, 0, dim == 1 ? 0.0 : -9.0}};
  for (const Kind kind : {Kind::improved, Kind::seed}) {
    auto p = this->on_turning_wall(speed, spin);
    find_all(p, kind, this->dt, 1);
    double least = 1e300, most = -1e300;
    int touching = 0;
    p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>& cut, const Index<dim>& i) {
      if (!this->inside(i)) return;
      ++touching;
      const double wall = dot(velocity_at(*p.state.bodies[1].rigid, cut.point), this->normal);
      ASSERT_EQ(w.partners, 2U);
      ASSERT_NEAR(w.traction, -(speed - wall) * this->z, 1e-6 * speed * this->z);
      ASSERT_NEAR(dot(w.velocity, this->normal), wall, 1e-6 * speed);
      least = std::min(least, wall);
      most = std::max(most, wall);
    });
    EXPECT_GT(touching, dim == 1 ? 0 : 5);
    if (dim > 1) {
      EXPECT_GT(most - least, 5) << "the spin shows";
    }
  }
}

/// The moment of a pair is the sum of r x F over its contacts, for rigid and deformable partners.
TYPED_TEST(GhostWalls, TheMomentIsThatOfTheForces) {
  constexpr int dim = TestFixture::dim;
  const double weight = 0.25;
  for (const Kind kind : {Kind::improved, Kind::seed})
    for (const bool rigid : {true, false}) {
      auto p = rigid ? this->on_turning_wall(50, {{0, 0, dim == 1 ? 0.0 : 4.0}})
                     : this->facing(50.0 * this->normal, -10.0 * this->normal);
      find_all(p, kind, this->dt, weight);
      find_all(p, kind, this->dt, weight);
      find_all(p, kind, this->dt, 0);  // of the new state: books nothing
      Vec<dim> force;
      Vec<3> moment;
      double scale = 0;
      p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>& cut, const Index<dim>&) {
        if (w.partners == 0 || !(dot(cut.surface, w.normal) > 0)) return;
        const Vec<dim> f = w.traction * dot(cut.surface, w.normal) * w.normal;
        force += f;
        moment += cross(cut.point, f);
        scale += norm(f);
      });
      Vec<dim> impulse;
      Vec<3> booked;
      for (const auto& l : p.state.ledger) {
        impulse += l.pairs[0].exchanged.momentum.value();
        booked += l.pairs[0].moment.value();
      }
      EXPECT_GT(scale, 0);
      EXPECT_LT(norm(impulse - 2 * weight * this->dt * force), 1e-9 * weight * this->dt * scale);
      EXPECT_LT(norm(booked - 2 * weight * this->dt * moment), 1e-9 * weight * this->dt * scale);
      if (dim == 2) {
        EXPECT_GT(norm(moment), 0.05 * scale) << "there is one";
      }
    }
}

/// Each deformable body has a contact of its own in the list; sums take that of the lower-numbered one.
TYPED_TEST(GhostWalls, TheListHoldsEveryWallInContact) {
  constexpr int dim = TestFixture::dim;
  for (const Kind kind : {Kind::improved, Kind::seed}) {
    auto p = this->facing(50.0 * this->normal, -10.0 * this->normal);
    find_all(p, kind, this->dt, 1);
    std::array<int, 2> walls{}, listed{};
    for (int m = 0; m < 2; ++m)
      p.for_each_wall(m, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>&) {
        walls[m] += w.partners != 0;
      });
    double area = 0, booked = 0;
    for (int s = 0; s < p.state.mesh.local(); ++s) {
      for (const Contact<dim>& c : p.state.contacts[s]) {
        ++listed[c.first];
        EXPECT_TRUE(c.one_sided);
        EXPECT_NE(c.first, c.second);
        EXPECT_EQ(counts(p.state, c), c.first == 0 && c.area > 0);
        if (counts(p.state, c)) area += c.area;
      }
      booked += p.state.ledger[s].pairs[0].area.value();
    }
    EXPECT_GT(walls[0], 0);
    EXPECT_EQ(listed, walls);
    EXPECT_NEAR(booked, area, 1e-12 * area);
  }
}

TYPED_TEST(GhostWalls, TheNearestBodyThatFacesIsOpposite) {
  constexpr int dim = TestFixture::dim;
  for (const double gap : {0.4, 1.5}) {
    Prepared<dim> p(
        this->grid,
        {half_space(this->middle, this->normal),
         half_space(this->middle + gap * this->grid.dx * this->normal, -this->normal)},
        {moving(this->material, 50.0 * this->normal), moving(this->material, -20.0 * this->normal)});
    cut_all(p.state, Surfaces::own);
    p.prepare();
    p.evaluate();
    Scratch scratch;
    int seen = 0;
    for (int s = 0; s < p.state.mesh.local(); ++s) {
      const Scratch::Frame frame(scratch);
      const SurfaceView<dim> v = view_surfaces(p.state, s, opposite_sight, scratch);
      for (const CutCell<dim>& cut : p.state.bodies[0].at(s).geometry.cuts) {
        const Index<dim> i = v.window.index_of(cut.cell);
        if (!this->inside(i)) continue;
        const Opposite<dim> o = find_opposite(v, 0, cut.point, i);
        ASSERT_EQ(o.body, gap < 1 ? 1 : -1);
        if (o.body < 0) continue;
        ++seen;
        ASSERT_NEAR(o.gap, gap * this->grid.dx, 0.05 * this->grid.dx);
        ASSERT_LT(norm(o.normal + this->normal), 1e-9);
        ASSERT_TRUE(o.faces(this->normal));
        ASSERT_FALSE(o.faces(-this->normal));
        ASSERT_LT(norm(velocity_of(v, o, cut.point) + 20.0 * this->normal), 1e-9);
        ASSERT_LT(norm(contact_normal(v, o, this->normal) - this->normal), 1e-9);
      }
    }
    EXPECT_EQ(seen > 0, gap < 1);
  }
}

/// Contact counts as kept where it was in the cell or one beside it, whoever of the two remembers.
TYPED_TEST(GhostWalls, TheViewRemembersContact) {
  constexpr int dim = TestFixture::dim;
  auto p = this->facing({}, {});
  Index<dim> at = p.state.mesh.block(0).cells.lo, beside, far;
  for (int d = 0; d < dim; ++d) at[d] += 5, beside[d] = at[d] - 1, far[d] = at[d] + (d == 0 ? 2 : 0);
  const auto layout = this->grid.layout();
  Scratch scratch;
  for (const int who : {0, 1}) {
    for (Body<dim>& body : p.state.bodies)
      std::fill(body.at(0).contact.begin(), body.at(0).contact.end(), 0U);
    p.state.bodies[who].at(0).contact[layout.at(at - p.state.mesh.block(0).cells.lo)] = 1U << (1 - who);
    const Scratch::Frame frame(scratch);
    const SurfaceView<dim> v = view_surfaces(p.state, 0, {}, scratch);
    for (const auto& [one, other] : {std::pair{0, 1}, std::pair{1, 0}}) {
      EXPECT_TRUE(v.was_in_contact(one, other, at));
      EXPECT_TRUE(v.was_in_contact(one, other, beside));
      EXPECT_FALSE(v.was_in_contact(one, other, far));
    }
    EXPECT_TRUE(v.touched(who, 1 - who, at));
    EXPECT_FALSE(v.touched(1 - who, who, at));
  }
}

}  // namespace
}  // namespace recoil::ghost_walls_test
