#include "dynamics/damage/nonlocal_damage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "../core/dimensions.hpp"
#include "material/damage/damage_drive.hpp"
#include "run.hpp"
#include "spall_plates.hpp"

namespace recoil::nonlocal_damage_test {
namespace {

constexpr double mm = 1e-3, dx = 0.1 * mm;

Material breaking(const Damage& damage, double length) {
  Material m = samples::aluminium();
  m.damage = damage;
  m.damage_average.length = length;
  return m;
}

template <class D>
struct NonlocalDamage : testing::Test {
  static constexpr int dim = D::value;
};
TYPED_TEST_SUITE(NonlocalDamage, Dimensions);

/// f(block, place in its arrays, index) for every cell of the target that holds matter.
template <int Dim, class F>
void for_each_target_cell(TestRun<Dim>& run, F&& f) {
  for (int s = 0; s < run.state.mesh.local(); ++s) {
    auto& b = run.state.bodies[1].at(s);
    if (!b.present) continue;
    const Box<Dim> own = run.state.mesh.block(s).cells;
    for_each(own, [&](const Index<Dim>& i) {
      const auto k = static_cast<std::size_t>(run.state.grid().layout().at(i - own.lo));
      if (b.volume[k] > 0 && b.contents[k] > 0) f(b, k, i);
    });
  }
}

/// The stress of the drive at a height of cells: neither constant nor linear.
double tension_at(int cell) { return 1e9 + 4e7 * cell + 3e6 * cell * cell; }

/// Every cell gets the mean with the weights of the law, over the cells that hold matter: at surfaces of
/// those on its side, and of each as much as it is full.
TYPED_TEST(NonlocalDamage, IsTheWeightedMeanOfTheMatterAround) {
  constexpr int dim = TestFixture::dim, axis = dim - 1;
  using C = Components<dim>;
  const double length = 3.2 * dx, time = 1e-6, dt = 1e-8;
  TestRun<dim> run(plates<dim>(dim - 1, dx),
                   {breaking(NoDamage{}, 0), breaking(TensileDamage{1, 1, time}, length)});
  run.steps(1);
  State<dim>& state = run.state;
  std::vector<double> full(200, 0);  // by height
  const auto at = [](int height) { return static_cast<std::size_t>(height + 100); };
  for (auto& b : state.bodies[1].blocks)
    if (b.present) clear_damage_drive(b);
  for_each_target_cell(run, [&](BodyBlock<dim>& b, std::size_t k, const Index<dim>& i) {
    DamagePoint point;
    point.principal = tension_at(i[axis]);
    full[at(i[axis])] = b.volume[k] / state.grid().full_volume(i);
    const auto values = DamageDrive::of(point, full[at(i[axis])]);
    for (std::size_t c = 0; c < values.size(); ++c) b.damage_drive[c * b.volume.size() + k] = values[c];
    b.contents[C::damage * b.volume.size() + k] = 0;
  });
  Scratch scratch;
  for (int s = 0; s < state.mesh.local(); ++s)
    if (state.bodies[1].present(s)) grow_by_mean(state, state.bodies[1], s, dt, 1, state.ledger[s], scratch);
  int seen = 0;
  for_each_target_cell(run, [&](BodyBlock<dim>& b, std::size_t k, const Index<dim>& i) {
    double weights = 0, sum = 0;
    Box<dim> around{i, i};
    for (int d = 0; d < dim; ++d) around.lo[d] -= 4, around.hi[d] += 5;
    for_each(around, [&](const Index<dim>& j) {
      double square = 0;
      for (int d = 0; d < dim; ++d) square += (j[d] - i[d]) * (j[d] - i[d]) * dx * dx;
      const double part = std::max(0.0, 1 - square / (length * length));
      const double weight = part * part * full[at(j[axis])];
      weights += weight;
      sum += weight * tension_at(j[axis]);
    });
    const double damage = b.contents[C::damage * b.volume.size() + k] / b.contents[k],
                 expected = std::min(1.0, dt / time * (sum / weights - 1));
    EXPECT_NEAR(damage / expected, 1, 1e-12) << i[axis];
    ++seen;
  });
  EXPECT_GT(seen, 15);
}

/// Between cells with a void, which have no stress, a cell breaks by its own tension, beside one by half of
/// it, elsewhere by the mean.
TEST(NonlocalDamage, BesideVoidsACellBreaksByItsOwnTension) {
  const double length = 3.2 * dx, time = 1e-6, dt = 1e-8, own = 9e9;
  enum class Voids { none, above, around };
  for (const Voids voids : {Voids::none, Voids::above, Voids::around}) {
    TestRun<2> run(plates<2>(1, dx),
                   {breaking(NoDamage{}, 0), breaking(TensileDamage{1e9, 1, time}, length)});
    run.steps(1);
    for (auto& b : run.state.bodies[1].blocks)
      if (b.present) clear_damage_drive(b);
    Index<2> pulled{};
    for_each_target_cell(run, [&](const BodyBlock<2>&, std::size_t, const Index<2>& i) {
      if (i[1] == 30) pulled = i;
    });
    double damage = -1;
    for_each_target_cell(run, [&](BodyBlock<2>& b, std::size_t k, const Index<2>& i) {
      DamagePoint point;
      const bool is_void = voids == Voids::around || (voids == Voids::above && i[1] > pulled[1]);
      point.pressure = is_void ? 0 : 1;
      if (i == pulled) point.principal = own;
      const auto values = DamageDrive::of(point, 1);
      for (std::size_t c = 0; c < values.size(); ++c) b.damage_drive[c * b.volume.size() + k] = values[c];
    });
    Scratch scratch;
    for (int s = 0; s < run.state.mesh.local(); ++s)
      if (run.state.bodies[1].present(s))
        grow_by_mean(run.state, run.state.bodies[1], s, dt, 1, run.state.ledger[s], scratch);
    for_each_target_cell(run, [&](BodyBlock<2>& b, std::size_t k, const Index<2>& i) {
      if (i == pulled) damage = b.contents[Components<2>::damage * b.volume.size() + k] / b.contents[k];
    });
    const auto by = [&](double part) { return dt / time * (part * own / 1e9 - 1); };
    if (voids == Voids::none)
      EXPECT_LT(damage, by(0.45));
    else
      EXPECT_NEAR(damage, by(voids == Voids::around ? 1 : 0.5), 1e-12);
    EXPECT_GE(damage, 0);
  }
}

/// With all of the models a scab flies off, and no budget opens.
TYPED_TEST(NonlocalDamage, BudgetsClose) {
  constexpr int dim = TestFixture::dim;
  for (const StepStages stages : {StepStages::three, StepStages::one})
    for (const Damage& damage : {Damage{TensileDamage{1e9, 1, 20e-9}}, Damage{MinimumPressure{1.2e9}}}) {
      TestRun<dim> run(plates<dim>(dim - 1, dx), {breaking(NoDamage{}, 0), breaking(damage, 2.5 * dx)});
      run.stepping.stages = stages;
      while (run.state.time < 1.2e-6) advance(run.state, run.stepping, 1.2e-6, run.engine);
      EXPECT_GT(failed_mass(run, 1), 0.05 * run.start[1][0]);
      for (int m = 0; m < 2; ++m) EXPECT_LT(run.imbalance(m, 400), 1e-12);
      for_each_target_cell(run, [](const BodyBlock<dim>& b, std::size_t k, const Index<dim>&) {
        const double of_mass = b.contents[Components<dim>::damage * b.volume.size() + k] / b.contents[k];
        EXPECT_GE(of_mass, -1e-6);
        EXPECT_LE(of_mass, 1 + 1e-9);
      });
    }
}

TYPED_TEST(NonlocalDamage, BlocksAndThreadsDoNotMatter) {
  constexpr int dim = TestFixture::dim;
  for (const Damage& damage : {Damage{TensileDamage{1e9, 1, 20e-9}}, Damage{MinimumPressure{1.2e9}}}) {
    const Material material = breaking(damage, 2.5 * dx);
    TestRun<dim> one(plates<dim>(dim - 1, dx, 16), {material, material}),
        other(plates<dim>(dim - 1, dx, 28), {material, material}, 2);
    one.steps(50 + 90 * dim);
    other.steps(50 + 90 * dim);
    EXPECT_GT(failed_mass(one, 1), 0);
    EXPECT_EQ(one.state.time, other.state.time);
    EXPECT_EQ(one.cells(1), other.cells(1));
  }
}

/// Where cells are larger than the length, a cell goes by its own state, whatever is beside it.
TEST(NonlocalDamage, ReachesAsFarAsItsLength) {
  Body<2> body;
  body.material = breaking(TensileDamage{1e9, 1, 20e-9}, 0.3 * mm);
  EXPECT_EQ(averaged_cells(body, 0.1 * mm), 3);
  EXPECT_EQ(averaged_cells(body, 0.12 * mm), 3);
  EXPECT_EQ(averaged_cells(body, 0.3 * mm), 1);
  EXPECT_EQ(averaged_cells(body, 1 * mm), 1);
  body.material.damage = NoDamage{};
  EXPECT_EQ(averaged_cells(body, 0.1 * mm), 0);
  const DamageAverage average{0.3 * mm};
  EXPECT_EQ(average.weight(0), 1);
  EXPECT_DOUBLE_EQ(average.weight(0.15 * mm), 0.5625);
  EXPECT_EQ(average.weight(0.3 * mm), 0);
  EXPECT_EQ(average.weight(1 * mm), 0);
}

}  // namespace
}  // namespace recoil::nonlocal_damage_test
