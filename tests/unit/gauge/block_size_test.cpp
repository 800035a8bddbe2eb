#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "../support/scratch_folder.hpp"
#include "../support/small_case.hpp"
#include "format/csv.hpp"
#include "record/field_dump.hpp"
#include "record/recorder.hpp"
#include "timestep/step.hpp"

/// What a run shows does not depend on the size of its blocks, to the last bit: fields, gauges, history.
namespace recoil::block_size_test {
namespace {

/// Plates turned by 30 degrees that meet and slide; the contact crosses edges of blocks of all sizes.
const char* planar = R"(
format = 1
[domain]
geometry = "planar"
x = ["-2 mm", "2 mm"]
y = ["-2 mm", "2 mm"]
[mesh]
finest = "0.1 mm"
[time]
end = "0.2 us"
[body.wall]
rigid = true
shape = { kind = "disc", centre = { x = "-1.8 mm", y = "1.8 mm" }, radius = "0.1 mm" }
[body.target]
material = "none"
shape = { kind = "box", x = ["0 mm", "1 mm"], y = ["-1.5 mm", "1.5 mm"], rotation = "30 deg", centre = { x = "0 mm" } }
[body.flyer]
material = "none"
shape = { kind = "box", x = ["-1 mm", "0 mm"], y = ["-1.5 mm", "1.5 mm"], rotation = "30 deg", centre = { x = "0 mm" } }
velocity = { x = "123.205081 m/s", y = "186.602540 m/s" }
[contact]
default = "friction"
friction = 0.2
[gauge.all]
kind = "contact"
pair = "flyer-target"
direction = { x = 0.8660254, y = 0.5 }
[gauge.part]
kind = "contact"
pair = "flyer-target"
at = { x = "0 mm", y = "0 mm" }
radius = "0.7 mm"
[gauge.body]
kind = "body"
body = "flyer"
[gauge.point]
kind = "point"
body = "target"
at = { x = "0.3 mm", y = "0.1 mm" }
[gauge.rear]
kind = "surface-velocity"
body = "target"
at = { x = "0.866 mm", y = "0.5 mm" }
[gauge.attitude]
kind = "attitude"
body = "flyer"
[gauge.peak]
kind = "peak-stress"
body = "target"
at = { x = "0 mm", y = "0 mm" }
to = { x = "0.7 mm", y = "0.4 mm" }
stations = 5
)";

/// A cube that lands on another, askew to the blocks.
const char* space = R"(
format = 1
[domain]
geometry = "3d"
x = ["-1 mm", "1 mm"]
y = ["-1 mm", "1 mm"]
z = ["0 mm", "2 mm"]
[mesh]
finest = "0.1 mm"
[time]
end = "0.05 us"
[body.low]
material = "none"
shape = { kind = "box", x = ["-0.65 mm", "0.65 mm"], y = ["-0.55 mm", "0.55 mm"], z = ["0.3 mm", "0.93 mm"] }
[body.high]
material = "none"
shape = { kind = "box", x = ["-0.45 mm", "0.25 mm"], y = ["-0.65 mm", "0.35 mm"], z = ["0.93 mm", "1.7 mm"] }
velocity = { x = "40 m/s", z = "-100 m/s" }
[gauge.all]
kind = "contact"
pair = "high-low"
[gauge.part]
kind = "contact"
pair = "high-low"
at = { x = "-0.1 mm", y = "-0.2 mm", z = "0.93 mm" }
radius = "0.3 mm"
[gauge.body]
kind = "body"
body = "high"
[gauge.bar]
kind = "bar"
body = "high"
wall = "low"
)";

