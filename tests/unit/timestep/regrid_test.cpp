#include "timestep/regrid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "../core/dimensions.hpp"
#include "../support/sanitized.hpp"
#include "dynamics/inadmissible.hpp"
#include "run.hpp"
#include "timestep/phases.hpp"

namespace recoil::regrid_test {
namespace {

using config::Boundary;
using config::Geometry;

constexpr double mm = 1e-3;

template <int Dim>
constexpr Geometry geometry() {
  return Dim == 1 ? Geometry::line : Dim == 2 ? Geometry::planar : Geometry::space;
}

/// A block of aluminium in empty space on a mesh of three levels.
template <int Dim>
config::Case block_of_matter(double dx) {
  config::Vector lo{}, hi{}, low{}, high{};
  const int cells = Dim == 1 ? 512 : Dim == 2 ? 208 : 96;
  for (std::size_t d = 0; d < Dim; ++d)
    lo[d] = -24 * dx, hi[d] = (cells + 24) * dx, low[d] = 0, high[d] = (cells + 0.3) * dx;
  auto c = case_of(domain_of(geometry<Dim>(), lo, hi, Boundary::outflow), dx,
                   {body_of("block", box_shape(low, high))});
  c.mesh.levels = 3;
  c.mesh.block = Dim == 1 ? 16 : 8;
  return c;
}

/// Contents per volume of a component: linear in space.
template <int Dim>
double linear(std::size_t component, const Vec<Dim>& x) {
  double v = 2700.0 * (1 + 0.1 * static_cast<double>(component));
  for (int d = 0; d < Dim; ++d) v += (40.0 + 10 * d - 3.0 * static_cast<double>(component)) * x[d] / mm;
  return v;
}

template <int Dim>
void make_linear(State<Dim>& state) {
  for (int s = 0; s < state.mesh.local(); ++s) {
    auto& b = state.bodies[0].at(s);
    if (!b.present) continue;
    const Box<Dim> cells = state.mesh.block(s).cells;
    const std::size_t n = b.volume.size();
    for_each(cells, [&](const Index<Dim>& i) {
      const auto k = static_cast<std::size_t>(state.grid().layout().at(i - cells.lo));
      for (std::size_t c = 0; c < Components<Dim>::contents; ++c)
        b.contents[c * n + k] = b.volume[k] * linear<Dim>(c, state.grid(s).centre(i));
    });
  }
}

template <int Dim>
double largest_error(const State<Dim>& state) {
  double worst = 0;
  for (int s = 0; s < state.mesh.local(); ++s) {
    const auto& b = state.bodies[0].at(s);
    if (!b.present) continue;
    const Box<Dim> cells = state.mesh.block(s).cells;
    const std::size_t n = b.volume.size();
    for_each(cells, [&](const Index<Dim>& i) {
      const auto k = static_cast<std::size_t>(state.grid().layout().at(i - cells.lo));
      for (std::size_t c = 0; c < Components<Dim>::contents; ++c) {
        const double exact = linear<Dim>(c, state.grid(s).centre(i));
        if (b.volume[k] > 0)
          worst = std::max(worst, std::abs(b.contents[c * n + k] / b.volume[k] / exact - 1));
      }
    });
  }
  return worst;
}

template <int Dim>
int coarsest(const Mesh<Dim>& mesh) {
  int level = 0;
  for (int s = 0; s < mesh.local(); ++s) level = std::max(level, mesh.block(s).level);
  return level;
}

template <class D>
struct Regrid : testing::Test {
  static constexpr int dim = D::value;
};
TYPED_TEST_SUITE(Regrid, Dimensions);

/// Random levels, of which those near surfaces are the finest.
template <int Dim>
std::vector<int> random_levels(const State<Dim>& state, bool coarser, std::mt19937& random) {
  std::vector<int> wanted;
  for (int s = 0; s < state.mesh.local(); ++s) {
    bool near = state.bodies[0].present(s) && state.bodies[0].at(s).near_surface;
    state.mesh.for_each_adjacent(
        s, [&](int q) { near = near || (state.bodies[0].present(q) && state.bodies[0].at(q).near_surface); });
    const int level = state.mesh.block(s).level;
    const bool changes = random() % 100 < (coarser ? 95 : 20);
    wanted.push_back(near       ? 0
                     : !changes ? level
                     : coarser  ? std::min(level + 1, state.mesh.levels() - 1)
                                : std::max(level - 1, 0));
  }
  return wanted;
}

TYPED_TEST(Regrid, RandomLevelsKeepSumsAndLinearFields) {
  constexpr int dim = TestFixture::dim;
  TestRun<dim> run(block_of_matter<dim>(0.1 * mm), {samples::aluminium()});
  make_linear(run.state);
  StepRun<dim> step(run.state, run.engine);
  update_bands(step);
  const auto before = run.totals(0);
  std::mt19937 random(1);
  int changes = 0, highest = 0;
  const int rounds = dim == 3 ? (sanitized ? 2 : 8) : (sanitized ? 60 : 1000);
  for (int round = 0; round < rounds; ++round) {
    changes += adapt(run.state, run.engine, random_levels(run.state, round % 6 != 0, random)) ? 1 : 0;
    highest = std::max(highest, coarsest(run.state.mesh));
  }
  EXPECT_GT(changes, 3 * rounds / 10);
  EXPECT_EQ(highest, dim == 3 ? 1 : 2);
  EXPECT_LT(largest_error(run.state), 1e-11);
  const auto after = run.totals(0);
  for (std::size_t c = 0; c < before.size(); ++c) EXPECT_NEAR(after[c] / before[c], 1, 1e-12) << c;
  EXPECT_EQ(run.counted().flat_refinements, 0);
}

/// 1 mm of aluminium at 400 m/s on 6 mm, along the last axis.
template <int Dim>
config::Case plates(int levels, double dx) {
  config::Vector lo{}, hi{}, u{};
  const std::size_t e = Dim - 1;
  for (std::size_t d = 0; d < Dim; ++d) hi[d] = 4 * dx;
  lo[e] = -2 * mm, hi[e] = 8 * mm, u[e] = 400;
  auto domain = domain_of(geometry<Dim>(), lo, hi, Boundary::symmetry);
  domain.boundary[e] = {Boundary::outflow, Boundary::outflow};
  auto low = lo, high = hi;
  low[e] = -1 * mm, high[e] = 0;
  auto c = case_of(domain, dx, {body_of("flyer", box_shape(low, high), u)});
  low[e] = 0, high[e] = 6 * mm;
  c.bodies.push_back(body_of("target", box_shape(low, high)));
  c.mesh.levels = levels;
  c.mesh.block = 16;
  return c;
}

template <int Dim>
int run_to(TestRun<Dim>& run, double end, const Refinement<Dim>& rules) {
  int changes = 0;
  while (run.state.time < end) {
    changes += regrid(run.state, run.engine, rules) ? 1 : 0;
    advance(run.state, run.stepping, end, run.engine);
  }
  return changes;
}

TYPED_TEST(Regrid, PlatesAreAsOnTheFinestMesh) {
  constexpr int dim = TestFixture::dim;
  const double dx = dim == 1 ? 0.025 * mm : 0.05 * mm, end = dim == 1 ? 0.8e-6 : dim == 2 ? 0.3e-6 : 0.12e-6;
  const std::vector<Material> materials{samples::aluminium(), samples::aluminium()};
  for (const auto stages : {StepStages::one, StepStages::three}) {
    if (dim == 3 && stages == StepStages::three) continue;  // as in 2-D, and slow
    TestRun<dim> fine(plates<dim>(1, dx), materials), refined(plates<dim>(3, dx), materials);
    fine.stepping.stages = refined.stepping.stages = stages;
    run_to(fine, end, {});
    EXPECT_GT(run_to(refined, end, {}), 0);
    EXPECT_GT(coarsest(refined.state.mesh), 0);
    EXPECT_LT(refined.imbalance(0, 400), 1e-12);
    EXPECT_LT(refined.imbalance(1, 400), 1e-12);
    const std::size_t along = Components<dim>::u + dim - 1;
    const auto exact = fine.totals(1), found = refined.totals(1);
    EXPECT_NEAR(found[along] / exact[along], 1, 1e-3);
    EXPECT_NEAR(found[Components<dim>::energy] / exact[Components<dim>::energy], 1, 1e-3);
  }
}

TYPED_TEST(Regrid, ThreadsGiveTheSameBits) {
  constexpr int dim = TestFixture::dim;
  const double dx = 0.05 * mm;
  const std::vector<Material> materials{samples::aluminium(), samples::aluminium()};
  TestRun<dim> one(plates<dim>(3, dx), materials), three(plates<dim>(3, dx), materials, 3);
  EXPECT_GT(run_to(one, dim == 1 ? 0.8e-6 : 0.12e-6, {}), 0);
  run_to(three, dim == 1 ? 0.8e-6 : 0.12e-6, {});
  ASSERT_EQ(one.state.mesh.local(), three.state.mesh.local());
  for (int s = 0; s < one.state.mesh.local(); ++s)
    for (int m = 0; m < 2; ++m)
      EXPECT_EQ(one.state.bodies[m].at(s).contents, three.state.bodies[m].at(s).contents);
}

/// Coarsens everything that is not near a surface.
template <int Dim>
void coarsen(TestRun<Dim>& run) {
  Refinement<Dim> rules;
  rules.bend = 1e9;
  while (regrid(run.state, run.engine, rules)) {
  }
}

template <int Dim>
std::vector<double> contents_of(const State<Dim>& state, int slot) {
  return state.bodies[1].at(slot).contents.raw();
}

/// A state that no equation of state knows, in a coarser block right beside finer ones: it is averaged with
/// cells of its own level alone, nothing is lost, and all threads find the same.
TYPED_TEST(Regrid, BadStatesBesideOtherLevelsAreAveragedAmongEquals) {
  constexpr int dim = TestFixture::dim;
  const auto bad = [](auto& run, bool compressed) {
    const auto& mesh = run.state.mesh;
    for (int s = 0; s < mesh.local(); ++s)
      for (int side = 0; side < 2; ++side) {
        if (mesh.block(s).level == 0 || !run.state.bodies[1].present(s) ||
            mesh.finer_across(s, dim - 1, side)[0] < 0)
          continue;
        const Box<dim> cells = mesh.block(s).cells;
        Index<dim> at{};  // beside the finer block
        if (side == 1) at[dim - 1] = cells.extent(dim - 1) - 1;
        const auto k = static_cast<std::size_t>(mesh.grid().layout().at(at));
        run.state.bodies[1].at(s).contents[k] *= compressed ? 3 : 0.2;
        return s;
      }
    return -1;
  };
  const std::vector<Material> materials{samples::aluminium(), samples::aluminium()};
  for (const bool compressed : {true, false}) {
    TestRun<dim> one(plates<dim>(3, 0.05 * mm), materials), three(plates<dim>(3, 0.05 * mm), materials, 3);
    for (TestRun<dim>* run : {&one, &three}) {
      coarsen(*run);
      const std::vector<std::vector<double>> old = [&] {
        std::vector<std::vector<double>> all;
        for (int s = 0; s < run->state.mesh.local(); ++s) all.push_back(contents_of(run->state, s));
        return all;
      }();
      const int slot = bad(*run, compressed);
      ASSERT_GE(slot, 0);
      const auto before = run->totals(1);
      StepRun<dim> step(run->state, run->engine);
      step.has_changed(FieldSet::all());
      average_inadmissible_states(step);
      EXPECT_GE(run->counted().averaged_states, 1);
      EXPECT_LE(run->counted().averaged_states, 3);  // in wider and wider windows, until it is admissible
      const auto after = run->totals(1);
      for (std::size_t c = 0; c < before.size(); ++c)
        EXPECT_NEAR(after[c], before[c], 1e-13 * std::abs(before[c])) << c;
      for (int s = 0; s < run->state.mesh.local(); ++s) {
        if (!run->state.bodies[1].present(s)) continue;
        Counters counters;
        EXPECT_EQ(mark_inadmissible(run->state, run->state.bodies[1], s, counters), 0);
        if (run->state.mesh.block(s).level == 0) {
          EXPECT_EQ(contents_of(run->state, s), old[static_cast<std::size_t>(s)]);
        }
      }
      EXPECT_NE(contents_of(run->state, slot), old[static_cast<std::size_t>(slot)]);
    }
    for (int s = 0; s < one.state.mesh.local(); ++s)
      EXPECT_EQ(contents_of(one.state, s), contents_of(three.state, s));
  }
}

/// Blocks that irregular kernels cannot reach from a surface may be coarser, even beside one that is near it;
/// those that they can reach are the finest.
TYPED_TEST(Regrid, FinestCellsReachElevenAroundASurface) {
  constexpr int dim = TestFixture::dim;
  if (dim == 3) GTEST_SKIP() << "as in 2-D";
  constexpr double dx = 0.05 * mm;
  bool coarser_beside_near = false;
  for (int shift = 0; shift < 32; shift += 3) {
    auto c = plates<dim>(3, dx);
    c.domain.lo[dim - 1] -= shift * dx;
    TestRun<dim> run(c, {samples::aluminium(), samples::aluminium()});
    coarsen(run);
    const auto& mesh = run.state.mesh;
    for (int s = 0; s < mesh.local(); ++s)
      for (const auto& body : run.state.bodies) {
        if (!body.present(s) || !body.at(s).near_surface) continue;
        ASSERT_EQ(mesh.block(s).level, 0);
        const Window<dim> w(mesh, s, widest_halo);
        coarser_beside_near = coarser_beside_near || !mesh.is_among_equals(s);
        for_each(mesh.block(s).cells, [&](const Index<dim>& i) {
          const auto k = static_cast<std::size_t>(w.cell(i));
          if (std::abs(body.at(s).phi[k]) > dx) return;
          for (int o = -widest_halo; o <= widest_halo; ++o) {
            Index<dim> j = i;
            j[dim - 1] += o;
            const int from = w.source(j).slot;
            EXPECT_FALSE(from >= 0 && mesh.is_stand_in(from))
                << "shift " << shift << ", " << o << " cells away";
          }
        });
      }
  }
  EXPECT_TRUE(coarser_beside_near);
}

}  // namespace
}  // namespace recoil::regrid_test
