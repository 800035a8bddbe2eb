#pragma once

#include "config/declare/entry.hpp"

namespace recoil::config {

/// What a run may show and still be called valid. Parts are of all states of cells: cells with matter, summed
/// over the steps, unless said otherwise. Those of counters go by the counters' names in summary.json.
struct Limits {
  double first_order_faces = 1e-2, faces_without_value = 1e-4, faces_at_open_edges = 1e-2,
         cuts_without_donor = 1e-3, ghosts_without_wall = 1e-3, averages_kept = 1e-5,
         fragments_too_thin = 1e-3, real_cells_without_contents = 1e-3, uncovered_cells_without_value = 1e-3,
         clamped_fit_densities = 1e-3, clamped_ghost_densities = 1e-3, averaged_states = 1e-5,
         unmerged_fragments = 1e-3, lone_fragments_moved = 1e-3, capped_speeds = 1e-5, volume_bounds = 1e-2,
         volume_bounds_left = 1e-2, floored_sound_speeds = 1e-3, cleared_strains = 1e-3,
         negative_plastic_strain = 1e-5, negative_heating = 1e-2, overfilled_cells = 1e-3, density = 1e-5,
         tension = 1e-2, melting = 1e-3;
  double largest_tension = 0.05;       // of the bulk modulus, without a spall strength
  double spall_strength = 1;           // of the material's own
  double volume_fraction = 1.1;        // of all bodies in a cell
  double thickness = 4;                // cells
  double centre_of_mass = 1;           // cells
  double budget = 1e-9;                // relative error
  double budget_stop = 1e-6;           // relative error
  double averaged_states_stop = 1e-2;  // part of the cells' states of the last 100 steps
  double unstable_steps = 0;           // part of the steps
  double unstable_steps_stop = 1e-2;   // part of the steps

  static constexpr const char* doc =
      "What makes a run doubtful, or stops it. Parts are of the states of all cells with matter in all "
      "steps, unless said otherwise.";
  static Entries<Limits> keys();
};

}  // namespace recoil::config
