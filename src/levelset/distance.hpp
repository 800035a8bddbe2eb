#pragma once

#include "cutcell/geometry.hpp"

namespace recoil {

/// Half width of the band in which phi is advected [cells].
inline constexpr double carried_cells = 4.5;

/// The nearest point of a surface to the centre of a cell.
template <int Dim>
struct Foot {
  Vec<Dim> point;       // [m]
  Vec<Dim> normal;      // grad phi, out of the body
  double distance = 0;  // [m] positive outside
};

/// Steps from the cell's centre along -phi grad phi, with one correction by the interpolated phi.
/// The window reaches at least 5 cells beyond i.
template <int Dim>
Foot<Dim> foot_point(const Grid<Dim>& grid, const Box<Dim>& window, const double* phi, const Index<Dim>& i);

/// Brings phi back to a signed distance in the band |phi| < 7.5 dx, without moving the surface: subcell-fixed
/// Jacobi sweeps (Russo & Smereka 2000; du Chene, Min & Gibou 2008) from BodyBlock::phi into ::phi_next.
/// @param frozen cells with |phi| below this many dx keep their value; negative: none.
/// @param sweeps at most 4.
/// @param most_nearer [dx] by which phi falls at most where it is above 2 dx. A surface that appears at once,
/// that of a fragment whose level set is restored, comes nearer step by step: a cell that the bands of the
/// last step left out (reach_cells) stays farther than where lost fragments may go (lost_fragment.hpp).
template <int Dim>
void redistance(const State<Dim>& state, Body<Dim>& body, int slot, int sweeps, double frozen,
                double most_nearer, Scratch& scratch);

}  // namespace recoil
