#include "interface/walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "interface/surface_state.hpp"
#include "walls_fixture.hpp"

namespace recoil::walls_test {
namespace {

TYPED_TEST_SUITE(Walls, Dimensions);

TYPED_TEST(Walls, AFreeSurfaceMovesWithItsMatter) {
  constexpr int dim = TestFixture::dim;
  Vec<dim> u;
  for (int d = 0; d < dim; ++d) u[d] = 70 - 130 * d;
  auto p = this->free_half(moving<dim>(this->material, u));
  find_all(p, this->dt);
  p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>& cut, const Index<dim>&) {
    ASSERT_EQ(w.partners, 0U);
    ASSERT_EQ(w.traction, 0);
    ASSERT_EQ(w.force, Vec<dim>{});
    ASSERT_EQ(w.power, 0);
    ASSERT_LT(norm(w.velocity - u), 1e-10);
    ASSERT_NEAR(w.volume_rate, dot(u, cut.surface), 1e-10);
    for (int i = 0; i < dim; ++i) ASSERT_LT(norm(w.stretching[i] - u[i] * cut.surface), 1e-10);
  });
}

/// Velocity u - sigma/Z n - tau/Z_s of a stressed surface.
TYPED_TEST(Walls, AFreeSurfaceRecoils) {
  constexpr int dim = TestFixture::dim;
  const auto w0 = some_primitives<dim>(this->material);
  auto p = this->free_half(w0);
  find_all(p, this->dt);
  const auto s = surface_state<dim>(this->material, w0, this->normal);
  Vec<dim> u;
  for (int d = 0; d < dim; ++d) u[d] = w0[1 + d];
  const Vec<dim> exact =
      u - s.stress / s.impedance * this->normal - s.shear * (1 / std::sqrt(w0[0] * 43.33e9));
  EXPECT_GT(norm(exact - u), 10);
  p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>& i) {
    if (!this->inside(i)) return;
    ASSERT_LT(norm(w.velocity - exact), 1e-6);
    ASSERT_EQ(w.force, Vec<dim>{});
  });
}

TYPED_TEST(Walls, ResolvingATensor) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  const auto w = some_primitives<dim>(this->material);
  const auto s = resolve<dim>(w, this->normal);
  Vec<dim> traction, u;
  for (int i = 0; i < dim; ++i) {
    u[i] = w[C::u + i];
    for (int j = 0; j < dim; ++j) {
      const int c = C::stress(i, j);
      traction[i] += (c >= 0 ? w[C::s + c] : -w[C::s] - w[C::s + 1]) * this->normal[j];
    }
  }
  EXPECT_LT(norm(s.velocity * this->normal + s.sliding - u), 1e-12);
  EXPECT_NEAR(dot(s.sliding, this->normal), 0, 1e-12);
  EXPECT_LT(norm(s.deviator * this->normal + s.shear - traction), 1e-6);
  EXPECT_NEAR(dot(s.shear, this->normal), 0, 1e-6);
  EXPECT_NEAR(s.stress, s.deviator - w[C::p], 1e-3);
}

TYPED_TEST(Walls, AnImpactGivesBothTheSameWithOppositeSign) {
  constexpr int dim = TestFixture::dim;
  const double speed = 60;
  auto p =
      this->facing(0, moving<dim>(this->material, speed * this->normal), moving<dim>(this->material, {}));
  find_all(p, this->dt);
  this->expect_balance(p);
  int touching = 0;
  for (int m = 0; m < 2; ++m)
    p.for_each_wall(m, [&](const Wall<dim>& w, const CutCell<dim>& cut, const Index<dim>& i) {
      ASSERT_LE(w.traction, 0);
      if (!this->inside(i)) return;
      ++touching;
      ASSERT_EQ(w.partners, m == 0 ? 2U : 1U);
      ASSERT_NEAR(w.traction / (-0.5 * speed * this->z), 1, 1e-9);
      ASSERT_LT(norm(w.velocity - 0.5 * speed * this->normal), 1e-9);
      ASSERT_LT(norm(w.force - w.traction * cut.surface), 1e-9 * norm(w.force));
      ASSERT_NEAR(w.power, dot(w.force, 0.5 * speed * this->normal), 1e-9 * std::abs(w.power));
      ASSERT_NEAR(w.volume_rate, 0.5 * speed * dot(this->normal, cut.surface), 1e-9);
    });
  EXPECT_GT(touching, dim == 1 ? 1 : 8);
}

