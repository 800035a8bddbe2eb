#include "record/recorder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>

#include "../support/scratch_folder.hpp"
#include "../support/small_case.hpp"
#include "core/error.hpp"
#include "format/csv.hpp"
#include "timestep/step.hpp"

namespace recoil::recorder_test {
namespace {

/// Two equal elastic plates of 2 mm: c_L is 5 km/s, so they part after 0.8 us with their velocities
/// exchanged.
const char* plates = R"(
format = 1
title = "plates"
[domain]
geometry = "1d"
x = ["-3 mm", "3 mm"]
[mesh]
finest = "0.05 mm"
[time]
end = "1.2 us"
[body.flyer]
material = "none"
shape = { kind = "box", x = ["-2 mm", "0 mm"] }
velocity = { x = "20 m/s" }
[body.target]
material = "none"
shape = { kind = "box", x = ["0 mm", "2 mm"] }
[gauge.rear]
kind = "surface-velocity"
body = "target"
at = { x = "2 mm" }
[gauge.face]
kind = "contact"
pair = "target-flyer"
[gauge.inside]
kind = "point"
body = "target"
at = { x = "1.01 mm" }
every = "0.1 us"
[gauge.whole]
kind = "body"
body = "flyer"
[output]
fields = { every = "0.5 us" }
[expect]
"contact.flyer-target.opens" = { value = "0.8 us", within = "5 %" }
"contact.target-flyer.recloses" = false
"gauge.rear.velocity.peak" = { value = "20 m/s", within = "3 %" }  # overshoots by 2 %
"gauge.face.traction.mean@0.1us..0.6us" = { value = "-50 MPa", within = "1 %" }
"gauge.inside.pressure.at@0.4us" = { value = "30 MPa", within = "3 %" }
"body.target.velocity.x" = { value = "20 m/s", within = "2 %" }
"budget.total.momentum" = { at-most = 1e-12 }
)";

/// Runs the case into a folder. @returns the last state's summary.
Summary run(const std::string& text, const std::filesystem::path& folder, int threads = 1) {
  const config::Case c = case_from(text);
  State<1> state = state_of<1>(c);
  const parallel::World world;
  parallel::Team team(threads);
  Engine engine{world, team, {}};
  engine.least_work = 0;
  prepare_start(state, engine);
  Recorder<1> recorder(c, state, world, folder, &team);
  recorder.begin(state);
  while (state.time < c.time.end * (1 - 1e-12)) {
    const double dt = advance(state, {c.time.cfl, c.time.fixed_dt}, c.time.end, engine);
    recorder.after_step(state, dt);
  }
  return recorder.finish(state, {.version = "test", .exit = 0, .wall_s = 1, .expect = {}});
}

TEST(Recorder, LeavesEverythingAndChecksIt) {
  const ScratchFolder folder;
  const Summary s = run(plates, folder.path());
  for (const CheckResult& r : s.expect)
    EXPECT_TRUE(r.pass) << r.expected.quantity << " is " << r.measured.value << ' ' << r.measured.problem;
  EXPECT_EQ(s.exit, 0);
  EXPECT_EQ(s.case_name, "small");
  EXPECT_NEAR(static_cast<double>(s.cells), 80, 4);
  EXPECT_NEAR(s.cell_steps / static_cast<double>(s.steps), 80, 4) << "about as many in each step";
  EXPECT_DOUBLE_EQ(s.rate, s.cell_steps * 3 * 1e-6) << "three stages, one second";

  const CsvTable history = read_csv(folder / "history.csv");
  const auto mass = history.numbers("flyer.mass"), push = history.numbers("target.exchange.impulse.x"),
             momentum = history.numbers("target.momentum.x");
  EXPECT_EQ(history.unit("flyer.mass"), "kg/m2");
  EXPECT_EQ(history.rows.size(), static_cast<std::size_t>(s.steps) + 1);
  for (std::size_t k = 0; k < mass.size(); ++k) {
    EXPECT_NEAR(mass[k], 2, 1e-10);
    EXPECT_NEAR(momentum[k], push[k], 1e-10) << "the balance of the target alone";
  }
  EXPECT_NEAR(push.back(), 40, 1);

  const CsvTable face = read_csv(folder / "gauges/face.csv");
  EXPECT_NEAR(face.numbers("impulse.x").back(), 40, 1) << "on the body that the pair names first";
  EXPECT_NEAR(face.numbers("velocity")[20], -10, 0.3) << "along its normal";
  EXPECT_EQ(face.numbers("area")[20], 1);
  EXPECT_EQ(face.numbers("traction").back(), 0);
  EXPECT_EQ(read_csv(folder / "gauges/inside.csv").rows.size(), 13U);
  const CsvTable rear = read_csv(folder / "gauges/rear.csv");
  EXPECT_EQ(rear.columns[0], "time [us]");
  EXPECT_EQ(rear.columns[1], "velocity [m/s]");
  EXPECT_NEAR(rear.numbers("position.x").back(), 2 + 0.8 * 0.02, 0.001);

  const CsvTable events = read_csv(folder / "events.csv");
  EXPECT_EQ(events.texts("event").front(), "contact");
  EXPECT_EQ(events.texts("bodies").front(), "flyer-target");
  EXPECT_EQ(events.texts("event").at(1), "opening");
  EXPECT_EQ(events.columns.at(3), "place.x [mm]");
  EXPECT_NEAR(events.numbers("place.x").front(), 0, 0.05);
  EXPECT_TRUE(std::filesystem::exists(folder / "fields/small.hdf.series"));
  EXPECT_TRUE(std::filesystem::exists(folder / "fields/small_000003.hdf"));
  EXPECT_FALSE(std::filesystem::exists(folder / "fields/small_000004.hdf"));
  std::ifstream status(folder / "status.json");
  EXPECT_EQ(nlohmann::json::parse(status)["state"], "finished");
}

TEST(Recorder, TheFirstTouchIsTimedWithinItsStep) {
  const ScratchFolder folder;
  std::string text = plates;
  text.replace(text.find("-2 mm"), 5, "-2.0033 mm");
  text.replace(text.find("\"0 mm\"]"), 7, "\"-0.0033 mm\"]");
  text.resize(text.find("[expect]"));
  const Summary s = run(text, folder.path());
  ASSERT_FALSE(s.events.empty());
  EXPECT_EQ(s.events[0].kind, "contact");
  EXPECT_NEAR(s.events[0].time, 3.3e-6 / 20, 1e-13) << "gap over speed; a step is 9 ns";
  EXPECT_EQ(s.events[0].detail, "flyer 20 m/s, target 0 m/s");
}

const char* pushed = R"x(
format = 1
title = "a pressure that rises smoothly"
[domain]
geometry = "1d"
x = ["-1 mm", "9 mm"]
[mesh]
finest = "0.05 mm"
[time]
end = "1 us"
[body.plate]
material = "none"
shape = { kind = "box", x = ["0 mm", "8 mm"] }
[load.push]
body = "plate"
pressure = "5*MPa * (1 - exp(-(t/(0.3*us))^2))"
facing = { x = -1 }
[gauge.face]
kind = "surface-velocity"
body = "plate"
at = { x = "0 mm" }
)x";

