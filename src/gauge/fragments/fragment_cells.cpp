#include "gauge/fragments/fragment_cells.hpp"

#include <cstddef>

#include "dynamics/primitives.hpp"
#include "field/exchange.hpp"
#include "gauge/fragments/fragments.hpp"
#include "gauge/point_state.hpp"

namespace recoil {

namespace {

constexpr int body_bits = 5;  // most_bodies

void make_room(FragmentBlock& b, std::size_t cells) {
  b.hold.assign(cells, Hold::none);
  b.fill.assign(cells, 0);
  b.phi.assign(cells, 0);
  b.number.assign(cells, -1);
}

/// The matter of one cell.
template <int Dim>
void look_at_cell(const State<Dim>& state, const Body<Dim>& body, int slot, const Index<Dim>& i,
                  std::size_t k, FragmentBlock& to) {
  const BodyBlock<Dim>& b = body.at(slot);
  const double mass = b.contents[k], volume = b.volume[k];
  if (mass == 0) return;
  const double damage = b.contents[Components<Dim>::damage * b.volume.size() + k];
  const bool failed = damage > 0 && damage >= failed_damage * mass;
  double open = 0;
  if (failed && mass > 0 && volume > 0)
    open = point_state(body, contents_of(b, static_cast<int>(k)), volume).void_fraction;
  to.solid[k] = 1 - open;
  to.fill[k] = volume * (1 - open) / state.grid(slot).full_volume(i);
  to.phi[k] = b.phi[k];
  to.hold[k] = Hold::holds;
  if (!failed) return;
  if (to.fill[k] < 0.5)
    to.hold[k] = Hold::loose;
  else if (open >= least_void)
    to.hold[k] = Hold::rubble;
}

/// f(place in the layout) for the cells of a block that have a side on its edge.
template <int Dim, class F>
void for_each_outer(const Mesh<Dim>& mesh, int slot, F&& f) {
  const Box<Dim> cells = mesh.block(slot).cells, layout = mesh.grid(slot).layout();
  for_each(cells, [&](const Index<Dim>& i) {
    bool outer = false;
    for (int d = 0; d < Dim; ++d) outer = outer || i[d] == cells.lo[d] || i[d] == cells.hi[d] - 1;
    if (outer) f(static_cast<std::size_t>(layout.at(i - cells.lo)));
  });
}

/// Exchanges what `each(archive, block, place)` packs or unpacks of the outer cells of all bodies' blocks.
template <int Dim, class Pack, class Unpack>
void exchange_outer(const State<Dim>& state, const parallel::World& world,
                    std::vector<std::vector<FragmentBlock>>& all, Pack&& put, Unpack&& take) {
  exchange(
      state.mesh, world,
      [&](int slot, int, parallel::Bytes& bytes) {
        for (auto& body : all) {
          FragmentBlock& b = body[static_cast<std::size_t>(slot)];
          parallel::pack(bytes, static_cast<std::uint8_t>(b.hold.empty() ? 0 : 1));
          if (b.hold.empty()) continue;
          for_each_outer(state.mesh, slot, [&](std::size_t k) { put(bytes, b, k); });
        }
      },
      [&](int slot, parallel::Unpacker& from) {
        for (auto& body : all) {
          FragmentBlock& b = body[static_cast<std::size_t>(slot)];
          if (from.read<std::uint8_t>() == 0) continue;
          if (b.hold.empty()) make_room(b, static_cast<std::size_t>(state.grid().layout().size()));
          for_each_outer(state.mesh, slot, [&](std::size_t k) { take(from, b, k); });
        }
      });
}

}  // namespace

template <int Dim>
std::int64_t cell_number(const Mesh<Dim>& mesh, int slot, int body, const Index<Dim>& cell) {
  constexpr int bits = (63 - body_bits) / Dim;
  const Index<Dim> i = mesh.finest_index(slot, cell);
  std::int64_t number = body;
  for (int d = Dim - 1; d >= 0; --d) number = (number << bits) + i[d];
  return number;
}

template <int Dim>
std::vector<std::vector<FragmentBlock>> fragment_cells(const State<Dim>& state,
                                                       const parallel::World& world) {
  const Box<Dim> layout = state.grid().layout();
  std::vector<std::vector<FragmentBlock>> all(state.bodies.size());
  for (std::size_t m = 0; m < all.size(); ++m) {
    const Body<Dim>& body = state.bodies[m];
    all[m].resize(static_cast<std::size_t>(state.mesh.leaves()));
    for (int slot = 0; slot < state.mesh.local(); ++slot) {
      if (body.rigid || !body.present(slot)) continue;
      FragmentBlock& to = all[m][static_cast<std::size_t>(slot)];
      make_room(to, static_cast<std::size_t>(layout.size()));
      to.solid.assign(to.hold.size(), 1);
      const Box<Dim> cells = state.mesh.block(slot).cells;
      for_each(cells, [&](const Index<Dim>& i) {
        const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
        look_at_cell(state, body, slot, i, k, to);
        to.number[k] = cell_number(state.mesh, slot, static_cast<int>(m), i);
      });
    }
  }
  exchange_outer(
      state, world, all,
      [](parallel::Bytes& bytes, const FragmentBlock& b, std::size_t k) {
        parallel::pack(bytes, b.hold[k]);
        parallel::pack(bytes, b.fill[k]);
        parallel::pack(bytes, b.phi[k]);
        parallel::pack(bytes, b.number[k]);
      },
      [](parallel::Unpacker& from, FragmentBlock& b, std::size_t k) {
        b.hold[k] = from.read<Hold>();
        b.fill[k] = from.read<double>();
        b.phi[k] = from.read<double>();
        b.number[k] = from.read<std::int64_t>();
      });
  return all;
}

template <int Dim>
void exchange_numbers(const State<Dim>& state, const parallel::World& world,
                      std::vector<std::vector<FragmentBlock>>& cells) {
  exchange_outer(
      state, world, cells,
      [](parallel::Bytes& bytes, const FragmentBlock& b, std::size_t k) {
        parallel::pack(bytes, b.number[k]);
      },
      [](parallel::Unpacker& from, FragmentBlock& b, std::size_t k) {
        b.number[k] = from.read<std::int64_t>();
      });
}

#define RECOIL_INSTANTIATE(Dim)                                                                 \
  template std::int64_t cell_number<Dim>(const Mesh<Dim>&, int, int, const Index<Dim>&);        \
  template std::vector<std::vector<FragmentBlock>> fragment_cells<Dim>(const State<Dim>&,       \
                                                                       const parallel::World&); \
  template void exchange_numbers<Dim>(const State<Dim>&, const parallel::World&,                \
                                      std::vector<std::vector<FragmentBlock>>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