/// Bodies that fill their cells by more than 1.05 are pushed apart, at most as fast as they close, where they
/// press with more than 0.05 rho c_L^2; what presses less, or opens, is not.
TYPED_TEST(Walls, OverfilledCellsPushSurfacesApartWhereTheyPressStrongly) {
  constexpr int dim = TestFixture::dim;
  const double sound = longitudinal_speed(this->material), overlap = 0.15;
  for (const double speed : {0.09 * sound, 0.11 * sound, 2 * sound, -0.2 * sound}) {
    auto p =
        this->facing(0, moving<dim>(this->material, speed * this->normal), moving<dim>(this->material, {}));
    for_each_piece(p.state, 0, [&](auto& b, const Index<dim>&, std::size_t k) {
      if (b.volume[k] > 0) b.volume[k] += overlap * this->grid.dx_power(dim);
    });
    find_all(p, this->dt);
    const bool strong = speed > 0.1 * sound;
    const double push = strong ? std::min(0.2 * (overlap - 0.05) * this->grid.dx / this->dt, speed) : 0;
    int pushed = 0;
    p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>& cut, const Index<dim>& i) {
      if (!this->inside(i) || !(p.state.bodies[0].at(0).volume[cut.cell] > 0)) return;
      ++pushed;
      const double expected = speed > 0 ? -0.5 * (speed + push) * this->z : 0;
      ASSERT_NEAR(w.traction, expected, 1e-6 * std::abs(expected));
    });
    EXPECT_GT(pushed, 0);
    std::int64_t counted = 0;
    for (const auto& l : p.state.ledger) counted += l.counters.pushed_contacts;
    EXPECT_EQ(counted > 0, strong);
  }
}

/// A fit across a shock may bear tension that its sound, below its floor, cannot answer for.
TEST(SurfaceState, IsNotSofterThanItsStress) {
  using C = Components<1>;
  Primitives<1> w{};
  w[C::rho] = 9000;
  w[C::p] = -170e9;
  const auto s = surface_state<1>(samples::copper(), w, Vec<1>{{1}});
  EXPECT_LE(std::abs(s.stress / s.impedance), std::sqrt(170e9 / 9000) * (1 + 1e-12));
  w[C::p] = 10e9;
  const auto pressed = surface_state<1>(samples::copper(), w, Vec<1>{{1}});
  EXPECT_GT(pressed.impedance, 1.5 * std::sqrt(10e9 * 9000));
}

/// Bodies that slide past each other keep their own tangential velocity: no friction, no work by it.
TYPED_TEST(Walls, SlidingIsFree) {
  constexpr int dim = TestFixture::dim;
  if (dim == 1) return;
  Vec<dim> along;
  along[0] = -this->normal[1];
  along[1] = this->normal[0];
  auto p = this->facing(0, moving<dim>(this->material, 40.0 * this->normal + 300.0 * along),
                        moving<dim>(this->material, -200.0 * along));
  find_all(p, this->dt);
  this->expect_balance(p);
  p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>& i) {
    if (!this->inside(i)) return;
    ASSERT_NEAR(dot(w.velocity, along), 300 * norm(along) * norm(along), 1e-6);
    ASSERT_NEAR(dot(w.force, along), 0, 1e-6);
    ASSERT_NEAR(w.power, dot(w.force, this->normal) * 20, 1e-8 * std::abs(w.power));
  });
}

/// Coulomb's law on the wall: tau = mu |sigma| against the sliding, the same for both with opposite sign.
TYPED_TEST(Walls, FrictionHoldsBackWhatSlides) {
  constexpr int dim = TestFixture::dim;
  if (dim == 1) return;
  Vec<dim> along;
  along[0] = -this->normal[1];
  along[1] = this->normal[0];
  along = unit(along);
  auto p = this->facing(0, moving<dim>(this->material, 40.0 * this->normal + 300.0 * along),
                        moving<dim>(this->material, -200.0 * along));
  p.state.contact[0] = {ContactLaw::Mode::friction, 0.3};
  find_all(p, this->dt);
  this->expect_balance(p);
  const double stress = 20 * this->z;  // impact of equal bodies at 40 m/s
  for (int m = 0; m < 2; ++m)
    p.for_each_wall(m, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>& i) {
      if (!this->inside(i)) return;
      const double side = m == 0 ? 1 : -1;
      ASSERT_NEAR(dot(w.shear, along), -side * 0.3 * stress, 1e-6 * stress);
      ASSERT_NEAR(dot(w.force, along), -0.3 * side * std::abs(dot(w.force, this->normal)),
                  1e-6 * norm(w.force));
      // The surfaces are slowed by tau/Z_s; both sides work with their mean.
      const double slowed = 0.3 * stress / std::sqrt(8930 * 43.33e9);
      ASSERT_NEAR(dot(w.velocity, along), m == 0 ? 300 - slowed : -200 + slowed, 1e-6);
      ASSERT_NEAR(w.power, dot(w.force, this->normal) * 20 + dot(w.force, along) * 50,
                  1e-8 * std::abs(w.power));
    });
}

/// Slow sliding sticks; what is glued holds also when it is pulled apart.
TYPED_TEST(Walls, StickingAndGluedSurfacesMoveTogether) {
  constexpr int dim = TestFixture::dim;
  Vec<dim> along;
  if constexpr (dim > 1) {
    along[0] = -this->normal[1];
    along[1] = this->normal[0];
  }
  const std::array<ContactLaw, 2> laws{{{ContactLaw::Mode::friction, 0.3}, {ContactLaw::Mode::bonded, 0}}};
  for (const ContactLaw& law : laws) {
    const bool glued = law.mode == ContactLaw::Mode::bonded;
    const Vec<dim> u = (glued ? -40.0 : 40.0) * this->normal + 4.0 * along;
    auto p = this->facing(0, moving<dim>(this->material, u), moving<dim>(this->material, {}));
    p.state.contact[0] = law;
    find_all(p, this->dt);
    this->expect_balance(p);
    for (int m = 0; m < 2; ++m)
      p.for_each_wall(m, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>& i) {
        if (!this->inside(i)) return;
        ASSERT_LT(norm(w.velocity - 0.5 * u), 1e-9);
        ASSERT_NEAR(w.traction, (glued ? 20 : -20) * this->z, 1e-6 * this->z);
      });
  }
}

