#pragma once

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

/// How two bodies that nearly meet are cut.
enum class Surfaces {
  own,    // each by its own level set
  shared  // by one surface for both where they touch (theory: one surface cuts both)
};

/// Which level set: of the start of the step or half a step on.
enum class PhiAt { now, midstep };

/// Finds for all bodies of one block which cells are full, empty or cut, and how. Node values are means of
/// phi over the 2^Dim cells around. Writes BodyBlock::geometry (midstep) or ::end_geometry (now). Where two
/// bodies are closer than 0.15 dx, or than 0.5 dx beside cells in contact with each other, the nodes of both
/// take (phi_m - phi_k)/2 and its negative, so that both are cut by the same surface. Rigid bodies are known
/// exactly: their nodes take the distance itself, which means of phi would round where they are thin or
/// sharp.
/// @param ahead seconds from now to `when`.
template <int Dim>
void find_geometry(State<Dim>& state, int slot, Surfaces surfaces, PhiAt when, Scratch& scratch,
                   double ahead = 0);

/// Outward normal of a rigid body in a pose near x: differences of its distance over dx / 50, mirrored at
/// planes of symmetry and one-sided at other edges of the domain.
template <int Dim>
Vec<Dim> rigid_normal(const Grid<Dim>& grid, const RigidMotion<Dim>& motion, const RigidPose<Dim>& pose,
                      const Vec<Dim>& x);

/// Open area of the [low, high] face across axis d of a cell of any kind.
template <int Dim>
double open_area(const Grid<Dim>& grid, const Geometry<Dim>& geometry, int cell, const Index<Dim>& i, int d,
                 int side);

/// Open areas of the low faces across axis d of the inner cells of a window and of the high faces of their
/// last ones: out over the inner box grown by one at the high end of axis d.
template <int Dim>
void open_areas(const Grid<Dim>& grid, const Window<Dim>& window, const Geometry<Dim>& geometry, int d,
                double* out);

/// -grad phi or grad phi as a unit vector at cell i of a window of phi (reach: one cell): central
/// differences, or the steeper one-sided ones where those cancel (a ridge).
template <int Dim>
Vec<Dim> phi_normal(const Box<Dim>& window, const double* phi, const Index<Dim>& i, double dx);

/// phi at a point, multilinear between cell centres; x is kept inside the window.
template <int Dim>
double interpolate(const Grid<Dim>& grid, const Box<Dim>& window, const double* phi, const Vec<Dim>& x);

}  // namespace recoil
