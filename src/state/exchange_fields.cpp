#include "state/exchange_fields.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include "core/error.hpp"
#include "parallel/post.hpp"
#include "parallel/traffic.hpp"
#include "state/near_cells.hpp"

namespace recoil {

namespace {

/// The cells of one block that one process needs, by reach; found when they are asked for.
template <int Dim>
class Rims {
 public:
  Rims(const Mesh<Dim>& mesh, int slot, int rank, ReadAround read)
      : mesh_(mesh), slot_(slot), rank_(rank), read_(read) {}
  const NearCells& of(Field field) {
    // Walls are found by their number among the cut cells: both lists leave out the same ones.
    const bool numbered = field == Field::geometry || field == Field::walls;
    int reach = numbered ? reach_of(field) : std::min(read_.cells, reach_of(field));
    if (field == Field::contents) reach = std::min(reach, reach_of(read_.contents));
    auto& found = by_reach_[static_cast<std::size_t>(reach)];
    if (!found) found = cells_near(mesh_, slot_, rank_, reach);
    return *found;
  }

 private:
  const Mesh<Dim>& mesh_;
  int slot_, rank_;
  ReadAround read_;
  std::array<std::optional<NearCells>, widest_halo + 1> by_reach_;
};

/// Writes values one after the other into room that was made for them.
class Writer {
 public:
  Writer(parallel::Bytes& bytes, std::size_t room) : bytes_(bytes), at_(bytes.size()) {
    bytes.resize(at_ + room);
  }
  ~Writer() { bytes_.resize(at_); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  template <class T>
  void write(const T& value) {
    std::memcpy(bytes_.data() + at_, &value, sizeof(T));
    at_ += sizeof(T);
  }

 private:
  parallel::Bytes& bytes_;
  std::size_t at_;
};

/// A copy has the bits of the original, so -0 is not 0 here; bytes between members may differ, which costs
/// room only.
template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;  // NOLINT(bugprone-suspicious-memory-comparison)
}

/// f(place in the layout, number among the cells).
template <class F>
void for_each_cell(const NearCells& near, F&& f) {
  std::size_t j = 0;
  for (const CellRun& run : near.runs)
    for (int k = run.first; k < run.first + run.cells; ++k) f(static_cast<std::size_t>(k), j++);
}

/// Of cells that are not sent: in debug builds no number, which shows in what reads it.
template <class T>
constexpr T not_sent() {
#ifndef NDEBUG
  if constexpr (std::is_same_v<T, double>) return std::numeric_limits<double>::quiet_NaN();
#endif
  return T{};
}

/// A bit for each of the cells: whether a component differs from the value of cells without matter; then all
/// components of those that do.
/// @param chosen by place in the layout: the cells that are sent; empty: all.
template <class T>
void put_cells(parallel::Bytes& bytes, const std::vector<T>& v, const NearCells& near, const T& usual,
               const std::vector<std::uint8_t>& chosen = {}) {
  const auto value = [&](std::size_t k, std::size_t component) {
    return chosen.empty() || chosen[k] != 0 ? v[component * near.holds.size() + k] : not_sent<T>();
  };
  parallel::pack(bytes, static_cast<char>(v.empty() ? 0 : 1));
  if (v.empty()) return;
  const std::size_t components = v.size() / near.holds.size(), cells = static_cast<std::size_t>(near.count);
  std::vector<std::uint8_t> mask((cells + 7) / 8, 0);
  for (std::size_t c = 0; c < components; ++c)
    for_each_cell(near, [&](std::size_t k, std::size_t j) {
      if (!same_bits(value(k, c), usual)) mask[j / 8] |= static_cast<std::uint8_t>(1U << j % 8);
    });
  parallel::pack(bytes, mask.data(), mask.size());
  Writer writer(bytes, cells * components * sizeof(T));
  for (std::size_t c = 0; c < components; ++c)
    for_each_cell(near, [&](std::size_t k, std::size_t j) {
      if ((mask[j / 8] >> j % 8 & 1U) != 0) writer.write(value(k, c));
    });
}

/// In debug builds cells that are not sent are no numbers: what reads them shows.
template <class T>
void spoil([[maybe_unused]] std::vector<T>& v) {
#ifndef NDEBUG
  if constexpr (std::is_same_v<T, double>)
    std::fill(v.begin(), v.end(), std::numeric_limits<double>::quiet_NaN());
#endif
}

template <class T>
void take_cells(parallel::Unpacker& from, std::vector<T>& v, std::size_t components, const NearCells& near,
                const T& usual) {
  if (from.read<char>() == 0) return v.clear();
  const std::size_t n = near.holds.size();
  if (v.size() != components * n) v.assign(components * n, usual);
  spoil(v);
  std::vector<std::uint8_t> mask((static_cast<std::size_t>(near.count) + 7) / 8);
  from.read(mask.data(), mask.size());
  for (std::size_t c = 0; c < components; ++c)
    for_each_cell(near, [&](std::size_t k, std::size_t j) {
      v[c * n + k] = (mask[j / 8] >> j % 8 & 1U) != 0 ? from.read<T>() : usual;
    });
}

/// f(number) for the cut cells of a block that are needed.
template <int Dim, class F>
void for_each_cut(const Geometry<Dim>& geometry, const NearCells& near, F&& f) {
  const auto& cuts = geometry.cuts.raw();
  for (std::size_t k = 0; k < cuts.size(); ++k)
    if (near.holds[static_cast<std::size_t>(cuts[k].cell)] != 0) f(k);
}

/// The number of the cut cells that are needed, then what `put(number)` packs of each.
template <int Dim, class F>
void put_cuts(parallel::Bytes& bytes, const Geometry<Dim>& geometry, const NearCells& near, F&& put) {
  std::uint64_t count = 0;
  for_each_cut(geometry, near, [&](std::size_t) { ++count; });
  parallel::pack(bytes, count);
  for_each_cut(geometry, near, put);
}

template <class T>
void take_list(parallel::Unpacker& from, std::vector<T>& list) {
  list.resize(from.read<std::uint64_t>());
  from.read(list.data(), list.size());
}

template <class T>
void put_list(parallel::Bytes& bytes, const std::vector<T>& list) {
  parallel::pack(bytes, static_cast<std::uint64_t>(list.size()));
  parallel::pack(bytes, list.data(), list.size());
}

/// What a field of doubles holds where nothing of the body is (enter_block).
double usual_value(Field field, double dx) { return usually_far(field) ? far_cells * dx : 0.0; }

/// One field of one block, as its owner sends it.
template <int Dim>
struct Sending {
  parallel::Bytes& bytes;
  const State<Dim>& state;
  const Body<Dim>& body;
  int slot;
  Rims<Dim>& rims;
  const ReadAround& read;

