#include "state/exchange_fields.hpp"

#include <cstdint>
#include <vector>

#include "field/exchange.hpp"

namespace recoil {

namespace {

template <class T>
void put(parallel::Bytes& bytes, const std::vector<T>& v) {
  parallel::pack(bytes, static_cast<std::uint64_t>(v.size()));
  parallel::pack(bytes, v.data(), v.size());
}

template <class T>
void take(parallel::Unpacker& from, std::vector<T>& v) {
  v.resize(from.read<std::uint64_t>());
  from.read(v.data(), v.size());
}

/// Calls f(vector) for every array of the fields that the body has, in one order for sender and receiver.
template <int Dim, class F>
void for_each_vector(BodyBlock<Dim>& b, bool rigid, FieldSet fields, F&& f) {
  for_each_field<Dim>([&](const auto& declaration) {
    if (!fields.has(declaration.id) || (rigid && !declaration.of_rigid)) return;
    for_each_array(b.*declaration.member, [&](auto& array) { f(array.raw()); });
  });
}

}  // namespace

template <int Dim>
void exchange_fields(State<Dim>& state, const parallel::World& world, FieldSet fields) {
  exchange(
      state.mesh, world,
      [&](int slot, parallel::Bytes& bytes) {
        for (Body<Dim>& body : state.bodies) {
          BodyBlock<Dim>& b = body.at(slot);
          parallel::pack(bytes, static_cast<char>((b.present ? 1 : 0) | (b.near_surface ? 2 : 0)));
          if (b.present)
            for_each_vector(b, body.rigid.has_value(), fields, [&](const auto& v) { put(bytes, v); });
        }
      },
      [&](int slot, parallel::Unpacker& from) {
        for (Body<Dim>& body : state.bodies) {
          const int flags = from.read<char>();
          if ((flags & 1) == 0) {
            leave_block(body, slot);
            continue;
          }
          enter_block(body, slot, state.grid());
          BodyBlock<Dim>& b = body.at(slot);
          b.near_surface = (flags & 2) != 0;
          for_each_vector(b, body.rigid.has_value(), fields, [&](auto& v) { take(from, v); });
        }
      });
}

template void exchange_fields<1>(State<1>&, const parallel::World&, FieldSet);
template void exchange_fields<2>(State<2>&, const parallel::World&, FieldSet);
template void exchange_fields<3>(State<3>&, const parallel::World&, FieldSet);

}  // namespace recoil
