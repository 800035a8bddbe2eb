#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "../support/scratch_folder.hpp"
#include "../support/small_case.hpp"
#include "format/csv.hpp"
#include "gauge/contact_fields.hpp"
#include "gauge/kind/contact_gauge.hpp"
#include "record/field_dump.hpp"
#include "record/recorder.hpp"
#include "timestep/step.hpp"

namespace recoil::contact_gauge_test {
namespace {

/// Elastic plates of 1 mm, turned by 30 degrees, that meet at 20 m/s across and slide at 10 m/s along.
const char* turned = R"(
format = 1
[domain]
geometry = "planar"
x = ["-2 mm", "2 mm"]
y = ["-2 mm", "2 mm"]
[mesh]
finest = "0.1 mm"
[time]
end = "0.3 us"
[body.wall]
rigid = true
shape = { kind = "disc", centre = { x = "-1.8 mm", y = "1.8 mm" }, radius = "0.1 mm" }
[body.target]
material = "none"
shape = { kind = "box", x = ["0 mm", "1 mm"], y = ["-1.5 mm", "1.5 mm"], rotation = "30 deg", centre = { x = "0 mm" } }
[body.flyer]
material = "none"
shape = { kind = "box", x = ["-1 mm", "0 mm"], y = ["-1.5 mm", "1.5 mm"], rotation = "30 deg", centre = { x = "0 mm" } }
velocity = { x = "12.3205081 m/s", y = "18.6602540 m/s" }
[gauge.all]
kind = "contact"
pair = "flyer-target"
direction = { x = 0.8660254, y = 0.5 }
[gauge.middle]
kind = "contact"
pair = "flyer-target"
at = { x = "0 mm", y = "0 mm" }
radius = "0.7 mm"
direction = { x = -0.5, y = 0.8660254 }
)";

struct Impact {
  ScratchFolder folder;
  config::Case case_ = case_from(turned);
  State<2> state = state_of<2>(case_);
  parallel::World world;
  parallel::Team team{1};

