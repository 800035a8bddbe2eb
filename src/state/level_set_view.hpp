#pragma once

#include <cstddef>

#include "core/scratch.hpp"
#include "field/window.hpp"
#include "state/body.hpp"

namespace recoil {

/// Copies a level set of a body into a window [size()]; far_cells dx where the body is not. Beyond an
/// open edge of the domain surfaces go on straight: phi with the slope between the last two cells, whose size
/// is at most 1. Continued as a constant it would turn surfaces there to stand upright on the edge.
/// @param grid of the finest level, on which surfaces are. @param field phi, or one of its times.
template <int Dim>
void view_level_set(const Grid<Dim>& grid, const Body<Dim>& body, const Window<Dim>& window,
                    FieldArray<double> BodyBlock<Dim>::*field, double* out);

/// The same, taken from the scratch.
template <int Dim>
double* view_level_set(const Grid<Dim>& grid, const Body<Dim>& body, const Window<Dim>& window,
                       FieldArray<double> BodyBlock<Dim>::*field, Scratch& scratch) {
  double* out = scratch.take<double>(static_cast<std::size_t>(window.size()));
  view_level_set(grid, body, window, field, out);
  return out;
}

}  // namespace recoil
