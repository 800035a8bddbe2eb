#include "state/body.hpp"

namespace recoil {

Counters& Counters::operator+=(const Counters& b) {
  Counters other = b;
  auto mine = list(), theirs = other.list();
  for (std::size_t i = 0; i < mine.size(); ++i) *mine[i].second += *theirs[i].second;
  return *this;
}

std::vector<std::pair<const char*, std::int64_t*>> Counters::list() {
  return {{"first-order-faces", &first_order_faces},
          {"faces-without-value", &faces_without_value},
          {"cuts-without-donor", &cuts_without_donor},
          {"averaged-states", &averaged_states},
          {"3^d-neighbourhoods", &wide_neighbourhoods},
          {"5^d-neighbourhoods", &widest_neighbourhoods},
          {"unmerged-fragments", &unmerged_fragments},
          {"lone-fragments-moved", &lone_fragments_moved},
          {"capped-speeds", &capped_speeds},
          {"volume-bounds", &volume_bounds},
          {"volume-bounds-left", &volume_bounds_left},
          {"floored-sound-speeds", &floored_sound_speeds},
          {"contacts-lost", &contacts_lost}};
}

template <int Dim>
void enter_block(Body<Dim>& body, int slot, const Grid<Dim>& grid) {
  BodyBlock<Dim>& b = body.at(slot);
  if (b.present) return;
  const auto n = static_cast<std::size_t>(grid.layout().size());
  using C = Components<Dim>;
  b.present = true;
  b.near_surface = true;
  b.phi.assign(n, far_cells * grid.dx);
  b.phi_next = b.phi;
  b.geometry.kind.assign(n, CellKind::empty);
  b.geometry.index.assign(n, -1);
  b.end_geometry = b.geometry;
  if (body.rigid) return;
  b.contents.assign(n * C::contents, 0);
  b.contents_old.assign(n * C::contents, 0);
  b.volume.assign(n, 0);
  b.volume_old.assign(n, 0);
  b.extension_velocity.assign(n * Dim, 0);
  b.average.assign(n * C::primitives, 0);
  b.role.assign(n, 0);
  b.contact.assign(n, 0);
}

template <int Dim>
void leave_block(Body<Dim>& body, int slot) {
  body.at(slot) = BodyBlock<Dim>{};
}

template <int Dim>
void apply_updates(BodyBlock<Dim>& block) {
  const std::size_t n = block.volume.size();
  for (const Update<Dim>& u : block.updates) {
    const auto k = static_cast<std::size_t>(u.cell);
    block.volume[k] = u.volume;
    for (std::size_t c = 0; c < u.contents.size(); ++c) block.contents[c * n + k] = u.contents[c];
  }
  block.updates.clear();
}

#define RECOIL_INSTANTIATE(Dim)                                      \
  template void enter_block<Dim>(Body<Dim>&, int, const Grid<Dim>&); \
  template void leave_block<Dim>(Body<Dim>&, int);                   \
  template void apply_updates<Dim>(BodyBlock<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