  Impact() {
    Engine engine{world, team, {}};
    prepare_start(state, engine);
    Recorder<2> recorder(case_, state, world, folder.path(), &team);
    recorder.begin(state);
    while (state.time < case_.time.end * (1 - 1e-12)) {
      const double dt = advance(state, {case_.time.cfl, case_.time.fixed_dt}, case_.time.end, engine);
      recorder.after_step(state, dt);
    }
    recorder.finish(state, {.version = "test", .exit = 0, .wall_s = 1, .expect = {}});
  }
};

TEST(ContactGauge, OfTheWholeAndOfAPart) {
  const Impact run;
  const CsvTable all = read_csv(run.folder / "gauges/all.csv"),
                 middle = read_csv(run.folder / "gauges/middle.csv");
  // Later rows feel the release from the edges in the middle as well: row 20 has -0.0488 GPa there.
  // Impedance 5e6: 50 MPa and 3 mm of contact push the flyer back along (-0.866, -0.5).
  EXPECT_EQ(all.unit("normal-impulse"), "kg/s");
  EXPECT_NEAR(all.numbers("traction")[14], -0.05, 0.006) << "the edges are released";
  EXPECT_NEAR(middle.numbers("traction")[14], -0.05, 0.001);
  EXPECT_NEAR(middle.numbers("velocity")[14], 10, 0.3);
  EXPECT_EQ(middle.unit("traction-scatter"), "GPa");
  EXPECT_GT(middle.numbers("traction-scatter")[14], 0);
  EXPECT_LT(middle.numbers("traction-scatter")[14], 0.001);
  EXPECT_GT(all.numbers("traction-scatter")[14], 0.002) << "the released edges";
  EXPECT_NEAR(middle.numbers("area").back(), 1.4e-3, 0.15e-3) << "to a cell at each end";
  EXPECT_LT(middle.numbers("widest-gap-in-cells").back(), 0.1);
  EXPECT_GT(middle.numbers("deepest-overlap-in-cells").back(), -0.1);
  for (const char* gap : {"gap", "widest-gap", "deepest-overlap"}) EXPECT_EQ(middle.unit(gap), "mm");
  for (const std::string gap : {"widest-gap", "deepest-overlap"}) {
    EXPECT_EQ(middle.unit(gap + "-in-cells"), "1");
    for (std::size_t k = 1; k < 21; ++k)
      EXPECT_NEAR(middle.numbers(gap)[k], 0.1 * middle.numbers(gap + "-in-cells")[k], 1e-9) << gap;
  }
  const auto x = all.numbers("impulse.x"), y = all.numbers("impulse.y"), along = all.numbers("impulse.along"),
             normal = all.numbers("normal-impulse");
  EXPECT_NEAR(along.back(), -0.045, 0.004) << "50 MPa on 3 mm for 0.3 us";
  for (std::size_t k = 1; k < x.size(); ++k) {
    EXPECT_NEAR(along[k], 0.8660254 * x[k] + 0.5 * y[k], 1e-6 * std::abs(x[k]));
    EXPECT_NEAR(normal[k], -along[k], 0.02 * std::abs(along[k]) + 1e-4);
  }
  // No friction: the part's impulse along the surface is far below that across it.
  EXPECT_LT(std::abs(middle.numbers("impulse.along").back()), 0.01 * middle.numbers("normal-impulse").back());
  EXPECT_LT(middle.numbers("friction").back(), 1e-9);
  const double share = middle.numbers("normal-impulse").back() / normal.back();
  EXPECT_GT(share, 1.4 / 3);
  EXPECT_LT(share, 0.7);
  EXPECT_NEAR(middle.numbers("work").back(), 10 * -middle.numbers("normal-impulse").back(),
              0.05 * 10 * middle.numbers("normal-impulse").back());
}

TEST(ContactGauge, APartGoesOnAcrossTheEdgeOfAPeriod) {
  std::string periodic = turned;
  const std::string sides = "y = [\"-2 mm\", \"2 mm\"]";
  periodic.replace(periodic.find(sides), sides.size(), sides + "\nboundary = { y = \"periodic\" }");
  State<2> state = state_of<2>(case_from(periodic));
  for (const double y : {-1.95e-3, 1.95e-3, 0.0}) {
    Contact<2>& c = state.contacts[0].emplace_back();
    c.first = 1, c.second = 2;
    c.point = {{0, y}};
    c.area = 1e-4;
  }
  ExactSums sums;
  const int item = sums.item(ContactSums<2>::sums, 2);
  probe_contact<2>(state, pair_number(1, 2, 3), {{0, 2e-3}}, 0.1e-3, item, sums);
  sums.reduce(parallel::World{});
  EXPECT_DOUBLE_EQ(sums.total(item)[ContactSums<2>::area], 2e-4) << "on both sides of the edge";
}

std::vector<double> column(const UnstructuredGrid& grid, const char* name) {
  return as_doubles(find_array(grid, name).values);
}

TEST(ContactFields, ShowWhereBodiesTouch) {
  const Impact run;
  const UnstructuredGrid grid = gather_fields(run.state, run.world, field_variables());
  const auto state = column(grid, "contact_state"), gap = column(grid, "gap_mm"),
             traction = column(grid, "contact_traction_GPa"), bits = column(grid, "contact");
  int slipping = 0, free = 0, opened = 0;
  for (std::size_t k = 0; k < grid.cells(); ++k) {
    const double cx = 0.5 * (grid.points[3 * static_cast<std::size_t>(grid.connectivity[4 * k])] +
                             grid.points[3 * static_cast<std::size_t>(grid.connectivity[4 * k + 2])]);
    const double cy = 0.5 * (grid.points[3 * static_cast<std::size_t>(grid.connectivity[4 * k]) + 1] +
                             grid.points[3 * static_cast<std::size_t>(grid.connectivity[4 * k + 2]) + 1]);
    if (std::isnan(state[k])) {
      EXPECT_TRUE(std::isnan(traction[k]));
      continue;
    }
    const double across = 0.8660254 * cx + 0.5 * cy, along = -0.5 * cx + 0.8660254 * cy;
    EXPECT_NE(state[k], 1) << "the plates slide everywhere";
    EXPECT_EQ(bits[k] != 0, state[k] == 2);
    slipping += state[k] == 2;
    free += state[k] == 0;
    opened += state[k] == 3;
    if (std::abs(along) < 0.9e-3 && std::abs(across) < 0.2e-3) {
      EXPECT_EQ(state[k], 2);
      EXPECT_NEAR(gap[k], 0, 0.01);
      EXPECT_NEAR(traction[k], -0.05, 0.003);
    }
    if (std::abs(along) < 0.9e-3 && std::abs(across) > 0.5e-3) {
      EXPECT_EQ(state[k], 0);
      EXPECT_EQ(traction[k], 0);
    }
  }
  EXPECT_GT(slipping, 20);
  EXPECT_GT(free, 40);
  EXPECT_LT(opened, 10) << "only the released rims";
}

TEST(ContactFields, SurfacesThatPartedAreOpened) {
  Impact run;
  const std::vector<std::uint32_t> touched = have_touched(run.state, run.world);
  EXPECT_EQ(touched, (std::vector<std::uint32_t>{0U, 4U, 2U})) << "the disc far away has touched nothing";
  for (ContactList<2>& list : run.state.contacts) list.clear();
  int opened = 0, other = 0;
  for (int slot = 0; slot < run.state.mesh.local(); ++slot) {
    const BodyBlock<2>& b = run.state.bodies[1].at(slot);
    if (!b.present) continue;
    for (const CutCell<2>& cut : b.geometry.cuts) {
      const double across = 0.8660254 * cut.point[0] + 0.5 * cut.point[1],
                   along = -0.5 * cut.point[0] + 0.8660254 * cut.point[1];
      if (std::abs(along) > 1e-3) continue;
      const ContactState s = surface_contact(run.state, slot, 1, cut.cell, touched[1]).state;
      EXPECT_EQ(s, across < 0.5e-3 ? ContactState::opened : ContactState::free);
      opened += s == ContactState::opened;
      other += s == ContactState::free;
      EXPECT_EQ(surface_contact(run.state, slot, 1, cut.cell, 0U).state, ContactState::free);
    }
  }
  EXPECT_GT(opened, 10);
  EXPECT_GT(other, 10);
}

}  // namespace
}  // namespace recoil::contact_gauge_test
