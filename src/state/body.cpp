#include "state/body.hpp"

#include <cstddef>
#include <type_traits>

#include "state/fields.hpp"

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
          {"ghosts-without-wall", &ghosts_without_wall},
          {"averages-kept", &averages_kept},
          {"fragments-too-thin", &fragments_too_thin},
          {"real-cells-without-contents", &real_cells_without_contents},
          {"uncovered-cells-without-value", &uncovered_cells_without_value},
          {"clamped-fit-densities", &clamped_fit_densities},
          {"clamped-ghost-densities", &clamped_ghost_densities},
          {"averaged-states", &averaged_states},
          {"3^d-neighbourhoods", &wide_neighbourhoods},
          {"5^d-neighbourhoods", &widest_neighbourhoods},
          {"unmerged-fragments", &unmerged_fragments},
          {"lone-fragments-moved", &lone_fragments_moved},
          {"capped-speeds", &capped_speeds},
          {"volume-bounds", &volume_bounds},
          {"volume-bounds-left", &volume_bounds_left},
          {"floored-sound-speeds", &floored_sound_speeds},
          {"contacts-lost", &contacts_lost},
          {"cleared-strains", &cleared_strains},
          {"clamped-damage", &clamped_damage},
          {"clamped-distensions", &clamped_distensions},
          {"torn-states", &torn_states},
          {"flat-refinements", &flat_refinements},
          {"faces-of-dust", &faces_of_dust},
          {"cuts-of-dust", &cuts_of_dust},
          {"faces-at-open-edges", &faces_at_open_edges},
          {"opened-cells", &opened_cells},
          {"restored-cells", &restored_cells},
          {"pushed-contacts", &pushed_contacts},
          {"fragments-without-body", &fragments_without_body}};
}

template <int Dim>
void enter_block(Body<Dim>& body, int slot, const Grid<Dim>& grid) {
  BodyBlock<Dim>& b = body.at(slot);
  if (b.present) return;
  const auto cells = static_cast<std::size_t>(grid.layout().size());
  b.present = true;
  b.near_surface = true;
  for_each_field<Dim>([&](const auto& d) {
    if (!d.allocated() || (body.rigid && !d.of_rigid)) return;
    for_each_array(b.*d.member, [&](auto& array) {
      const auto n = cells * static_cast<std::size_t>(d.components);
      using T = typename std::remove_cvref_t<decltype(array)>::value_type;
      if constexpr (std::is_same_v<T, int>)
        array.raw().assign(n, -1);  // places in a list
      else if constexpr (std::is_same_v<T, double>)
        array.raw().assign(n, usually_far(d.id) ? far_cells * grid.dx : 0.0);
      else if constexpr (!std::is_same_v<T, CutCell<Dim>>)
        array.raw().assign(n, T{});
    });
  });
}

template <int Dim>
void leave_block(Body<Dim>& body, int slot) {
  body.at(slot) = BodyBlock<Dim>{};
}

template <int Dim>
void apply_updates(BodyBlock<Dim>& block) {
  const std::size_t n = block.volume.size();
  double *volume = block.volume.data(), *contents = block.contents.data();
  for (const Update<Dim>& u : block.updates) {
    const auto k = static_cast<std::size_t>(u.cell);
    volume[k] = u.volume;
    for (std::size_t c = 0; c < u.contents.size(); ++c) contents[c * n + k] = u.contents[c];
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