  template <class T>
  void operator()(const auto& declaration, const FieldArray<T>& array) const {
    if (declaration.extent == Extent::cells) {
      T usual{};
      if constexpr (std::is_same_v<T, double>) usual = usual_value(declaration.id, state.grid().dx);
      put_cells(bytes, array.raw(), rims.of(declaration.id), usual, chosen(declaration.id));
    } else if constexpr (std::is_same_v<T, Wall<Dim>>) {
      put_walls(array.raw());
    } else {
      put_list(bytes, array.raw());
    }
  }
  void operator()(const auto& declaration, const Geometry<Dim>& geometry) const {
    const NearCells& near = rims.of(declaration.id);
    put_cells(bytes, geometry.kind.raw(), near, CellKind::empty);
    put_cuts(bytes, geometry, near, [&](std::size_t k) { parallel::pack(bytes, geometry.cuts.raw()[k]); });
  }
  void operator()(const auto& /*declaration*/, const Donors<Dim>& donors) const {
    put_list(bytes, donors.cells.raw());
    put_list(bytes, donors.parts.raw());
  }

 private:
  const std::vector<std::uint8_t>& asked(MarkedCells AskedCells::*which) const {
    require(read.asked != nullptr, "cells were asked for");
    return (read.asked->*which).of(slot, static_cast<std::size_t>(&body - state.bodies.data()));
  }

  /// The cells of which a field is sent; empty: all.
  std::vector<std::uint8_t> chosen(Field field) const {
    if (field == Field::contents) return cells_with_sent_contents(state, body, slot, read);
    if (field != Field::average || read.averages == AveragesSent::all) return {};
    std::vector<std::uint8_t> cells = asked(&AskedCells::donors);
    cells.resize(static_cast<std::size_t>(state.grid(slot).layout().size()), 0);
    return cells;
  }

  /// Of each wall whether all of it follows, and that or what WallsSent says.
  void put_walls(const std::vector<Wall<Dim>>& walls) const {
    const Geometry<Dim>& geometry = body.at(slot).geometry;
    const NearCells none{{}, std::vector<char>(rims.of(Field::geometry).holds.size(), 0), 0};
    require(walls.empty() || walls.size() == geometry.cuts.raw().size(), "a wall for each cut cell");
    put_cuts(bytes, geometry, walls.empty() ? none : rims.of(Field::geometry), [&](std::size_t k) {
      bool whole = read.walls == WallsSent::all;
      if (read.walls == WallsSent::asked) {
        const auto& cells = asked(&AskedCells::walls);
        whole = !cells.empty() && cells[static_cast<std::size_t>(geometry.cuts.raw()[k].cell)] != 0;
      }
      parallel::pack(bytes, whole);
      if (whole)
        parallel::pack(bytes, walls[k]);
      else if (read.walls == WallsSent::donors)
        parallel::pack(bytes, walls[k].donors);
      else
        pack_motion(walls[k], bytes);
    });
  }
};

/// The same where it arrives.
template <int Dim>
struct Receiving {
  parallel::Unpacker& from;
  Rims<Dim>& rims;
  double dx;
  const ReadAround& read;

