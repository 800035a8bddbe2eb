#include "state/pack_state.hpp"

#include <type_traits>

#include "core/error.hpp"

namespace recoil {

namespace {

using parallel::pack;

/// f(value) for every member of the motion of a rigid body that changes in a run; f may change it.
template <class Motion, class F>
void for_each_member(Motion& m, F&& f) {
  f(m.velocity);
  f(m.spin);
  f(m.mean_velocity);
  f(m.mean_spin);
  f(m.start_centre);
  f(m.centre);
  f(m.turn);
  if (m.mass) f(*m.mass);
}

[[noreturn]] void other_mesh() {
  throw InputError(
      "error: the checkpoint is of another mesh, of other bodies or of another version of recoil");
}

}  // namespace

template <int Dim>
void pack_block(const State<Dim>& state, int slot, parallel::Bytes& bytes) {
  for (const Body<Dim>& body : state.bodies) {
    const BodyBlock<Dim>& b = body.at(slot);
    pack(bytes, static_cast<char>((b.present ? 1 : 0) | (b.near_surface ? 2 : 0)));
    if (!b.present) continue;
    pack(bytes, b.reach);
    for_each_field<Dim>([&](const auto& d) {
      if (!d.in_checkpoint() || (body.rigid && !d.of_rigid)) return;
      for_each_array(b.*d.member, [&](const auto& array) { pack(bytes, array.raw().data(), array.size()); });
    });
  }
  const BlockLedger<Dim>& ledger = state.ledger[slot];
  pack(bytes, ledger.pairs.data(), ledger.pairs.size());
  pack(bytes, ledger.edges.data(), ledger.edges.size());
  pack(bytes, ledger.failures.data(), ledger.failures.size());
  pack(bytes, ledger.released.data(), ledger.released.size());
  pack(bytes, ledger.loads.data(), ledger.loads.size());
  pack(bytes, ledger.counters);
}

template <int Dim>
std::vector<PackedPlace<Dim>> unpack_block(State<Dim>& state, int slot, parallel::Unpacker& from) {
  std::vector<PackedPlace<Dim>> places;
  for (Body<Dim>& body : state.bodies) {
    const int flags = from.read<char>();
    PackedPlace<Dim>& place = places.emplace_back();
    place.present = (flags & 1) != 0;
    place.near_surface = (flags & 2) != 0;
    leave_block(body, slot);
    if (!place.present) continue;
    place.reach = from.read<Box<Dim>>();
    enter_block(body, slot, state.grid());
    for_each_field<Dim>([&](const auto& d) {
      if (!d.in_checkpoint() || (body.rigid && !d.of_rigid)) return;
      for_each_array(body.at(slot).*d.member,
                     [&](auto& array) { from.read(array.raw().data(), array.size()); });
    });
  }
  BlockLedger<Dim>& ledger = state.ledger[slot];
  from.read(ledger.pairs.data(), ledger.pairs.size());
  from.read(ledger.edges.data(), ledger.edges.size());
  from.read(ledger.failures.data(), ledger.failures.size());
  from.read(ledger.released.data(), ledger.released.size());
  from.read(ledger.loads.data(), ledger.loads.size());
  ledger.counters = from.read<Counters>();
  return places;
}

template <int Dim>
void pack_whole(const State<Dim>& state, parallel::Bytes& bytes) {
  pack(bytes, state.time);
  pack(bytes, state.step);
  pack(bytes, state.travel);
  for (const Body<Dim>& body : state.bodies)
    if (body.rigid) for_each_member(*body.rigid, [&](const auto& value) { pack(bytes, value); });
}

template <int Dim>
void unpack_whole(State<Dim>& state, parallel::Unpacker& from) {
  state.time = from.read<double>();
  state.step = from.read<long>();
  state.travel = from.read<double>();
  if (state.step < 0 || !(state.time >= 0)) other_mesh();
  for (Body<Dim>& body : state.bodies)
    if (body.rigid)
      for_each_member(*body.rigid,
                      [&](auto& value) { value = from.read<std::remove_cvref_t<decltype(value)>>(); });
}

#define RECOIL_INSTANTIATE(Dim)                                                                    \
  template void pack_block<Dim>(const State<Dim>&, int, parallel::Bytes&);                         \
  template std::vector<PackedPlace<Dim>> unpack_block<Dim>(State<Dim>&, int, parallel::Unpacker&); \
  template void pack_whole<Dim>(const State<Dim>&, parallel::Bytes&);                              \
  template void unpack_whole<Dim>(State<Dim>&, parallel::Unpacker&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