TYPED_TEST(Walls, PartingBodiesAreFree) {
  constexpr int dim = TestFixture::dim;
  auto p = this->facing(0, moving<dim>(this->material, -5.0 * this->normal), moving<dim>(this->material, {}));
  find_all(p, this->dt);
  for (int m = 0; m < 2; ++m)
    p.for_each_wall(m, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>&) {
      ASSERT_EQ(w.partners, 0U);
      ASSERT_EQ(w.force, Vec<dim>{});
    });
  EXPECT_TRUE(p.state.ledger[0].pairs[0].area.is_zero());
}

/// A gap is closed first: contact starts in the step in which the surfaces meet.
TYPED_TEST(Walls, AGapDelaysTheContact) {
  constexpr int dim = TestFixture::dim;
  const double gap = 0.1 * this->grid.dx, speed = 60;
  for (const double part : {0.9, 1.5}) {
    auto p =
        this->facing(0.1, moving<dim>(this->material, speed * this->normal), moving<dim>(this->material, {}));
    const double step = part * gap / speed;
    find_all(p, step);
    this->expect_balance(p);
    p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>& i) {
      if (!this->inside(i)) return;
      ASSERT_EQ(w.partners, part < 1 ? 0U : 2U);
      const double left = std::max(0.0, speed - gap / step);
      ASSERT_NEAR(w.traction, -0.5 * left * this->z, 1e-6 * this->z);
    });
    // What was in contact stays so without closing a settled gap first.
    auto closer = this->facing(0.05, moving<dim>(this->material, speed * this->normal),
                               moving<dim>(this->material, {}));
    for (auto& b : closer.state.bodies[0].blocks) std::fill(b.contact.begin(), b.contact.end(), 2U);
    find_all(closer, step);
    closer.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>&, const Index<dim>& i) {
      if (!this->inside(i)) return;
      ASSERT_NEAR(w.traction, -0.5 * speed * this->z, 1e-6 * this->z);
    });
  }
}

TYPED_TEST(Walls, ARigidWallStopsABody) {
  constexpr int dim = TestFixture::dim;
  const double speed = 50, wall_speed = 10;
  auto p =
      this->facing(0, moving<dim>(this->material, speed * this->normal), moving<dim>(this->material, {}));
  p.state.bodies[1].rigid.emplace().distance = half_space(this->middle, -this->normal);
  set_moving(*p.state.bodies[1].rigid, wall_speed * this->normal, {});
  p.prepare();
  find_all(p, this->dt);
  p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>& cut, const Index<dim>& i) {
    if (!this->inside(i)) return;
    ASSERT_EQ(w.partners, 2U);
    ASSERT_NEAR(w.traction / (-(speed - wall_speed) * this->z), 1, 1e-9);
    ASSERT_NEAR(dot(w.velocity, this->normal), wall_speed, 1e-9);
    ASSERT_LT(norm(w.force - w.traction * cut.surface), 1e-6 * norm(w.force));
    ASSERT_NEAR(w.power, wall_speed * dot(w.force, this->normal), 1e-9 * std::abs(w.power));
  });
}

/// A rigid slab of 1.3 cells, askew to the mesh, bears what a half-space bears.
TYPED_TEST(Walls, AThinRigidBodyStopsABody) {
  constexpr int dim = TestFixture::dim;
  const double speed = 50;
  const auto area = [&](double cells) {
    const Distance<dim> slab = [=, this](const Vec<dim>& x) {
      const double depth = dot(x - this->middle, this->normal);
      return std::max(-depth, depth - cells * this->grid.dx);
    };
    Prepared<dim> p(this->grid, {half_space(this->middle, this->normal), slab},
                    {moving<dim>(this->material, speed * this->normal), moving<dim>(this->material, {})});
    p.state.bodies[1].rigid.emplace().distance = slab;
    p.prepare();
    find_all(p, this->dt);
    double sum = 0;
    p.for_each_wall(0, [&](const Wall<dim>& w, const CutCell<dim>& cut, const Index<dim>& i) {
      if (this->inside(i) && w.partners != 0) sum += norm(cut.surface);
      if (this->inside(i) && w.partners != 0) {
        ASSERT_NEAR(w.traction / (-speed * this->z), 1, 1e-3);
      }
    });
    return sum;
  };
  const double whole = area(100);
  EXPECT_GT(whole, 0);
  EXPECT_NEAR(area(1.3), whole, 0.01 * whole);
}

}  // namespace
}  // namespace recoil::walls_test