  template <class T>
  void operator()(const auto& declaration, FieldArray<T>& array) const {
    if (declaration.extent == Extent::cells) {
      T usual{};
      if constexpr (std::is_same_v<T, double>) usual = usual_value(declaration.id, dx);
      take_cells(from, array.raw(), static_cast<std::size_t>(declaration.components), rims.of(declaration.id),
                 usual);
    } else if constexpr (std::is_same_v<T, Wall<Dim>>) {
      take_walls(array.raw());
    } else {
      take_list(from, array.raw());
    }
  }
  void operator()(const auto& declaration, Geometry<Dim>& geometry) const {
    const NearCells& near = rims.of(declaration.id);
    take_cells(from, geometry.kind.raw(), 1, near, CellKind::empty);
    take_list(from, geometry.cuts.raw());
    auto& index = geometry.index.raw();
    index.assign(near.holds.size(), -1);
    int k = 0;
    for (const CutCell<Dim>& cut : geometry.cuts.raw()) index[static_cast<std::size_t>(cut.cell)] = k++;
  }
  void operator()(const auto& /*declaration*/, Donors<Dim>& donors) const {
    take_list(from, donors.cells.raw());
    take_list(from, donors.parts.raw());
  }

 private:
  void take_walls(std::vector<Wall<Dim>>& walls) const {
    walls.resize(from.read<std::uint64_t>());
    for (Wall<Dim>& wall : walls) {
      if (from.read<bool>()) {
        wall = from.read<Wall<Dim>>();
      } else if (read.walls == WallsSent::donors) {
        wall = {};
        wall.donors = from.read<int>();
      } else {
        wall = unpack_motion<Dim>(from);
      }
    }
  }
};

/// Calls f(declaration, field) for the fields that the body has, in one order for sender and receiver.
template <int Dim, class F>
void for_each_sent(auto& block, bool rigid, FieldSet fields, F&& f) {
  for_each_field<Dim>([&](const auto& declaration) {
    if (!fields.has(declaration.id) || (rigid && !declaration.of_rigid)) return;
    f(declaration, block.*declaration.member);
  });
}

}  // namespace

template <int Dim>
parallel::Bytes pack_fields(const State<Dim>& state, const typename Mesh<Dim>::Peer& peer, FieldSet fields,
                            const ReadAround& read) {
  parallel::Bytes bytes;
  for (const int slot : peer.send) {
    Rims<Dim> rims(state.mesh, slot, peer.rank, read);
    for (const Body<Dim>& body : state.bodies) {
      const BodyBlock<Dim>& b = body.at(slot);
      parallel::pack(bytes, static_cast<std::uint8_t>((b.present ? 1 : 0) | (b.near_surface ? 2 : 0)));
      if (b.present)
        for_each_sent<Dim>(b, body.rigid.has_value(), fields,
                           Sending<Dim>{bytes, state, body, slot, rims, read});
    }
  }
  return bytes;
}

template <int Dim>
void unpack_fields(State<Dim>& state, const typename Mesh<Dim>::Peer& peer, int own_rank, FieldSet fields,
                   const ReadAround& read, const parallel::Bytes& bytes) {
  const double dx = state.grid().dx;
  parallel::Unpacker from(bytes);
  for (const int slot : peer.receive) {
    Rims<Dim> rims(state.mesh, slot, own_rank, read);
    for (Body<Dim>& body : state.bodies) {
      const auto flags = from.read<std::uint8_t>();
      if ((flags & 1) == 0) {
        leave_block(body, slot);
        continue;
      }
      enter_block(body, slot, state.grid());
      BodyBlock<Dim>& b = body.at(slot);
      b.near_surface = (flags & 2) != 0;
      for_each_sent<Dim>(b, body.rigid.has_value(), fields, Receiving<Dim>{from, rims, dx, read});
    }
  }
}

template <int Dim>
void exchange_fields(State<Dim>& state, const parallel::World& world, FieldSet fields,
                     const ReadAround& read) {
  const auto& peers = state.mesh.peers();
  if (peers.empty()) return;
  ++parallel::counted_traffic().exchanges;
  for (const auto& peer : peers) parallel::post(peer.rank, pack_fields(state, peer, fields, read));
  for (const auto& peer : peers)
    unpack_fields(state, peer, world.rank(), fields, read, parallel::wait_for_posted(peer.rank));
}

#define RECOIL_INSTANTIATE(Dim)                                                                           \
  template parallel::Bytes pack_fields<Dim>(const State<Dim>&, const Mesh<Dim>::Peer&, FieldSet,          \
                                            const ReadAround&);                                           \
  template void unpack_fields<Dim>(State<Dim>&, const Mesh<Dim>::Peer&, int, FieldSet, const ReadAround&, \
                                   const parallel::Bytes&);                                               \
  template void exchange_fields<Dim>(State<Dim>&, const parallel::World&, FieldSet, const ReadAround&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
