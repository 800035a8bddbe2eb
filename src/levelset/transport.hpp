#pragma once

#include "levelset/distance.hpp"

namespace recoil {

/// Sets the velocity that moves phi (BodyBlock::extension_velocity) from the wall velocities of the cut
/// cells near the foot point on the mid-step surface, weighted with exp(-2 r^2/dx^2) (|A_I|/dx^(Dim-1) +
/// 0.02); zero outside the band. A speed above dx/dt is capped and counted.
template <int Dim>
void spread_wall_velocity(const State<Dim>& state, Body<Dim>& body, int slot, double dt, Counters& counters,
                          Scratch& scratch);

/// phi_t + u . grad phi = 0 by fifth-order WENO, upwinded per component (Jiang & Peng 2000).
/// out = phi - dt u . grad phi; reads BodyBlock::phi and ::extension_velocity.
/// @param out BodyBlock::phi_midstep or ::phi_next.
template <int Dim>
void advect_level_set(const State<Dim>& state, Body<Dim>& body, int slot, double dt,
                      FieldArray<double> BodyBlock<Dim>::*out, Scratch& scratch);

/// Second half of Heun's rule: phi = (phi + phi_next - dt u . grad phi_next)/2.
template <int Dim>
void advect_level_set_again(const State<Dim>& state, Body<Dim>& body, int slot, double dt, Scratch& scratch);

/// What phi takes up of its mismatch in a step.
struct Following {
  double rate = 0;                    // the part of it
  double rate_failed = rate;          // the same of failed matter
  bool growth_beside_bodies = false;  // and what it has grown by since the last step, where contact may close
};

/// phi follows V: phi_next = phi - rate h, h the mismatch (V - V_phi)/A_I of the cut cells (CutCell::mismatch
/// of the end-of-step geometry) averaged along the surface with exp(-r^2/dx^2) over 5^Dim cells about the
/// foot point. The rate is the mean, with the same weights, of those of failed matter and of other matter
/// (decision 0064); matter that can fail and is less than about two cells thick there counts as failed
/// (decision 0075). Where the surface of another deformable body is within 1.5 dx and neither is a gas,
/// growth of h since the last step (BodyBlock::lag) beyond 0.005 dx is taken up at once, as far as h > 0 and
/// by 0.05 dx at most: else contact would close late, over cells that are full already (decision 0062).
template <int Dim>
void follow_volume(const State<Dim>& state, Body<Dim>& body, int slot, const Following& following,
                   Scratch& scratch);

/// phi of a rigid body `ahead` seconds from now, exact; into BodyBlock::phi or ::phi_midstep.
template <int Dim>
void place_rigid(const State<Dim>& state, Body<Dim>& body, int slot, double ahead, PhiAt where);

/// Takes rigid bodies out of the level set of another: phi = max(phi, -phi_rigid - 0.1 dx). Transport cannot
/// bend a surface around an edge thinner than a cell; contacts overlap less. V and contents stay as they are.
template <int Dim>
void cut_out_rigid(const State<Dim>& state, Body<Dim>& body, int slot);

}  // namespace recoil
