#include "state/contact_sums.hpp"

#include <algorithm>
#include <cstddef>

namespace recoil {

namespace {

/// Empties what the last stage saw of a pair; what it has exchanged so far stays.
template <int Dim>
void start_stage(PairRecord<Dim>& p) {
  const auto exchanged = p.exchanged;
  const auto moment = p.moment;
  p = {};
  p.exchanged = exchanged;
  p.moment = moment;
}

/// Where a contact acts: on a rigid body that has moved across an edge of a period, where that is now.
template <int Dim>
Vec<Dim> place_of(const State<Dim>& state, const Contact<Dim>& c) {
  const auto& rigid = state.bodies[c.second].rigid;
  return rigid ? nearest_image(*rigid, {rigid->centre, rigid->turn}, c.point) : c.point;
}

}  // namespace

template <int Dim>
void book_contacts(State<Dim>& state, int slot, double booked) {
  auto& pairs = state.ledger[slot].pairs;
  for (PairRecord<Dim>& p : pairs) start_stage(p);
  const double dx = state.grid().dx;
  for (const Contact<Dim>& c : state.contacts[slot]) {
    if (!counts(state, c)) continue;
    PairRecord<Dim>& r =
        pairs[pair_number(std::min(c.first, c.second), std::max(c.first, c.second), state.count())];
    const Vec<Dim> force = force_on_lower(c);
    const Vec<3> moment = cross(place_of(state, c), force);
    r.moment += booked * moment;
    r.exchanged.momentum += booked * force;
    r.force += force;
    r.place += c.area * c.point;
    r.exchanged.energy += booked * power_to_lower(c);
    r.area += c.area;
    r.traction += c.traction * c.area;
    r.velocity += c.work_velocity * c.area;
    r.gap += c.gap * c.area;
    r.widest_gap = std::max(r.widest_gap, c.gap / dx);
    r.deepest_overlap = std::min(r.deepest_overlap, c.gap / dx);
  }
}

template void book_contacts<1>(State<1>&, int, double);
template void book_contacts<2>(State<2>&, int, double);
template void book_contacts<3>(State<3>&, int, double);

}  // namespace recoil
