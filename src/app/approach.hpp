#pragma once

#include <vector>

#include "config/case.hpp"

namespace recoil::app {

/// What two bodies do that keep their velocities from the start.
enum class Meeting {
  rest,   // they touch, and slide or stay
  close,  // they come together: `time`, `closing`, `place`
  part,   // they touch or have touched before the start, and go apart
  pass    // they never touch, or one of them turns
};

struct Approach {
  int first = 0, second = 0;  // numbers of the bodies
  Meeting meeting = Meeting::pass;
  double time = 0;         // s, first touch
  double closing = 0;      // m/s, along the normal of the surface there
  double sliding = 0;      // m/s, along the surface
  config::Vector place{};  // m, of the first touch, where it is then in the frame of the second body
};

/// Every pair of bodies of a case, by following points of their surfaces on a grid of the mesh's cells, or
/// coarser in large cases, and then closer ones around the first that touches: times and places are good to a
/// small part of a cell of the mesh for faces and round bodies, to about a cell for corners. Rigid pairs as
/// well.
std::vector<Approach> find_approaches(const config::Case& c);

/// Of those that close the ones before which neither body has met another: later the velocities are others.
std::vector<Approach> first_meetings(const std::vector<Approach>& all);

}  // namespace recoil::app
