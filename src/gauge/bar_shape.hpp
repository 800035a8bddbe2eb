#pragma once

#include <span>

#include "parallel/exact_sums.hpp"
#include "state/body.hpp"

namespace recoil {

/// A bar whose foot stands on another body; its axis is z, through r = 0 or x = y = 0 (axisymmetric, 3d).
struct BarWatch {
  int body = 0, wall = 0;
  bool foot_low = true;     // the foot is the end at lower z
  double start_radius = 0;  // m, of the first reading
};

/// The shape of a bar. Lengths in m, from the zero of the level set between centres of cells; NaN where there
/// is no bar.
struct BarReading {
  double length = 0;               // from the end of the foot to the other end of the axis
  double foot_radius = 0;          // largest radius within half the first radius of the end of the foot
  double radius = 0;               // largest radius anywhere
  double volume_radius = 0;        // largest radius that the matter of one row of cells would fill; NaN in 3d
  double contact_radius = 0;       // up to which the gap between foot and wall is below 0.1 dx; 0: nowhere
  double lift_off = 0;             // gap between foot and wall at 95 % of the foot's radius, at most 8 dx
  double plastic_strain = 0;       // largest, in fragments of at least 0.3 of a cell
  double axis_plastic_strain = 0;  // the same within dx of the axis
  double rim_lift_off = 0;         // gap under the outermost cells of the foot: about the height of its edge
};

/// Declares what a bar takes.
template <int Dim>
int bar_item(const Grid<Dim>& grid, ExactSums& sums);

/// Adds this rank's share of the shape. Not collective.
template <int Dim>
void collect_bar(const State<Dim>& state, const BarWatch& bar, int item, ExactSums& sums);

/// On rank 0, after the reduction; the first reading sets the bar's start_radius.
template <int Dim>
BarReading read_bar(const Grid<Dim>& grid, BarWatch& bar, std::span<const double> total);

}  // namespace recoil
