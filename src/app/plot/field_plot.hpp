#pragma once

#include "app/commands.hpp"

namespace recoil::app {

/// Draws a field of a run's dump nearest to a time: in the plane as colours with the bodies' outlines, in 1d
/// as a curve. @throws InputError where the run has no dumps or no such field.
int plot_field(const PlotOptions& options);

/// Draws a field of a 1d run over place and time, from all its dumps, with the bodies' surfaces.
/// @throws InputError for another geometry, or a run without dumps or such a field.
int plot_field_over_time(const PlotOptions& given);

}  // namespace recoil::app