/// A disc on a disc, of what breaks: the lower one spalls.
const char* breaking = R"(
format = 1
[domain]
geometry = "axisymmetric"
r = ["0 mm", "2.4 mm"]
z = ["-1.6 mm", "2.4 mm"]
[mesh]
finest = "0.1 mm"
[time]
end = "1.2 us"
[body.target]
material = "none"
shape = { kind = "box", r = ["0 mm", "1.85 mm"], z = ["-1.03 mm", "0.52 mm"] }
[body.flyer]
material = "none"
shape = { kind = "box", r = ["0 mm", "1.35 mm"], z = ["0.52 mm", "1.27 mm"] }
velocity = { z = "-500 m/s" }
[gauge.part]
kind = "contact"
pair = "flyer-target"
at = { z = "0.52 mm" }
radius = "0.7 mm"
[gauge.pullback]
kind = "pullback"
body = "target"
at = { z = "-1.03 mm" }
[gauge.fragments]
kind = "fragments"
body = "target"
[gauge.tension]
kind = "peak-tension"
body = "target"
[gauge.residual]
kind = "residual"
body = "target"
at = { z = "-1.1 mm" }
direction = { z = -1 }
[gauge.crater]
kind = "crater"
body = "target"
at = { z = "0.52 mm" }
direction = { z = 1 }
radius = "1.5 mm"
)";

/// A plate that hits a free rigid beam off its middle, so that it is pushed and turned.
const char* pushed = R"(
format = 1
[domain]
geometry = "planar"
x = ["-2 mm", "1.2 mm"]
y = ["-1.6 mm", "2.4 mm"]
[mesh]
finest = "0.1 mm"
[time]
end = "0.3 us"
[body.plate]
material = "none"
shape = { kind = "box", x = ["-1.53 mm", "0 mm"], y = ["0.22 mm", "1.61 mm"] }
velocity = { x = "200 m/s", y = "-30 m/s" }
[body.beam]
rigid = true
shape = { kind = "box", x = ["0 mm", "0.7 mm"], y = ["-1.2 mm", "2.0 mm"] }
mass = "2 g/m"
inertia = "2e-9 kg m"
centre-of-mass = { x = "0.35 mm", y = "0.4 mm" }
[contact]
default = "friction"
friction = 0.2
[gauge.part]
kind = "contact"
pair = "plate-beam"
at = { x = "0.0 mm", y = "1 mm" }
radius = "1 mm"
[gauge.beam]
kind = "body"
body = "beam"
[gauge.attitude]
kind = "attitude"
body = "plate"
)";

struct Shown {
  std::map<std::string, CsvTable> gauges;
  std::map<std::string, std::vector<double>> fields;  // by array, in the order of the cells' middles
};

/// All arrays of a dump in an order that does not depend on blocks.
std::map<std::string, std::vector<double>> sorted_fields(const UnstructuredGrid& grid) {
  const std::size_t corners = grid.connectivity.size() / grid.cells();
  std::vector<std::pair<std::array<double, 3>, std::size_t>> order;
  for (std::size_t k = 0; k < grid.cells(); ++k) {
    std::array<double, 3> middle{};
    for (std::size_t c = 0; c < corners; ++c)
      for (std::size_t d = 0; d < 3; ++d)
        middle[d] += std::round(
            1e9 * grid.points[3 * static_cast<std::size_t>(grid.connectivity[corners * k + c]) + d]);
    order.emplace_back(middle, k);
  }
  std::sort(order.begin(), order.end());
  std::map<std::string, std::vector<double>> sorted;
  for (const NamedArray& a : grid.cell_arrays) {
    const std::vector<double> values = as_doubles(a.values);
    const auto width = static_cast<std::size_t>(a.components);
    for (const auto& [middle, k] : order)
      for (std::size_t c = 0; c < width; ++c) sorted[a.name].push_back(values[k * width + c]);
  }
  return sorted;
}