/// rho c_L is 5e6 kg/(m2 s). At the ends of steps of 9 ns the velocity would differ by up to 0.013 m/s.
TEST(Recorder, RecordsOfASurfaceAreOfTheMiddleOfTheirStep) {
  const ScratchFolder folder;
  run(pushed, folder.path());
  const CsvTable face = read_csv(folder / "gauges/face.csv");
  const auto time = face.numbers("time"), velocity = face.numbers("velocity.x"),
             place = face.numbers("position.x");
  const auto n = time.size();
  ASSERT_GT(n, 100U);
  EXPECT_EQ(time[0], 0);
  EXPECT_NEAR(time[2] - time[1], 2 * time[1], 1e-3 * time[1]);
  EXPECT_NEAR(time[n - 1], 1, 1e-12);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    EXPECT_NEAR(velocity[k], 1 - std::exp(-std::pow(time[k] / 0.3, 2)), 1.5e-3) << time[k];
    if (k > 1) {
      EXPECT_NEAR(place[k] - place[k - 1], 0.5e-3 * (velocity[k] + velocity[k - 1]) * (time[k] - time[k - 1]),
                  1e-9);
    }
  }
}

const char* leaving = R"(
format = 1
title = "leaves through an open edge"
[domain]
geometry = "1d"
x = ["0 mm", "4 mm"]
[mesh]
finest = "0.1 mm"
[time]
end = "1.5 us"
[body.block]
material = "none"
shape = { kind = "box", x = ["0.93 mm", "3.02 mm"] }
velocity = { x = "3 km/s" }
)";

TEST(Recorder, ABodyThatLeavesTheDomainLeavesNothingBehind) {
  const ScratchFolder folder;
  const Summary s = run(leaving, folder.path());
  const CsvTable history = read_csv(folder / "history.csv");
  EXPECT_EQ(history.numbers("block.mass").back(), 0);
  EXPECT_EQ(history.numbers("block.volume").back(), 0);
  EXPECT_NEAR(history.numbers("block.edges.mass").back(), 2.09, 1e-12);
  EXPECT_NEAR(history.numbers("block.edges.momentum.x").back(), 6270, 1e-9);
  for (const char* what : {"block.drift.mass", "block.drift.momentum", "block.drift.energy"})
    for (const double drift : history.numbers(what)) EXPECT_LT(drift, 1e-12) << what;
  ASSERT_EQ(s.centres.size(), 1U);
  EXPECT_LT(s.centres[0].off, 0.05e-3) << "half a cell, of 2 to 4 mm";
}

std::string contents(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(Recorder, FilesDoNotDependOnThreads) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "one");
  std::filesystem::create_directories(folder / "three");
  run(plates, folder / "one", 1);
  run(plates, folder / "three", 3);
  for (const char* file :
       {"history.csv", "events.csv", "gauges/rear.csv", "gauges/face.csv", "gauges/whole.csv"}) {
    EXPECT_EQ(contents(folder / "one" / file), contents(folder / "three" / file)) << file;
    EXPECT_FALSE(contents(folder / "one" / file).empty()) << file;
  }
}

std::string with(const std::string& expectation) { return std::string(plates) + expectation + "\n"; }

TEST(Recorder, AMissedExpectationIsExitCode5) {
  const ScratchFolder folder;
  const Summary s = run(with(R"("run.steps" = { at-most = 3 })"), folder.path());
  EXPECT_FALSE(s.passed);
  EXPECT_EQ(s.exit, 5);
}

TEST(Recorder, ExpectationsThatCannotBeAreFoundBeforeTheRun) {
  const ScratchFolder folder;
  try {
    run(with(R"("gauge.rear.velocity.mean" = { at-most = "3 m/s" })"), folder.path());
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("needs an argument after '@'"), std::string::npos) << text;
    EXPECT_NE(text.find("--> small/case.toml:"), std::string::npos) << text;
  }
}

TEST(Recorder, CaseNames) {
  config::Case c;
  for (const auto& [file, name] : {std::pair{"cases/flyer/case.toml", "flyer"},
                                   {"a/my_case.toml", "my_case"},
                                   {"case.toml", "case"},
                                   {"", "case"}}) {
    c.file = file;
    EXPECT_EQ(case_name(c), name);
  }
}

}  // namespace
}  // namespace recoil::recorder_test
