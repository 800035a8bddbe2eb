#pragma once

#include "core/vec.hpp"
#include "field/components.hpp"
#include "material/material.hpp"

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

}  // namespace recoil
