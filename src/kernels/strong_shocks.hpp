#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/row_kernels.hpp"

namespace recoil::detail {

/// A row of cells as strong shocks see it; see find_strong_shocks().
struct ShockRow {
  const double *stress, *u, *impedance, *rho;  // stress and u along the axis, rho c_L
  const std::uint8_t* own;  // not 0 where a cell stands in stencils with its own average; null: everywhere
  std::uint8_t own_bit;     // of `own` that says so
  std::ptrdiff_t step;
};

/// Which part of the differences between a cell and its face values strong shocks leave: 1 where there is
/// none. A shock that moves slowly over the mesh, or runs into a free surface, leaves noise of density and
/// heat behind, the more the fewer cells it is wide; flattened values make it wider (Colella & Woodward, J.
/// Comput. Phys. 54 (1984) 174, appendix: flattening). Here it is strong where, over two cells in
/// compression, the stress along the axis changes by more than `shock_onset` of rho c_L^2 of the softer side;
/// one that is slow on the mesh from `slow_onset` on. A cell with ghost values in reach may become first
/// order in a strong shock, any other keeps `least_slope` of its differences. docs/decisions/0046, 0051.
/// @param kept out, [count]. @returns whether any is below 1.
bool find_strong_shocks(const ShockRow& row, int count, double* kept);

/// The same of matter that has expanded beyond a solid, density below `vapour` [kg/m3]: 1 where the densities
/// of a cell and its two neighbours differ by less than `thin_onset`, 0 from `thin_full` on (as factors).
/// First order there keeps masses and energies of cold, fast vapour above zero; values within a factor of two
/// of those of their cells do not. docs/decisions/0071.
/// @param kept out, [count]; untouched where there is no such matter. @returns whether there is any.
bool find_thin_matter(const double* rho, std::ptrdiff_t step, double vapour, int count, double* kept);

/// Draws face values towards those of their cells: kept[i] of the difference is left. Where that is 1 they
/// keep their bits.
void flatten(const double* q, const double* kept, int count, RowEnds ends);

}  // namespace recoil::detail
