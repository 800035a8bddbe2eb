#pragma once

#include <string>

#include "app/commands.hpp"
#include "output/unstructured_grid.hpp"

namespace recoil::app {

/// Draws a field of a run's dump nearest to a time: in the plane as colours, in 1d as a curve.
/// @throws InputError where the run has no dumps or no such field.
int plot_field(const PlotOptions& options);

/// One number per cell of what a command names: an array ("pressure", with or without its unit), a component
/// of one
/// ("velocity.x", "stress.xy"), or of a vector its size. NaN in cells that hold less than half of their
/// matter.
struct ScalarField {
  std::string label;  // with unit: "pressure [GPa]"
  std::vector<double> values;
};
/// @throws InputError with the nearest names.
ScalarField scalar_field(const UnstructuredGrid& grid, const std::string& name);

}  // namespace recoil::app
