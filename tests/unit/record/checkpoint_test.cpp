#include "record/checkpoint.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "../support/scratch_folder.hpp"
#include "../support/small_case.hpp"
#include "core/error.hpp"
#include "format/hdf5_handle.hpp"
#include "timestep/step.hpp"

namespace recoil::checkpoint_test {
namespace {

const char* text = R"(
format = 1
title = "two plates and a wall"
[domain]
geometry = "planar"
x = ["-3 mm", "3 mm"]
y = ["0 mm", "2 mm"]
[domain.boundary]
y = "symmetry"
[mesh]
finest = "0.2 mm"
block = 10
[time]
end = "2 us"
[body.flyer]
material = "none"
shape = { kind = "box", x = ["-2 mm", "-0.3 mm"], y = ["0 mm", "2 mm"] }
velocity = { x = "60 m/s" }
[body.target]
material = "none"
shape = { kind = "box", x = ["-0.3 mm", "1.5 mm"], y = ["0 mm", "2 mm"] }
[body.wall]
rigid = true
shape = { kind = "box", x = ["1.5 mm", "3 mm"], y = ["0 mm", "2 mm"] }
[load.push]
body = "flyer"
pressure = "exp(-t/us) * 50*MPa"
facing = { x = -1 }
[gauge.face]
kind = "contact"
pair = "target-flyer"
[gauge.rear]
kind = "surface-velocity"
body = "target"
at = { x = "1.5 mm", y = "1 mm" }
)";

/// One run of the case, with its recorder.
struct Recorded {
  std::filesystem::path folder;
  config::Case contents = case_from(text);
  parallel::World world;
  parallel::Team team{1};
  Engine engine{world, team, {}};
  State<2> state = state_of<2>(contents);
  Recorder<2> recorder;

  explicit Recorded(const std::filesystem::path& path)
      : folder(path), recorder(contents, state, world, made(path), &team) {}
  static std::filesystem::path made(const std::filesystem::path& path) {
    std::filesystem::create_directories(path);
    return path;
  }

  void begin() {
    prepare_start(state, engine);
    recorder.begin(state);
  }
  void advance_by(int steps) {
    for (int n = 0; n < steps; ++n) recorder.after_step(state, advance(state, Stepping{}, 1, engine));
  }
  std::string file(const char* name) const {
    std::ifstream in(folder / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void finish() { recorder.finish(state, {}); }
};

TEST(Checkpoint, ARunGoesOnToTheSameBits) {
  const ScratchFolder folder;
  Recorded whole(folder / "whole"), first(folder / "first"), second(folder / "second");
  whole.begin();
  first.begin();
  whole.advance_by(40);
  first.advance_by(25);
  const auto file = first.folder / "checkpoint.h5";
  write_checkpoint(file, "a run", first.state, first.engine.averaged, first.recorder, first.world);
  for (const char* name : {"history.csv", "events.csv", "fragments.csv"})
    std::filesystem::copy_file(first.folder / name, second.folder / name,
                               std::filesystem::copy_options::overwrite_existing);

  const BlockFile saved(file);
  EXPECT_EQ(saved.head().text, "a run");
  read_checkpoint(saved, second.state, second.engine.averaged, second.recorder, second.world);
  EXPECT_EQ(second.state.time, first.state.time);
  EXPECT_EQ(second.state.step, 25);
  second.advance_by(15);
  for (std::size_t m = 0; m < 2; ++m)
    for (int slot = 0; slot < whole.state.mesh.local(); ++slot) {
      const BodyBlock<2>&a = whole.state.bodies[m].at(slot), &b = second.state.bodies[m].at(slot);
      ASSERT_EQ(a.present, b.present);
      EXPECT_EQ(a.contents, b.contents);
      EXPECT_EQ(a.volume, b.volume);
      EXPECT_EQ(a.phi, b.phi);
      EXPECT_EQ(a.contact, b.contact);
    }
  whole.finish();
  second.finish();
  for (const char* name : {"history.csv", "events.csv", "gauges/face.csv", "gauges/rear.csv"})
    EXPECT_EQ(second.file(name), whole.file(name)) << name;
}

TEST(Checkpoint, DamageIsNoticed) {
  const ScratchFolder folder;
  Recorded run(folder / "run");
  run.begin();
  run.advance_by(3);
  const auto file = run.folder / "checkpoint.h5";
  write_checkpoint(file, "a run", run.state, run.engine.averaged, run.recorder, run.world);
  std::string bytes = run.file("checkpoint.h5");
  const std::string whole = bytes;
  const auto refused = [&](const std::string& damaged) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << damaged;
    Recorded other(folder / "other");
    for (const char* name : {"history.csv", "fragments.csv"})
      std::filesystem::copy_file(run.folder / name, other.folder / name,
                                 std::filesystem::copy_options::overwrite_existing);
    try {
      read_checkpoint(BlockFile(file), other.state, other.engine.averaged, other.recorder, other.world);
    } catch (const InputError&) {
      return true;
    }
    return false;
  };
  EXPECT_TRUE(refused(whole.substr(0, whole.size() / 2)));
  EXPECT_TRUE(refused(""));
  EXPECT_TRUE(refused("no HDF5 at all"));
  // A flipped bit in the records, wherever it is, does not fit the checksum.
  for (const double part : {0.3, 0.6, 0.9}) {
    bytes = whole;
    bytes[static_cast<std::size_t>(part * static_cast<double>(whole.size()))] ^= 1;
    EXPECT_TRUE(refused(bytes)) << part;
  }
  EXPECT_FALSE(refused(whole));
}

/// A type of gigabytes for each number, which a damaged file may claim, is not read: HDF5 would take as much
/// room.
TEST(Checkpoint, DatasetsOfAnotherTypeAreRefused) {
  const ScratchFolder folder;
  Recorded run(folder / "run");
  run.begin();
  const auto file = run.folder / "checkpoint.h5";
  write_checkpoint(file, "a run", run.state, run.engine.averaged, run.recorder, run.world);
  {
    const Hdf5Handle open(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open a file");
    const Hdf5Handle huge(H5Tcreate(H5T_OPAQUE, std::size_t{1} << 31), H5Tclose, "make a type");
    const hsize_t one = 1;
    const Hdf5Handle space(H5Screate_simple(1, &one, nullptr), H5Sclose, "make a space");
    Hdf5Handle::check(H5Ldelete(open, "head", H5P_DEFAULT), "remove a dataset");
    const Hdf5Handle set(H5Dcreate2(open, "head", huge, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                         H5Dclose, "make a dataset");
  }
  try {
    const BlockFile read(file);
    FAIL() << "nothing was thrown";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("its 'head' is of another type"), std::string::npos) << e.what();
  }
}

TEST(Checkpoint, OfAnotherMeshIsRefused) {
  const ScratchFolder folder;
  Recorded run(folder / "run");
  run.begin();
  const auto file = run.folder / "checkpoint.h5";
  write_checkpoint(file, "a run", run.state, run.engine.averaged, run.recorder, run.world);
  config::Case finer = case_from(text);
  finer.mesh.finest = 1e-4;
  State<2> state = state_of<2>(finer);
  Recorder<2> recorder(finer, state, run.world, Recorded::made(folder / "finer"));
  EXPECT_THROW(read_checkpoint(BlockFile(file), state, run.engine.averaged, recorder, run.world), InputError);
}

}  // namespace
}  // namespace recoil::checkpoint_test
