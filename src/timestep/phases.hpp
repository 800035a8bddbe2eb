#pragma once

#include <vector>

#include "cutcell/geometry.hpp"
#include "cutcell/share.hpp"
#include "timestep/step.hpp"

namespace recoil {

/// The phases of a step, each one loop over blocks. Within a phase a block writes only its own data and reads
/// only data that the phase does not write, so that blocks may run in any order and on any thread.
template <int Dim>
class Phases {
 public:
  Phases(State<Dim>& state, Engine& engine);

  /// Chooses what each piece is good for, and finds the primitives of all averages.
  void average_states();
  /// The stable step, cut to end at `until`. @throws PhysicsError if it collapses.
  double choose_length(const Stepping& stepping, double until);
  void keep_old();
  /// phi_next = phi half a step on, with the last step's carrier.
  void carry_surfaces_half(double dt);
  void cut_cells(Surfaces surfaces, PhiAt when);
  void choose_donors_and_ghosts();

  void find_walls(double dt, double share);
  void fill_values();
  void update_matter(double dt, double share);
  void redistribute_small_pieces();
  /// Averages inadmissible states with what is around them, in wider and wider windows, and counts them.
  void mend_bad_states();
  void return_to_yield(double dt, double old_part);
  /// Primitives of the new averages, with the roles of the step.
  void refresh_averages();

  /// To the end of the step; free ones with what their contacts have given them.
  void move_rigid_bodies(double dt);
  void carry_surfaces(double dt);
  void remember_contact();
  void redistance(double dt);
  void exchange_along_surfaces();
  void follow_volumes();
  void empty_and_fill();
  void bound_volumes();
  void update_bands();

  void share(unsigned parts);

 private:
  template <class F>
  void for_each_body(StepPart part, F&& f);  // f(body, slot, scratch), deformable bodies where they are
  template <class F>
  void for_each_slot(StepPart part, F&& f);  // f(slot, scratch)
  Counters& counters(int slot) { return state_.ledger[static_cast<std::size_t>(slot)].counters; }
  void swap_phi();
  void place_rigid_bodies(double ahead, PhiAt where);
  void apply(StepPart part);

  State<Dim>& state_;
  Engine& engine_;
  std::vector<int> blocks_;  // local slots that hold a deformable body
};

}  // namespace recoil
