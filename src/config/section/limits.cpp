#include "config/section/limits.hpp"

namespace recoil::config {

namespace {

Entry<Limits> part(const char* name, double Limits::*member, const char* doc, const char* example = "1e-4") {
  return {.name = name, .member = member, .least = 0, .most = 100, .doc = doc, .example = example};
}

Entry<Limits> error(const char* name, double Limits::*member, const char* doc, const char* example) {
  return {.name = name, .member = member, .positive = true, .doc = doc, .example = example};
}

}  // namespace

Entries<Limits> Limits::keys() {
  using L = Limits;
  return {
      part("averaged-states", &L::averaged_states,
           "part of a body's cell states that may be replaced by a mean with their neighbours'"),
      part("averaged-states-stop", &L::averaged_states_stop,
           "the same, of the last 100 steps: beyond it the run stops"),
      error("budget", &L::budget,
            "relative error of the mass, momentum and energy of a body (conservative scheme only)", "1e-9"),
      error("budget-stop", &L::budget_stop, "the same: beyond it the run stops", "1e-6"),
      part("centre-of-mass", &L::centre_of_mass,
           "cells by which the centre of mass of a body may be off from where its momentum has carried it, "
           "beyond 1 % of the way (conservative scheme only)",
           "1"),
      part("unstable-steps", &L::unstable_steps,
           "part of the steps that may be longer than a stable one, by a fixed-dt"),
      part("unstable-steps-stop", &L::unstable_steps_stop, "the same: beyond it the run stops", "1e-2"),
      part("first-order-faces", &L::first_order_faces, "faces that take the states of their cells"),
      part("faces-without-value", &L::faces_without_value, "faces that lack a value"),
      part("faces-at-open-edges", &L::faces_at_open_edges,
           "those within three cells of an open edge of the domain"),
      part("cuts-without-donor", &L::cuts_without_donor, "cut cells without a fit"),
      part("ghosts-without-wall", &L::ghosts_without_wall, "cells beyond a surface without a wall"),
      part("averages-kept", &L::averages_kept, "fragments whose average of the start of the step stands"),
      part("fragments-too-thin", &L::fragments_too_thin, "fragments that fits and stencils leave out"),
      part("real-cells-without-contents", &L::real_cells_without_contents,
           "ghost-fluid schemes: cells inside a body without matter"),
      part("uncovered-cells-without-value", &L::uncovered_cells_without_value,
           "ghost-fluid schemes: uncovered cells without a value"),
      part("clamped-fit-densities", &L::clamped_fit_densities, "clamped densities at surfaces"),
      part("clamped-ghost-densities", &L::clamped_ghost_densities, "clamped densities of ghosts"),
      part("unmerged-fragments", &L::unmerged_fragments, "small fragments without a partner"),
      part("lone-fragments-moved", &L::lone_fragments_moved, "those moved to the nearest large fragment"),
      part("capped-speeds", &L::capped_speeds, "cells whose surface would move more than a cell in a step"),
      part("volume-bounds", &L::volume_bounds, "cut cells whose volume passed its bounds"),
      part("volume-bounds-left", &L::volume_bounds_left, "those that no neighbour could help"),
      part("floored-sound-speeds", &L::floored_sound_speeds, "states with a speed of sound below the least"),
      part("cleared-strains", &L::cleared_strains,
           "plastic strains or heatings below zero that were set to zero"),
      part("negative-plastic-strain", &L::negative_plastic_strain, "plastic strain below zero"),
      part("negative-heating", &L::negative_heating,
           "heat that is missing in cells of a body colder than at the start; by energy, colder than the "
           "isentrope through the start by more than noise: part of the internal energy that all bodies took "
           "up"),
      part("overfilled-cells", &L::overfilled_cells,
           "part of a body's matter beyond whole cells, in those with more than volume-fraction"),
      part("volume-fraction", &L::volume_fraction, "of all bodies in a cell", "1.1"),
      part("density", &L::density, "whole cells with a density that the equation of state does not describe"),
      part("tension", &L::tension, "whole cells under more tension than the material bears"),
      part("largest-tension", &L::largest_tension,
           "what a material without a spall-strength bears, as part of its bulk modulus", "0.05"),
      part("spall-strength", &L::spall_strength,
           "what a material with a spall-strength bears, as a multiple of it", "2"),
      part("melting", &L::melting,
           "whole cells hotter by their internal energy than the melting temperature, where by plastic work "
           "alone they are not"),
      part("thickness", &L::thickness, "cells across the thinnest part of each deformable body", "4")};
}

}  // namespace recoil::config
