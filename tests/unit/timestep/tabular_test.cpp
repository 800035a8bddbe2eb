#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "run.hpp"

namespace recoil::tabular_test {
namespace {

using config::Boundary;
using config::Geometry;

constexpr double mm = 1e-3;

Material copper_by_energy() {
  Material m = samples::copper();
  m.thermal.rule = Thermal::Rule::energy;
  return m;
}

/// 1 mm of copper at 600 m/s on 2 mm of it, until the rear surface has moved and the release runs.
config::Case plates() {
  return case_of(domain_of(Geometry::line, vector_of(-1.5 * mm), vector_of(3.5 * mm)), 0.025 * mm,
                 {body_of("flyer", box_shape(vector_of(-1 * mm), vector_of(0)), vector_of(600)),
                  body_of("target", box_shape(vector_of(0), vector_of(2 * mm)))});
}

/// Velocities of the target's cells [m/s].
std::vector<double> velocities(const TestRun<1>& run) {
  std::vector<double> u;
  for (const auto& b : run.state.bodies[1].blocks)
    for (std::size_t k = 0; k < b.volume.size(); ++k)
      if (b.volume[k] > 0.5 * run.state.grid().dx)
        u.push_back(b.contents[b.volume.size() + k] / b.contents[k]);
  return u;
}

/// The same plates of tabulated and of analytic copper: the difference falls with the table's resolution.
TEST(Tabular, PlatesMoveAsThoseOfWhatIsTabulated) {
  const Material exact = copper_by_energy();
  TestRun<1> reference(plates(), {exact, exact});
  reference.steps(150);
  const std::vector<double> expected = velocities(reference);
  double before = 1e9;
  for (const int n : {31, 61, 241}) {
    Material table = exact;
    table.eos = samples::tabulated(exact, {.least = 0.7, .most = 1.6, .densities = n, .temperatures = 8});
    TestRun<1> run(plates(), {table, table});
    run.steps(150);
    const std::vector<double> got = velocities(run);
    ASSERT_EQ(got.size(), expected.size());
    double mean = 0;
    for (std::size_t k = 0; k < got.size(); ++k) mean += std::abs(got[k] - expected[k]);
    mean /= static_cast<double>(got.size());
    EXPECT_LT(mean, before / 2) << n;
    before = mean;
    EXPECT_LT(run.imbalance(1, 600), 1e-11);
    EXPECT_EQ(run.counted().averages_kept, 0);
  }
  EXPECT_LT(before, 0.6) << "m/s, of 600";
}

}  // namespace
}  // namespace recoil::tabular_test
