#include "gauge/fragments/fragments.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "../core/dimensions.hpp"
#include "../problem/cases.hpp"
#include "../support/small_case.hpp"
#include "gauge/totals.hpp"

namespace recoil::fragments_test {
namespace {

constexpr double mm = 1e-3, dx = 0.2 * mm, speed = 100;

/// A bar of 20 cells along x, 8 cells wide, and a cell behind it another body.
template <int Dim>
State<Dim> bar(int block) {
  using config::Geometry;
  config::Case c;
  c.domain = domain_of(Dim == 1   ? Geometry::line
                       : Dim == 2 ? Geometry::planar
                                  : Geometry::space,
                       {0, 0, 0}, {6.4 * mm, 3.2 * mm, 3.2 * mm});
  c.mesh.finest = dx;
  c.mesh.block = block;
  const double lo = 0.8 * mm, hi = 2.4 * mm;
  c.bodies = {body_of("bar", box_shape({1 * mm, lo, lo}, {5 * mm, hi, hi}), {speed, 0, 0}),
              body_of("other", box_shape({5.2 * mm, lo, lo}, {6.2 * mm, hi, hi}))};
  start_parallel();
  return make_state<Dim>(c, {hard_matter(), hard_matter()}, parallel::World{});
}

/// Changes the bar's cells whose middle lies between two places along x: f(block, place in it).
template <int Dim>
void change(State<Dim>& state, double from, double to,
            const std::function<void(BodyBlock<Dim>&, std::size_t)>& f) {
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    BodyBlock<Dim>& b = state.bodies[0].at(slot);
    if (!b.present) continue;
    const Grid<Dim>& grid = state.grid(slot);
    const Box<Dim> cells = state.mesh.block(slot).cells;
    for_each(cells, [&](const Index<Dim>& i) {
      const auto k = static_cast<std::size_t>(grid.layout().at(i - cells.lo));
      const double x = grid.centre(i)[0];
      if (x > from && x < to && b.contents[k] > 0) f(b, k);
    });
  }
}

/// So much of the contents stays, and of the volume; the level set lies so far outside.
template <int Dim>
void thin(BodyBlock<Dim>& b, std::size_t k, double mass, double volume, double phi, bool fails) {
  using C = Components<Dim>;
  const std::size_t n = b.volume.size();
  for (std::size_t c = 0; c < C::contents; ++c) b.contents[c * n + k] *= mass;
  if (fails) b.contents[C::damage * n + k] = b.contents[k];
  b.volume[k] *= volume;
  if (phi != 0) b.phi[k] = phi;
}

/// Failed matter with a void of a tenth; what is left in an open crack; a sliver that has not failed.
template <int Dim>
void make_rubble(BodyBlock<Dim>& b, std::size_t k) {
  thin(b, k, 0.9, 1, 0, true);
}
template <int Dim>
void open_crack(BodyBlock<Dim>& b, std::size_t k) {
  thin(b, k, 0.3, 0.3, 0.2 * dx, true);
}
template <int Dim>
void make_sliver(BodyBlock<Dim>& b, std::size_t k) {
  thin(b, k, 0.3, 0.3, 0.2 * dx, false);
}

constexpr double cross_section(int dimensions) {
  return dimensions == 1 ? 1 : dimensions == 2 ? 1.6 * mm : 1.6 * mm * 1.6 * mm;
}

template <class D>
struct FragmentsOf : testing::Test {
  static constexpr int dim = D::value;
  void SetUp() override {
    if (several_processes()) GTEST_SKIP();
  }
};
TYPED_TEST_SUITE(FragmentsOf, Dimensions);

TYPED_TEST(FragmentsOf, AWholeBodyIsOnePiece) {
  constexpr int dim = TestFixture::dim;
  const State<dim> state = bar<dim>(9);
  const auto found = find_fragments(state, parallel::World{});
  ASSERT_EQ(found.list.size(), 2U) << "one of each body";
  EXPECT_EQ(found.heaviest, (std::vector{0, 1}));
  const Fragment<dim>& f = found.list[0];
  const double volume = 4 * mm * cross_section(dim);
  EXPECT_TRUE(f.piece);
  EXPECT_EQ(f.failed, 0);
  EXPECT_EQ(f.cells, 20 * (dim == 1 ? 1 : dim == 2 ? 8 : 64));
  EXPECT_NEAR(f.mass / (1000 * volume), 1, 1e-12);
  EXPECT_NEAR(f.volume / volume, 1, 1e-12);
  EXPECT_NEAR(f.kinetic / (500 * volume * speed * speed), 1, 1e-12);
  EXPECT_NEAR(f.velocity[0], speed, 1e-10);
  EXPECT_NEAR(f.position[0], 3 * mm, 1e-12);
  EXPECT_NEAR(f.lowest[0], 1 * mm, 1e-9);
  EXPECT_NEAR(f.highest[0], 5 * mm, 1e-9);
  const double round = dim == 1   ? volume
                       : dim == 2 ? std::sqrt(4 * volume / std::numbers::pi)
                                  : std::cbrt(6 * volume / std::numbers::pi);
  EXPECT_NEAR(f.diameter / round, 1, 1e-12);
}

TYPED_TEST(FragmentsOf, RubbleParts) {
  constexpr int dim = TestFixture::dim;
  State<dim> state = bar<dim>(9);
  change<dim>(state, 2.4 * mm, 2.8 * mm, make_rubble<dim>);
  const auto found = find_fragments(state, parallel::World{});
  ASSERT_EQ(found.list.size(), 4U);
  const double column = 1000 * dx * cross_section(dim);
  EXPECT_NEAR(found.list[0].mass / column, 11, 1e-12) << "the heaviest first";
  EXPECT_NEAR(found.list[1].mass / column, 7, 1e-12);
  EXPECT_NEAR(found.list[2].mass / column, 1.8, 1e-12);
  EXPECT_FALSE(found.list[2].piece);
  EXPECT_EQ(found.list[2].failed, found.list[2].mass);
  EXPECT_NEAR(found.list[2].volume / (2 * dx * cross_section(dim)), 0.9, 1e-9) << "without its voids";
  EXPECT_EQ(found.heaviest, (std::vector{0, 3}));
  double sum = 0;
  for (const auto& f : found.list) sum += f.body == 0 ? f.mass : 0;
  EXPECT_NEAR(sum / find_totals(state, parallel::World{}).bodies[0].mass, 1, 1e-12);
}

/// What stands in a crack that has opened goes to one side; so does a sliver of whole matter at a surface.
TYPED_TEST(FragmentsOf, OpenCracksPart) {
  constexpr int dim = TestFixture::dim;
  const double column = 1000 * dx * cross_section(dim);
  State<dim> cracked = bar<dim>(9), gaping = bar<dim>(9);
  change<dim>(cracked, 2.4 * mm, 2.6 * mm, open_crack<dim>);
  change<dim>(gaping, 2.4 * mm, 2.8 * mm, make_sliver<dim>);
  const auto one = find_fragments(cracked, parallel::World{}),
             other = find_fragments(gaping, parallel::World{});
  ASSERT_EQ(one.list.size(), 3U);
  EXPECT_NEAR(one.list[0].mass / column, 12, 1e-12);
  EXPECT_NEAR(one.list[1].mass / column, 7.3, 1e-12);
  ASSERT_EQ(other.list.size(), 3U);
  EXPECT_NEAR(other.list[0].mass / column, 11.3, 1e-12);
  EXPECT_NEAR(other.list[1].mass / column, 7.3, 1e-12);
  EXPECT_NEAR(other.list[1].highest[0], 2.4 * mm + 0.3 * dx, 1e-9) << "the surface in the sliver's cell";
}

/// Failed matter that is pressed together holds, and a crack that does not go through parts nothing.
TYPED_TEST(FragmentsOf, WhatIsNotPartedHolds) {
  constexpr int dim = TestFixture::dim;
  State<dim> pressed = bar<dim>(9), notched = bar<dim>(9);
  change<dim>(pressed, 2.4 * mm, 2.8 * mm, [](auto& b, std::size_t k) { thin(b, k, 1.01, 1, 0, true); });
  EXPECT_EQ(find_fragments(pressed, parallel::World{}).list.size(), 2U);
  if (dim == 1) return;
  bool first = true;
  change<dim>(notched, 2.4 * mm, 2.6 * mm, [&](auto& b, std::size_t k) {
    if (!std::exchange(first, false)) open_crack(b, k);
  });
  EXPECT_EQ(find_fragments(notched, parallel::World{}).list.size(), 2U) << "a ligament is left";
}

TYPED_TEST(FragmentsOf, EqualOnesAreOrderedByPlace) {
  constexpr int dim = TestFixture::dim;
  State<dim> state = bar<dim>(9);
  change<dim>(state, 2.8 * mm, 3.2 * mm, make_rubble<dim>);
  const auto found = find_fragments(state, parallel::World{});
  ASSERT_EQ(found.list.size(), 4U);
  EXPECT_NEAR(found.list[0].mass / found.list[1].mass, 1, 1e-12);
  if (found.list[0].mass == found.list[1].mass) {
    EXPECT_LT(found.list[0].first, found.list[1].first);
  }
}

/// A gap four cells wide through a body whose cells are of three sizes.
TYPED_TEST(FragmentsOf, LevelsMeet) {
  constexpr int dim = TestFixture::dim;
  if (dim == 3) GTEST_SKIP() << "as in a plane, at more cost";
  const int cells = dim == 1 ? 512 : 208;
  config::Case c;
  config::Vector lo{}, hi{}, low{}, high{};
  for (std::size_t d = 0; d < dim; ++d) lo[d] = -24 * dx, hi[d] = (cells + 24) * dx, high[d] = cells * dx;
  c.domain = domain_of(dim == 1 ? config::Geometry::line : config::Geometry::planar, lo, hi);
  c.mesh.finest = dx, c.mesh.levels = 3, c.mesh.block = dim == 1 ? 16 : 8;
  c.bodies = {body_of("block", box_shape(low, high))};
  start_parallel();
  State<dim> state = make_state<dim>(c, {hard_matter()}, parallel::World{});
  int widest = 0;
  for (int s = 0; s < state.mesh.local(); ++s) widest = std::max(widest, state.mesh.block(s).level);
  EXPECT_EQ(widest, 2);
  const auto whole = find_fragments(state, parallel::World{});
  ASSERT_EQ(whole.list.size(), 1U);
  change<dim>(state, 100 * dx, 104 * dx, [](auto& b, std::size_t k) { thin(b, k, 0, 0, 0, false); });
  const auto found = find_fragments(state, parallel::World{});
  ASSERT_EQ(found.list.size(), 2U);
  EXPECT_NEAR(found.list[0].mass / whole.list[0].mass, (cells - 104.0) / cells, 1e-12);
  EXPECT_NEAR(found.list[1].mass / whole.list[0].mass, 100.0 / cells, 1e-12);
  EXPECT_GT(found.list[0].first, found.list[1].first) << "the heavier one is behind";
}

/// Run by mpirun with several processes; the blocks of two sizes are shared out differently.
template <class D>
struct MpiFragments : testing::Test {
  static constexpr int dim = D::value;
  void SetUp() override {
    if (!several_processes()) GTEST_SKIP() << "for mpirun";
  }
};
TYPED_TEST_SUITE(MpiFragments, Dimensions);

TYPED_TEST(MpiFragments, DoNotDependOnBlocksAndProcesses) {
  constexpr int dim = TestFixture::dim;
  const parallel::World world;
  std::vector<Fragment<dim>> first;
  for (const int block : {9, 10, 14}) {
    State<dim> state = bar<dim>(block);
    change<dim>(state, 2.4 * mm, 2.8 * mm, make_rubble<dim>);
    change<dim>(state, 3.8 * mm, 4.0 * mm, open_crack<dim>);
    const auto found = find_fragments(state, world);
    EXPECT_EQ(found.heaviest.size(), 2U);
    if (world.rank() != 0) continue;
    ASSERT_EQ(found.list.size(), 5U);
    const double column = 1000 * dx * cross_section(dim);
    EXPECT_NEAR(found.list[0].mass / column, 7, 1e-12);
    EXPECT_NEAR(found.list[1].mass / column, 5.3, 1e-12);
    EXPECT_NEAR(found.list[2].mass / column, 5, 1e-12);
    if (first.empty()) first = found.list;
    for (std::size_t k = 0; k < first.size(); ++k) {
      EXPECT_EQ(found.list[k].first, first[k].first);
      EXPECT_EQ(found.list[k].mass, first[k].mass);
      EXPECT_EQ(found.list[k].kinetic, first[k].kinetic);
      EXPECT_EQ(found.list[k].position, first[k].position);
      EXPECT_EQ(found.list[k].highest, first[k].highest);
    }
  }
}

}  // namespace
}  // namespace recoil::fragments_test
