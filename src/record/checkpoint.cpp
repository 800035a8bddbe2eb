#include "record/checkpoint.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/error.hpp"
#include "levelset/band.hpp"
#include "parallel/archive.hpp"
#include "state/exchange_fields.hpp"
#include "state/pack_state.hpp"

namespace recoil {

namespace {

template <int Dim>
long all_blocks(const State<Dim>& state, const parallel::World& world) {
  std::array count{static_cast<std::int64_t>(state.mesh.local())};
  world.sum(count);
  return static_cast<long>(count[0]);
}

/// f() with what a wrong number of bytes means in a file.
template <class F>
void read_exactly(F&& f) {
  try {
    f();
  } catch (const InternalError&) {
    throw InputError(
        "error: the checkpoint is of another mesh, of other bodies or gauges, or of another version of "
        "recoil");
  }
}

}  // namespace

template <int Dim>
void write_checkpoint(const std::filesystem::path& path, const std::string& text, const State<Dim>& state,
                      const AveragedStates& averaged, Recorder<Dim>& recorder, const parallel::World& world) {
  BlockFileHead head{text, {}};
  if (world.rank() == 0) pack_whole(state, head.whole);
  recorder.pack_whole(head.whole);
  std::vector<parallel::Bytes> records(static_cast<std::size_t>(state.mesh.local()));
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    pack_block(state, slot, records[slot]);
    recorder.pack_block(slot, records[slot]);
    for (std::size_t m = 0; m < state.bodies.size(); ++m)
      parallel::pack(records[slot], averaged.lines.empty() ? AveragedStates::Line{} : averaged.at(slot, m));
  }
  const long first = state.mesh.local() > 0 ? state.mesh.block(0).order : 0;
  write_block_file(path, head, first, records, all_blocks(state, world), world);
}

template <int Dim>
void read_checkpoint(const BlockFile& file, State<Dim>& state, AveragedStates& averaged,
                     Recorder<Dim>& recorder, const parallel::World& world) {
  make_room(averaged, state);
  read_exactly([&] {
    require(file.blocks() == all_blocks(state, world), "a checkpoint of another mesh");
    for (int slot = 0; slot < state.mesh.local(); ++slot) {
      const parallel::Bytes record = file.record(state.mesh.block(slot).order);
      parallel::Unpacker from(record);
      const auto places = unpack_block(state, slot, from);
      for (std::size_t m = 0; m < places.size(); ++m)
        apply_band(state, state.bodies[m], slot,
                   {places[m].present, places[m].near_surface, places[m].reach});
      recorder.unpack_block(slot, from);
      for (std::size_t m = 0; m < state.bodies.size(); ++m)
        averaged.at(slot, m) = from.read<AveragedStates::Line>();
      require(from.empty(), "a checkpoint of another version");
    }
  });
  exchange_fields(state, world, run_fields<Dim>());
  state.stale = {};
  read_exactly([&] {
    parallel::Unpacker whole(file.head().whole);
    unpack_whole(state, whole);
    recorder.resume(state, whole);
    require(whole.empty(), "a checkpoint of another version");
  });
}

#define RECOIL_INSTANTIATE(Dim)                                                                            \
  template void write_checkpoint<Dim>(const std::filesystem::path&, const std::string&, const State<Dim>&, \
                                      const AveragedStates&, Recorder<Dim>&, const parallel::World&);      \
  template void read_checkpoint<Dim>(const BlockFile&, State<Dim>&, AveragedStates&, Recorder<Dim>&,       \
                                     const parallel::World&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