template <int Dim>
Shown run(const char* text, const Material& material, int block) {
  ScratchFolder folder;
  config::Case c = case_from(text);
  c.mesh.block = block;
  start_parallel();
  State<Dim> state = make_state<Dim>(c, std::vector<Material>(c.bodies.size(), material), parallel::World{});
  EXPECT_EQ(state.grid().block[0], block);
  parallel::World world;
  parallel::Team team{1};
  Engine engine{world, team, {}};
  prepare_start(state, engine);
  Recorder<Dim> recorder(c, state, world, folder.path(), &team);
  recorder.begin(state);
  while (state.time < c.time.end * (1 - 1e-12)) {
    const double dt = advance(state, {c.time.cfl, c.time.fixed_dt}, c.time.end, engine);
    recorder.after_step(state, dt);
  }
  recorder.finish(state, {.version = "test", .exit = 0, .wall_s = 1, .expect = {}});
  Shown shown;
  for (const config::Gauge& g : c.gauges)
    shown.gauges[g.name] = read_csv(folder / ("gauges/" + g.name + ".csv"));
  shown.gauges["history"] = read_csv(folder / "history.csv");
  shown.fields = sorted_fields(gather_fields(state, world, field_variables()));
  return shown;
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

void expect_same(const Shown& a, const Shown& b, int block) {
  for (const auto& [gauge, table] : a.gauges) {
    const CsvTable& other = b.gauges.at(gauge);
    ASSERT_EQ(table.columns, other.columns);
    for (const std::string& heading : table.columns) {
      const std::string column = heading.substr(0, heading.find(" ["));
      const auto x = table.numbers(column), y = other.numbers(column);
      ASSERT_EQ(x.size(), y.size()) << gauge;
      for (std::size_t k = 0; k < x.size(); ++k)
        EXPECT_TRUE(same(x[k], y[k]))
            << gauge << ' ' << column << " at " << k << ", block " << block << ": " << x[k] << ' ' << y[k];
    }
  }
  for (const auto& [name, values] : a.fields) {
    const auto& other = b.fields.at(name);
    ASSERT_EQ(values.size(), other.size()) << name;
    int different = 0;
    for (std::size_t k = 0; k < values.size(); ++k) different += !same(values[k], other[k]);
    EXPECT_EQ(different, 0) << name << ", block " << block;
  }
}

template <int Dim>
Shown expect_no_trace_of_blocks(const char* text, const Material& material,
                                std::initializer_list<int> blocks) {
  Shown first = run<Dim>(text, material, *blocks.begin());
  const auto areas = first.gauges.at("part").numbers("area");
  EXPECT_GT(*std::max_element(areas.begin(), areas.end()), 0);
  for (const int block : blocks)
    if (block != *blocks.begin()) expect_same(first, run<Dim>(text, material, block), block);
  return first;
}

void expect_contact_in_fields(const Shown& shown) {
  const auto& state = shown.fields.at("contact_state");
  for (const double kind : {0.0, 2.0}) EXPECT_GT(std::count(state.begin(), state.end(), kind), 10);
}

TEST(BlockSize, DoesNotShowInThePlane) {
  expect_contact_in_fields(expect_no_trace_of_blocks<2>(planar, hard_matter(), {8, 16, 32}));
}

TEST(BlockSize, DoesNotShowInSpace) {
  expect_contact_in_fields(expect_no_trace_of_blocks<3>(space, hard_matter(), {8, 10, 20}));
}

TEST(BlockSize, DoesNotShowInFragments) {
  Material material = hard_matter();
  material.damage = TensileDamage{0.4e9, 1, 20e-9};
  const Shown shown = expect_no_trace_of_blocks<2>(breaking, material, {8, 16, 24});
  EXPECT_GT(shown.gauges.at("fragments").numbers("count").back(), 1);
  EXPECT_GT(shown.gauges.at("residual").numbers("mass").back(), 0);
  EXPECT_GT(shown.gauges.at("crater").numbers("depth").back(), 0);
}

TEST(BlockSize, DoesNotShowInTheMotionOfARigidBody) {
  const Shown shown = expect_no_trace_of_blocks<2>(pushed, hard_matter(), {8, 16, 32});
  EXPECT_GT(shown.gauges.at("beam").numbers("velocity.x").back(), 1);
  EXPECT_NE(shown.gauges.at("attitude").numbers("spin").back(), 0);
}

}  // namespace
}  // namespace recoil::block_size_test
