#pragma once

#include <optional>
#include <string>

#include "config/case.hpp"
#include "picture/canvas.hpp"
#include "picture/space/view.hpp"

namespace recoil::app {

/// How a 3-D case is looked at.
struct CaseView {
  std::string text;  // as --view takes it; empty: the usual direction
  View view;
  std::optional<SpacePlane> cut;  // its viewer's side is left out
};

/// The usual direction, or where that hides more than half of a body another one from which more of all
/// bodies is seen. @param up,cut as on the command line. @throws InputError.
CaseView view_of_all_bodies(const config::Case& c, const std::string& up, const std::string& cut);

/// The bodies of a 3-D case at the start, shaded, each in its colour, with gauges and velocities; it names
/// the bodies that are not seen. @throws InputError where nothing is left.
Canvas view_of_case(const config::Case& c, const CaseView& view);

}  // namespace recoil::app
