/// Gauges of kind body on rigid bodies.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "../support/small_case.hpp"
#include "gauge/gauge_watch.hpp"

namespace recoil::body_gauge_test {
namespace {

/// What the only gauge of a case records of its start, by the names of the columns.
template <int Dim>
struct FirstRow {
  explicit FirstRow(const std::string& text) {
    const config::Case c = case_from(text);
    const State<Dim> state = state_of<Dim>(c);
    const parallel::World world;
    ExactSums sums;
    const RunUnits units = run_units(c.domain.geometry);
    columns = column_list(config::written_columns(c.gauges.front()), units);
    const Totals<Dim> totals = find_totals(state, world);
    const auto& kind = std::get<config::BodyGauge>(c.gauges.front().kind);
    const auto watch = make_watch<Dim>(kind, WatchSetup<Dim>{c, state, sums});
    watch->collect(state, world, true, sums);
    watch->read({0, 0, sums, {}, &totals, units}, row);
    EXPECT_EQ(row.size(), columns.size());
  }
  double operator[](const std::string& name) const {
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (columns[k].name == name) return row[k];
    ADD_FAILURE() << "no column " << name;
    return 0;
  }
  std::vector<SeriesColumn> columns;
  std::vector<double> row;
};

std::string case_of(const std::string& rigid, const std::string& boundary = "") {
  return R"(
format = 1
[domain]
geometry = "planar"
x = ["-6 mm", "6 mm"]
y = ["-6 mm", "6 mm"]
)" + boundary +
         R"(
[mesh]
finest = "0.2 mm"
[time]
end = "1 us"
[body.disc]
material = "none"
shape = { kind = "disc", radius = "2 mm" }
[gauge.wall]
kind = "body"
body = "wall"
[body.wall]
rigid = true
shape = { kind = "box", x = ["-4 mm", "-2.5 mm"], y = ["-2 mm", "3 mm"] }
velocity = { x = "200 m/s" }
)" + rigid;
}

TEST(BodyGauge, OfAPrescribedRigidBody) {
  const FirstRow<2> row(case_of("spin = \"1000 rad/s\"\nspin-centre = { x = \"-3.25 mm\", y = \"0 mm\" }"));
  EXPECT_NEAR(row["position.x"], -3.25e-3, 1e-9);
  EXPECT_NEAR(row["position.y"], 0.5e-3, 1e-9);
  EXPECT_NEAR(row["velocity.x"], 200 - 1000 * 0.5e-3, 1e-6);
  EXPECT_NEAR(row["velocity.y"], 0, 1e-6);
  EXPECT_NEAR(row["lowest.x"], -4e-3, 1e-9);
  EXPECT_NEAR(row["highest.y"], 3e-3, 1e-9);
  EXPECT_EQ(row["spin"], 1000);
  for (const char* name : {"mass", "kinetic", "internal", "plastic-strain", "failed-mass"})
    EXPECT_TRUE(std::isnan(row[name])) << name << ": it has no mass";
}

TEST(BodyGauge, OfAFreeRigidBody) {
  const FirstRow<2> row(case_of("mass = \"10 kg/m\""));
  EXPECT_NEAR(row["position.x"], -3.25e-3, 1e-9);
  EXPECT_NEAR(row["position.y"], 0.5e-3, 1e-9);
  EXPECT_DOUBLE_EQ(row["velocity.x"], 200);
  EXPECT_NEAR(row["highest.x"], -2.5e-3, 1e-9);
  EXPECT_DOUBLE_EQ(row["mass"], 10);
  EXPECT_EQ(row["spin"], 0);
}

TEST(BodyGauge, ARigidBodyHasNoPlaceAlongAPeriodicAxis) {
  for (const char* mass : {"", "mass = \"10 kg/m\""}) {
    const FirstRow<2> row(case_of(mass, "boundary = { x = \"periodic\" }"));
    EXPECT_TRUE(std::isnan(row["position.x"]) && std::isnan(row["lowest.x"]) && std::isnan(row["highest.x"]));
    EXPECT_NEAR(row["position.y"], 0.5e-3, 1e-9);
    EXPECT_DOUBLE_EQ(row["velocity.x"], 200);
  }
}

/// Deformable bodies have no spin: how they turn is told by a gauge of kind attitude.
TEST(BodyGauge, OnlyRigidBodiesHaveASpin) {
  const config::Case c = case_from(case_of("[gauge.disc]\nkind = \"body\"\nbody = \"disc\"\n"));
  const RunUnits units = run_units(c.domain.geometry);
  ASSERT_EQ(c.gauges.size(), 2U);
  EXPECT_EQ(column_list(config::written_columns(c.gauges[0]), units).back().name, "spin");
  EXPECT_EQ(column_list(config::written_columns(c.gauges[1]), units).back().name, "failed-mass");
}

}  // namespace
}  // namespace recoil::body_gauge_test
