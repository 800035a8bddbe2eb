#pragma once

#include <algorithm>
#include <cstddef>

#include "contact/touch.hpp"
#include "interface/opposite.hpp"
#include "interface/surface_state.hpp"
#include "state/contact_sums.hpp"

namespace recoil {

/// Calls find(view, body, opposite, cut cell, its index, wall) for the wall of every cut cell of a block,
/// with the wall empty but for its fit and its normal, and adds its velocity to the mean of the step. Begins
/// the block's list of contacts anew and books what is in it.
/// @param weight part of a whole step that this stage stands for; 0: nothing is booked.
template <int Dim, class Find>
void for_each_ghost_wall(State<Dim>& state, int slot, double dt, double weight, Scratch& scratch,
                         Find&& find) {
  state.contacts[slot].clear();
  const SurfaceView<Dim> v = view_surfaces(state, slot, opposite_sight, scratch);
  for (int m = 0; m < state.count(); ++m) {
    Body<Dim>& body = state.bodies[m];
    if (body.rigid || !body.present(slot)) continue;
    BodyBlock<Dim>& b = body.at(slot);
    for (std::size_t k = 0; k < b.walls.size(); ++k) {
      const CutCell<Dim>& cut = b.geometry.cuts[k];
      const Index<Dim> i = state.mesh.block(slot).cells.lo + state.grid().layout().index(cut.cell);
      Wall<Dim>& w = b.walls[k];
      w.normal = v.normal(m, i);
      w.partners = 0;
      w.traction = 0;
      find(v, m, w.donors > 0 ? find_opposite(v, m, cut.point, i) : Opposite<Dim>{}, cut, i, w);
      w.mean_velocity += weight * w.velocity;
    }
  }
  if (weight > 0) book_contacts(state, slot, weight * dt);
}

/// A wall of body m before it is known whether it touches: both sides along the direction of the contact.
template <int Dim>
struct GhostContact {
  Vec<Dim> direction;
  SurfaceState<Dim> state;
  ContactSide mine, theirs;  // of a rigid partner only the velocity
  Vec<Dim> other_sliding;    // velocity of the partner's surface across the direction
  bool rigid = false;        // the partner
  bool was = false;          // in contact in the last step

  GhostContact(const SurfaceView<Dim>& v, int m, const Opposite<Dim>& o, const CutCell<Dim>& cut,
               const Index<Dim>& i, const Wall<Dim>& w)
      : direction(contact_normal(v, o, w.normal)),
        state(surface_state(v.body(m).material, w.value, direction)),
        mine{state.velocity, state.stress, state.impedance},
        rigid(v.body(o.body).rigid.has_value()),
        was(v.was_in_contact(m, o.body, i)) {
    if (rigid) {
      const Vec<Dim> wall = velocity_of(v, o, cut.point);
      theirs.velocity = dot(wall, direction);
      other_sliding = wall - theirs.velocity * direction;
    } else {
      const auto r = surface_state(v.body(o.body).material, o.value, direction);
      theirs = {r.velocity, r.stress, r.impedance};
      other_sliding = r.sliding + shear_recoil(r);
    }
  }

  /// Puts what the contact does into the wall and into the list of contacts.
  void apply(const SurfaceView<Dim>& v, int m, const Opposite<Dim>& o, const CutCell<Dim>& cut,
             const Touch& t, Wall<Dim>& w) const {
    w.traction = t.traction;
    w.velocity = w.face_velocity = t.first_velocity * direction + state.sliding - shear_recoil(state);
    w.partners = 1U << o.body;
    v.state.contacts[v.slot].push_back({.cell = cut.cell,
                                        .first = m,
                                        .second = o.body,
                                        .one_sided = true,
                                        .direction = direction,
                                        .point = cut.point,
                                        .area = std::max(dot(cut.surface, direction), 0.0),
                                        .traction = t.traction,
                                        .shear = {},
                                        .work_velocity = t.work_velocity,
                                        .shear_velocity = {},
                                        .slip = state.sliding - shear_recoil(state) - other_sliding,
                                        .gap = o.gap});
  }
};

/// A wall that nothing presses on.
template <int Dim>
void release(const Material& material, Wall<Dim>& w) {
  const auto s = surface_state(material, w.value, w.normal);
  w.velocity = w.face_velocity =
      free_velocity(s.velocity, s.stress, s.impedance) * w.normal + s.sliding - shear_recoil(s);
}

}  // namespace recoil
