#pragma once

#include <string>

#include "config/case.hpp"

namespace recoil::app {

/// What `recoil check --png` draws.
struct CasePictureOptions {
  std::string file;           // .png, .svg or .pdf
  std::string view, up, cut;  // of a case in space, as for `recoil plot`
};

/// Draws the bodies of a case at the start with its gauges and velocities; of a 3-D case a shaded view.
/// @returns the direction of that view, as --view takes it, where it is not the usual one; else nothing.
/// @throws InputError for another suffix, and for a view of a case that is not in space.
std::string draw_case(const config::Case& c, const CasePictureOptions& options);

}  // namespace recoil::app
