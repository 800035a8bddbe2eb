#pragma once

#include <cstdint>

#include "core/scratch.hpp"
#include "cutcell/geometry.hpp"

namespace recoil {

/// What a SurfaceView gathers besides the level sets and contact bits of deformable bodies.
struct Sight {
  int halo = 1;                 // cells around the block
  PhiAt when = PhiAt::now;      // which level sets
  bool rigid_phi = false;       // those of rigid bodies too; else distances to them are exact
  bool cells_of_walls = false;  // roles, and places of walls
};

/// Level sets, contact bits and walls of all bodies in and around one block. Arrays are over the window, by
/// body; null where the body is not, or the Sight does not ask for them. They live in the scratch memory.
template <int Dim>
struct SurfaceView {
  State<Dim>& state;
  int slot;
  Window<Dim> window;
  const double** phi;             // m
  const std::uint8_t** role;      // of deformable bodies
  const std::uint32_t** contact;  // of deformable bodies
  const int** wall;               // places in BodyBlock::walls, of deformable bodies
  RigidPose<Dim>* pose;           // of rigid bodies, now

  double dx() const { return state.grid().dx; }
  const Body<Dim>& body(int m) const { return state.bodies[m]; }
  /// phi [m] at x of a body that is in the block: exact of a rigid one whose level set was not asked for, so
  /// that the other side may be near.
  double distance(int m, const Vec<Dim>& x) const;
  /// Outward normal of a body at cell i.
  Vec<Dim> normal(int m, const Index<Dim>& i) const;
  /// Whether a body touched a partner in the last step in cell i.
  bool touched(int m, int partner, const Index<Dim>& i) const {
    const std::uint32_t* bits = contact[m];
    return bits && (bits[window.at(i)] >> partner & 1U) != 0;
  }
  /// Whether one of two bodies touched the other in the last step in cell i or one around it.
  bool was_in_contact(int m, int other, const Index<Dim>& i) const;
};

template <int Dim>
SurfaceView<Dim> view_surfaces(State<Dim>& state, int slot, const Sight& sight, Scratch& scratch);

}  // namespace recoil
