#pragma once

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

/// The stress and velocity of a fitted surface state along a direction.
template <int Dim>
struct SurfaceState {
  double velocity = 0;   // along e
  double stress = 0;     // sigma_ee
  double deviator = 0;   // S_ee
  double impedance = 0;  // rho c_L
  double shear_impedance = 0;
  Vec<Dim> shear;    // S e - S_ee e: shear traction on a face with normal e
  Vec<Dim> sliding;  // u - (u . e) e
};

/// Velocity and stress along e and across it; no impedances. Linear in `value`, so it resolves slopes as
/// well.
template <int Dim>
SurfaceState<Dim> resolve(const Primitives<Dim>& value, const Vec<Dim>& e);

/// As resolve(), with the impedances of the material.
template <int Dim>
SurfaceState<Dim> surface_state(const Material& material, const Primitives<Dim>& value, const Vec<Dim>& e);

/// tau/Z_s, or zero for fluids.
template <int Dim>
Vec<Dim> shear_recoil(const SurfaceState<Dim>& s) {
  return s.shear_impedance > 0 ? s.shear * (1 / s.shear_impedance) : Vec<Dim>{};
}

/// The walls of all cut cells of a block: which parts of a surface touch another body and what they do to
/// each other (contact/touch), and the free rest. Momentum and energy given to one side are taken from the
/// other to the last bit; both volumes move with the velocity that does the work. Writes BodyBlock::walls and
/// State::contacts, and books these.
/// @param weight part of a whole step that this stage stands for (the weight of the Runge-Kutta stage).
template <int Dim>
void find_walls(State<Dim>& state, int slot, double dt, double weight, Scratch& scratch);

/// Stores for the next step which bodies every cell touched.
template <int Dim>
void remember_contact(BodyBlock<Dim>& block);

}  // namespace recoil
