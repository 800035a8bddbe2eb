#pragma once

#include <cstddef>
#include <vector>

#include "mesh/mesh.hpp"

namespace recoil {

/// Brings the copies of other processes' blocks up to date. `pack(slot, rank, bytes)` writes what a block
/// sends to a process, `unpack(slot, reader)` reads it into the copy, in the same order. Collective; nothing
/// to do on one process whose blocks have no peers.
template <int Dim, class Pack, class Unpack>
void exchange(const Mesh<Dim>& mesh, const parallel::World& world, Pack&& pack, Unpack&& unpack) {
  if (mesh.peers().empty()) return;
  std::vector<parallel::Message> out;
  std::vector<int> from;
  for (const auto& peer : mesh.peers()) {
    out.push_back({peer.rank, {}});
    for (const int slot : peer.send) pack(slot, peer.rank, out.back().bytes);
    from.push_back(peer.rank);
  }
  const auto in = world.exchange(out, from);
  for (std::size_t p = 0; p < in.size(); ++p) {
    parallel::Unpacker reader(in[p].bytes);
    for (const int slot : mesh.peers()[p].receive) unpack(slot, reader);
  }
}

}  // namespace recoil
