#include "record/checkpoint.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "levelset/band.hpp"
#include "parallel/archive.hpp"
#include "state/exchange_fields.hpp"
#include "state/levels.hpp"
#include "state/pack_state.hpp"

namespace recoil {

namespace {

template <int Dim>
long all_blocks(const State<Dim>& state, const parallel::World& world) {
  std::array count{static_cast<std::int64_t>(state.mesh.local())};
  world.sum(count);
  return static_cast<long>(count[0]);
}

/// The places of all blocks in the order of the curve, on rank 0: what a mesh of several levels is made from.
template <int Dim>
void pack_places(const Mesh<Dim>& mesh, const parallel::World& world, parallel::Bytes& bytes) {
  parallel::Bytes own;
  for (int slot = 0; mesh.levels() > 1 && slot < mesh.local(); ++slot)
    parallel::pack(own, mesh.block(slot).place());
  const auto all = world.gather(own);
  if (world.rank() != 0) return;
  std::uint64_t size = 0;
  for (const parallel::Bytes& b : all) size += b.size();
  parallel::pack(bytes, size / sizeof(Place<Dim>));
  for (const parallel::Bytes& b : all) bytes.insert(bytes.end(), b.begin(), b.end());
}

/// The mesh whose blocks these are, shared evenly.
template <int Dim>
Mesh<Dim> mesh_of(const Mesh<Dim>& like, const std::vector<Place<Dim>>& places,
                  const parallel::World& world) {
  std::set<std::pair<int, std::array<int, Dim>>> cut;
  for (Place<Dim> p : places)
    while (p.level + 1 < like.levels()) {
      p = p.coarser();
      if (!cut.insert({p.level, p.at.c}).second) break;
    }
  return Mesh<Dim>(
      like.grid(), like.levels(), world,
      [&](const Place<Dim>& p) {
        return cut.count({p.level, p.at.c}) > 0;
      },
      [](const Place<Dim>&) { return 1; });
}

template <int Dim>
void take_places(State<Dim>& state, long blocks, parallel::Unpacker& from, const parallel::World& world) {
  const auto count = from.read<std::uint64_t>();
  if (count == 0) return;  // one level
  require(count == static_cast<std::uint64_t>(blocks), "a place for each block");
  std::vector<Place<Dim>> places(count);
  from.read(places.data(), places.size());
  state = empty_on(mesh_of(state.mesh, places, world), state);
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
  pack_places(state.mesh, world, head.whole);
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
  parallel::Unpacker whole(file.head().whole);
  read_exactly([&] { take_places(state, file.blocks(), whole, world); });
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
  parallel::Team alone;
  fill_stand_ins(state, Field::contents | Field::volume | Field::phi, alone);
  read_exactly([&] {
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
