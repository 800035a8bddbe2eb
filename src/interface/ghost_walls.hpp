#pragma once

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

/// The walls of the ghost-fluid scheme: what meets each surface point, found for each body on its own. Of the
/// bodies whose level set at x_I is below dx the nearest one is the partner, if the normals oppose each other
/// (n_m . n_k < -0.7); then contact/touch decides between the two fitted states. Beside a partner that is not
/// opposed (a corner) the surface is free, but does not move into it.
/// Both sides solve their own problem, so that what one body receives is not quite what the other gives: the
/// record of the pair takes the side of the lower-numbered (or the deformable) body. A rigid body moves at
/// the surface point with its velocity and spin.
/// Reads the fits of all walls (evaluate_fits) of this block and those around it, and the mid-step level
/// sets. Writes traction, normal, partners and velocities of BodyBlock::walls, and State::contacts; books
/// them.
/// @param weight part of a whole step that this stage stands for; 0 after the last stage.
template <int Dim>
void find_ghost_walls(State<Dim>& state, int slot, double dt, double weight, Scratch& scratch);

/// Where level sets overlap, or leave a gap below 0.3 dx in a cell in contact: how far each surface should
/// move out to meet the other halfway [m], as CutCell::mismatch of the end-of-step geometry; 0 elsewhere.
template <int Dim>
void measure_gaps(State<Dim>& state, int slot, Scratch& scratch);

}  // namespace recoil
