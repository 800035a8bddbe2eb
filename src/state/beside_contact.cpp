#include "state/beside_contact.hpp"

#include <algorithm>
#include <cstddef>
#include <variant>

namespace recoil {

template <int Dim>
std::uint32_t sliding_partners(const State<Dim>& state, const Body<Dim>& body) {
  const int own = static_cast<int>(&body - state.bodies.data()), count = state.count();
  std::uint32_t bits = 0;
  for (int m = 0; m < count; ++m)
    if (m != own && state.contact[pair_number(std::min(m, own), std::max(m, own), count)].mode ==
                        ContactLaw::Mode::separable)
      bits |= 1U << m;
  return bits;
}

template <int Dim>
void mark_beside_contact(const State<Dim>& state, Body<Dim>& body, int slot, Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  if (!std::holds_alternative<Elastic>(body.material.strength) || !b.near_surface || b.reach.size() == 0)
    return;
  const Window<Dim> w(state.mesh, slot, contact_reach, b.reach);
  const auto n = static_cast<std::size_t>(w.size());
  auto* partners = scratch.take<std::uint32_t>(n);
  w.gather([&](int s) { return body.present(s) ? body.at(s).contact.data() : nullptr; }, std::uint32_t{0},
           Beyond::mirror, partners);
  const std::uint32_t sliding = sliding_partners(state, body);
  for (std::size_t k = 0; k < n; ++k) partners[k] &= sliding;
  if (std::all_of(partners, partners + n, [](std::uint32_t p) { return p == 0; })) return;
  for_each(w.box(), [&](const Index<Dim>& pressed) {
    if (partners[w.at(pressed)] == 0) return;
    Box<Dim> around;
    for (int d = 0; d < Dim; ++d) {
      around.lo[d] = std::max(pressed[d] - contact_reach, b.reach.lo[d]);
      around.hi[d] = std::min(pressed[d] + contact_reach + 1, b.reach.hi[d]);
      if (around.lo[d] >= around.hi[d]) return;
    }
    for_each(around, [&](const Index<Dim>& i) {
      int square = 0;
      for (int d = 0; d < Dim; ++d) square += (i[d] - pressed[d]) * (i[d] - pressed[d]);
      if (square <= contact_reach * contact_reach) b.role[w.cell(i)] |= beside_contact;
    });
  });
}

#define RECOIL_INSTANTIATE(Dim)                                                      \
  template std::uint32_t sliding_partners<Dim>(const State<Dim>&, const Body<Dim>&); \
  template void mark_beside_contact<Dim>(const State<Dim>&, Body<Dim>&, int, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
