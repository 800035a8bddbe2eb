#pragma once

#include <vector>

#include "cutcell/geometry.hpp"
#include "cutcell/whole_cells.hpp"
#include "dynamics/block_update.hpp"
#include "dynamics/classic_stages.hpp"
#include "state/share.hpp"
#include "timestep/step.hpp"

namespace recoil {

/// SSP-RK3 (Shu & Osher 1988): each stage is a full Euler step, mixed with `old_weight` of the old state;
/// `weight` is its weight in the whole step.
struct Stage {
  double old_weight, weight;
};
inline constexpr std::array<Stage, 3> ssp_rk3{{{0, 1.0 / 6}, {0.75, 1.0 / 6}, {1.0 / 3, 2.0 / 3}}};

/// The phases of a step, each one loop over blocks. Within a phase a block writes only its own data and reads
/// only data that the phase does not write, so that blocks may run in any order and on any thread.
template <int Dim>
class Phases {
 public:
  Phases(State<Dim>& state, Engine& engine);

  /// Chooses what each fragment is good for, and finds the primitives of all averages.
  void average_states();
  /// The stable step, cut to end at `until`. @throws PhysicsError if it collapses.
  double choose_length(const Stepping& stepping, double until);
  void keep_old();
  /// phi_next = phi half a step on, with the last step's extension_velocity.
  void advect_surfaces_half(double dt);
  /// @param ahead seconds from now to `when`.
  void cut_cells(Surfaces surfaces, PhiAt when, double ahead = 0);
  void choose_donors_and_ghosts(Cells cells = Cells::cut);

  void find_walls(double dt, double weight);
  void fill_values();
  void update_matter(double dt, double weight);
  void redistribute_small_fragments();
  /// Averages inadmissible states with what is around them, in wider and wider windows, and counts them.
  void average_inadmissible_states();
  void return_to_yield(double dt, double old_weight);
  /// Primitives of the new averages, with the roles of the step.
  void refresh_averages();

  /// To the end of the step; free ones with what their contacts have given them.
  void move_rigid_bodies(double dt);
  void advect_surfaces(double dt);
  void remember_contact();
  void redistance(double dt);
  /// No level set reaches into a rigid body.
  void cut_out_rigid_bodies();
  void exchange_along_surfaces();
  void follow_volumes();
  void empty_and_fill();
  void bound_volumes();
  void update_bands();

  // Phases of the ghost-fluid schemes only.
  /// The start of their step: whole cells, the stable step (returned), the surfaces half a step on, donors.
  double prepare_whole_cells(const Stepping& stepping, double until);
  /// Riemann-Signorini states of all walls, and the ghosts that speak for them.
  void find_ghosts(double dt, double weight);
  /// The same by the traction rule of the seed scheme.
  void find_seed_ghosts(double kappa, double dt, double weight);
  void update_whole_cells(FaceScheme scheme, double dt, double weight);
  /// One stage of the classical Runge-Kutta rule: Q = Q_old + length dt R, or the whole step if it is the
  /// last.
  void update_classic(FaceScheme scheme, const ClassicStage& stage, bool last, double dt);
  /// Counts cut cells that no longer touch what they touched in the last step.
  void count_lost_contacts();
  void redistance_all(int sweeps);
  /// Moves surfaces in contact a little (part `rate` of what is left) onto each other.
  void close_gaps(double rate);
  void to_cut_cells();

  void share(unsigned parts);

 private:
  template <class F>
  void for_each_body(StepPhase part, F&& f);  // f(body, slot, scratch), deformable bodies where they are
  template <class F>
  void for_each_slot(StepPhase part, F&& f);  // f(slot, scratch)
  Counters& counters(int slot) { return state_.ledger[slot].counters; }
  void to_whole_cells();
  /// Cuts every body by its own mid-step level set, `ahead` seconds from now, with the donors in the middle
  /// of their whole cells.
  void find_surfaces(double ahead);
  template <class Find>
  void find_ghosts_by(Find&& find);
  void swap_phi();
  void follow_mismatch(double rate);
  void place_rigid_bodies(double ahead, PhiAt where);
  void apply(StepPhase part);

  State<Dim>& state_;
  Engine& engine_;
  std::vector<int> blocks_;  // local slots that hold a deformable body
};

template <int Dim>
template <class F>
void Phases<Dim>::for_each_slot(StepPhase part, F&& f) {
  const Timers<StepPhase>::Span span(engine_.timers, part);
  parallel::for_each_block(engine_.team, blocks_, f);
}

template <int Dim>
template <class F>
void Phases<Dim>::for_each_body(StepPhase part, F&& f) {
  for_each_slot(part, [&](int slot, Scratch& scratch) {
    for (Body<Dim>& body : state_.bodies) {
      if (body.rigid || !body.present(slot)) continue;
      const Scratch::Frame frame(scratch);
      f(body, slot, scratch);
    }
  });
}

}  // namespace recoil
