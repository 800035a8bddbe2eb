#include "state/share.hpp"

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

/// Calls f(vector) for every array of the parts, in one order for sender and receiver.
template <int Dim, class F>
void for_each_array(BodyBlock<Dim>& b, bool rigid, unsigned parts, F&& f) {
  if (parts & part_phi) f(b.phi);
  if (parts & part_phi_next) f(b.phi_next);
  const auto geometry = [&](Geometry<Dim>& g) {
    f(g.kind);
    f(g.index);
    f(g.cuts);
  };
  if (parts & part_geometry) geometry(b.geometry);
  if (parts & part_end_geometry) geometry(b.end_geometry);
  if (rigid) return;
  if (parts & part_geometry) f(b.walls);
  if (parts & part_matter) {
    f(b.contents);
    f(b.volume);
  }
  if (parts & part_average) {
    f(b.average);
    f(b.role);
  }
  if (parts & part_contact) f(b.contact);
}

}  // namespace

template <int Dim>
void share(State<Dim>& state, const parallel::World& world, unsigned parts) {
  exchange(
      state.mesh, world,
      [&](int slot, parallel::Bytes& bytes) {
        for (Body<Dim>& body : state.bodies) {
          BodyBlock<Dim>& b = body.at(slot);
          parallel::pack(bytes, static_cast<char>((b.present ? 1 : 0) | (b.near_surface ? 2 : 0)));
          if (b.present)
            for_each_array(b, body.rigid.has_value(), parts, [&](const auto& v) { put(bytes, v); });
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
          for_each_array(b, body.rigid.has_value(), parts, [&](auto& v) { take(from, v); });
        }
      });
}

template void share<1>(State<1>&, const parallel::World&, unsigned);
template void share<2>(State<2>&, const parallel::World&, unsigned);
template void share<3>(State<3>&, const parallel::World&, unsigned);

}  // namespace recoil
