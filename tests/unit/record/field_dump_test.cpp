#include "record/field_dump.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "../support/scratch_folder.hpp"
#include "../support/small_case.hpp"
#include "core/error.hpp"
#include "picture/field_plane.hpp"
#include "record/rigid_places.hpp"

namespace recoil::field_dump_test {
namespace {

const char* disc = R"(
format = 1
[domain]
geometry = "planar"
x = ["-10 mm", "10 mm"]
y = ["-8 mm", "8 mm"]
[mesh]
finest = "0.25 mm"
[time]
end = "1 us"
[body.disc]
material = "none"
shape = { kind = "cylinder", centre = { x = "1 mm", y = "0 mm" }, radius = "4 mm" }
velocity = { x = "300 m/s", y = "-400 m/s" }
[body.wall]
rigid = true
shape = { kind = "box", x = ["-10 mm", "10 mm"], y = ["-9 mm", "-5 mm"] }
)";

std::vector<double> column(const UnstructuredGrid& grid, const char* name) {
  return as_doubles(find_array(grid, name).values);
}

TEST(FieldDump, HoldsMatterAndSurfaces) {
  const config::Case c = case_from(disc);
  const State<2> state = state_of<2>(c);
  const UnstructuredGrid grid = gather_fields(state, parallel::World{}, field_variables());
  check_grid(grid);
  const auto fraction = column(grid, "volume_fraction"), body = column(grid, "body"),
             speed = column(grid, "velocity_m_per_s"), phi = column(grid, "level_set_disc_m"),
             wall = column(grid, "level_set_wall_m"), density = column(grid, "density_kg_per_m3");
  double area = 0;
  int near_wall = 0;
  for (std::size_t k = 0; k < grid.cells(); ++k) {
    area += fraction[k] * 0.0625e-6;
    const double x = 0.5 * (grid.points[3 * static_cast<std::size_t>(grid.connectivity[4 * k])] +
                            grid.points[3 * static_cast<std::size_t>(grid.connectivity[4 * k + 2])]);
    const double y = 0.5 * (grid.points[3 * static_cast<std::size_t>(grid.connectivity[4 * k]) + 1] +
                            grid.points[3 * static_cast<std::size_t>(grid.connectivity[4 * k + 2]) + 1]);
    const double r = std::hypot(x - 1e-3, y) - 4e-3;
    if (std::abs(r) < 1e-3) {
      EXPECT_NEAR(phi[k], r, 1e-5);
    }
    EXPECT_EQ(body[k], fraction[k] > 0 ? 0 : -1) << "rigid bodies hold no matter";
    EXPECT_EQ(std::isnan(density[k]), fraction[k] < 0.3);
    if (fraction[k] < 0.3) continue;
    EXPECT_NEAR(density[k], 1000, 1e-3);
    EXPECT_NEAR(speed[3 * k], 300, 1e-3);
    EXPECT_NEAR(speed[3 * k + 1], -400, 1e-3);
    EXPECT_EQ(speed[3 * k + 2], 0);
    near_wall += std::abs(wall[k]) < 0.5e-3;
  }
  EXPECT_NEAR(area, M_PI * 16e-6, 1e-9);
  EXPECT_EQ(near_wall, 0);
  EXPECT_LT(grid.cells(), 80U * 64U * 2 / 3) << "empty space is left out";
}

TEST(FieldDump, IsReadBackAsAPlane) {
  const ScratchFolder folder;
  const config::Case c = case_from(disc);
  State<2> state = state_of<2>(c);
  std::filesystem::create_directories(folder / "fields");
  FieldDump<2> dump(folder / "fields", "disc", {"velocity"});
  dump.write(state, parallel::World{});
  state.time = 2e-6;
  dump.write(state, parallel::World{});
  EXPECT_EQ(dump.last(), 2e-6);
  EXPECT_TRUE(std::filesystem::exists(folder / "fields/disc_000001.hdf"));

  EXPECT_EQ(choose_dump(folder.path(), 0.9e-6).time_s, 0);
  EXPECT_THROW(choose_dump(folder.path(), 2.1e-6), InputError) << "beyond the end";
  const ChosenDump chosen = choose_dump(folder.path(), std::nullopt);
  EXPECT_EQ(chosen.time_s, 2e-6);
  const VtkhdfFile file = read_vtkhdf(chosen.path);
  const RunUnits units = run_units(c.domain.geometry);
  const FieldPlane plane = field_plane(file, "velocity", units);
  EXPECT_EQ(plane.label, "velocity [m/s]");
  ASSERT_EQ(plane.bodies, (std::vector<std::string>{"disc", "wall"}));
  EXPECT_NEAR(plane.values.dx, 0.25e-3, 1e-12);
  const auto at = [&](const PlaneArray& a, double x, double y) {
    return a.at(static_cast<int>((x - a.x0) / a.dx), static_cast<int>((y - a.y0) / a.dy));
  };
  EXPECT_NEAR(at(plane.values, 1e-3, 0), 500, 1e-3);
  EXPECT_LT(at(plane.matter, 1e-3, 0), -1e-3);
  EXPECT_GT(at(plane.matter, 6e-3, 3.9e-3), 1e-3);
  EXPECT_LT(at(plane.level_sets[1], 0, -5.3e-3), 0);
  EXPECT_GT(at(plane.matter, 0, -5.3e-3), 0) << "rigid bodies hold no matter";
  EXPECT_NEAR(at(field_plane(file, "velocity.y", units).values, 1e-3, 0), -400, 1e-3);
  EXPECT_EQ(field_plane(file, "velocity.y", units).label, "velocity y [m/s]");
  EXPECT_TRUE(plane.categories.empty());
  const FieldPlane body = field_plane(file, "body", units);
  ASSERT_EQ(body.categories.size(), 2U);
  EXPECT_EQ(body.categories[0].name, "disc");
  EXPECT_EQ(at(body.values, 1e-3, 0), body.categories[0].value);
  EXPECT_TRUE(std::isnan(at(body.values, 0, -5.3e-3))) << "rigid bodies hold no matter";
  const FieldPlane contact = field_plane(file, "contact", units);
  ASSERT_EQ(contact.categories.size(), 1U);
  EXPECT_EQ(contact.categories[0].name, "none");
  const auto outlines = zero_outlines(plane.level_sets[0]);
  ASSERT_EQ(outlines.size(), 1U);
  EXPECT_NEAR(length(outlines[0]), 2 * M_PI * 4e-3, 0.01 * 2 * M_PI * 4e-3);
  EXPECT_THROW(field_plane(file, "velocity.z", units), InputError);
  EXPECT_THROW(field_plane(file, "pressure", units), InputError) << "not dumped";
  EXPECT_THROW(field_plane(file, "stress", units), InputError) << "which component?";
}

TEST(FieldDump, HoldsWhereRigidBodiesAre) {
  const ScratchFolder folder;
  State<2> state = state_of<2>(case_from(disc));
  EXPECT_EQ(rigid_places_in(own_fields(state, {})).size(), 1U);
  RigidMotion<2>& wall = *state.bodies[1].rigid;
  EXPECT_EQ(rigid_places(state).front().pose.centre[1], wall.start_centre[1]);
  set_moving(wall, Vec<2>{{3, -4}}, Vec<3>{{0, 0, 1e5}});
  const Vec<2> start = wall.start_centre;
  move_rigid(wall, 5e-6, {}, {}, 0);
  std::filesystem::create_directories(folder / "fields");
  FieldDump<2> dump(folder / "fields", "disc", {"velocity"});
  dump.write(state, parallel::World{});

  const auto places = rigid_places_in(read_vtkhdf(choose_dump(folder.path(), std::nullopt).path).grid);
  ASSERT_EQ(places.size(), 1U);
  const RigidPlace& place = places.front();
  EXPECT_EQ(place.body, 1);
  EXPECT_EQ(place.start_centre[0], start[0]);
  EXPECT_NEAR(place.pose.centre[0], start[0] + 15e-6, 1e-15);
  EXPECT_NEAR(place.pose.centre[1], start[1] - 20e-6, 1e-15);
  EXPECT_NEAR(place.pose.turn[0][0], std::cos(0.5), 1e-15);
  EXPECT_NEAR(place.pose.turn[0][1], -std::sin(0.5), 1e-15);
  EXPECT_NEAR(place.pose.turn[1][0], std::sin(0.5), 1e-15);
  EXPECT_EQ(place.pose.turn[2][2], 1);
  EXPECT_EQ(place.velocity[1], -4);
  EXPECT_EQ(place.spin[2], 1e5);
}

TEST(FieldDump, DamagedPlacesOfRigidBodiesAreAnError) {
  UnstructuredGrid grid = own_fields(state_of<2>(case_from(disc)), {});
  grid.whole_arrays.pop_back();
  EXPECT_THROW(rigid_places_in(grid), InputError);
  grid.whole_arrays.clear();
  EXPECT_TRUE(rigid_places_in(grid).empty()) << "a dump of an older version";
}

TEST(FieldDump, KnowsItsVariables) {
  try {
    const FieldDump<1> dump("nowhere", "x", {"presure"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'pressure'?"), std::string::npos) << error.what();
  }
  EXPECT_THROW(choose_dump("nowhere", std::nullopt), InputError);
}

}  // namespace
}  // namespace recoil::field_dump_test
