#pragma once

#include <optional>

#include "config/case.hpp"
#include "picture/canvas.hpp"
#include "picture/space/view.hpp"

namespace recoil::app {

/// The bodies of a 3-D case at the start, shaded, each in its colour, with gauges and velocities.
/// @param cut its viewer's side is left out. @throws InputError where nothing is left.
Canvas view_of_case(const config::Case& c, const View& view, const std::optional<SpacePlane>& cut);

}  // namespace recoil::app
