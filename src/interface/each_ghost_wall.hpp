#pragma once

#include "contact/touch.hpp"
#include "interface/opposite.hpp"
#include "interface/walls.hpp"

namespace recoil {

/// Calls find(view, body, opposite, cut cell, its index, wall) for the wall of every cut cell of a block,
/// with the wall empty but for its fit and its normal, and adds its velocity to the mean of the step.
/// @param weight part of a whole step that this stage stands for; 0: nothing is recorded.
template <int Dim, class Find>
void for_each_ghost_wall(State<Dim>& state, int slot, double weight, Scratch& scratch, Find&& find) {
  if (weight > 0) clear_records(state, slot);
  const SurfaceView<Dim> v = view_surfaces(state, slot, PhiAt::midstep, scratch);
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
}

/// A wall of body m before it is known whether it touches: both sides along the direction of the contact.
template <int Dim>
struct GhostContact {
  Vec<Dim> direction;
  SurfaceState<Dim> state;
  ContactSide mine, theirs;  // of a rigid partner only the velocity
  bool rigid = false;        // the partner
  bool was = false;          // in contact in the last step

  GhostContact(const SurfaceView<Dim>& v, int m, const Opposite<Dim>& o, const Index<Dim>& i,
               const Wall<Dim>& w)
      : direction(contact_normal(v, o, w.normal)),
        state(surface_state(v.body(m).material, w.value, direction)),
        mine{state.velocity, state.stress, state.impedance},
        rigid(v.body(o.body).rigid.has_value()),
        was(v.was_in_contact(m, o.body, i) || v.was_in_contact(o.body, m, i)) {
    const Body<Dim>& other = v.body(o.body);
    if (rigid) {
      theirs.velocity = dot(other.rigid->velocity, direction);
    } else {
      const auto r = surface_state(other.material, o.value, direction);
      theirs = {r.velocity, r.stress, r.impedance};
    }
  }

  /// Puts what the contact does into the wall and the ledger.
  void apply(const SurfaceView<Dim>& v, int m, const Opposite<Dim>& o, const CutCell<Dim>& cut,
             const Touch& t, double booked, Wall<Dim>& w) const {
    w.traction = t.traction;
    w.velocity = w.face_velocity = t.first_velocity * direction + state.sliding - shear_recoil(state);
    w.partners = 1U << o.body;
    record_contact(v, m, o, cut, direction, t.traction, t.work_velocity, booked);
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
