#pragma once

#include <vector>

#include "timestep/step.hpp"

namespace recoil {

/// A fragment that now belongs to another body.
template <int Dim>
struct PartedFragment {
  int from = 0, to = 0;  // bodies
  double mass = 0;       // kg (planar: per m, 1d: per m2, axisymmetric: per radian)
  Vec<Dim> position;     // m, centre of mass
};

template <int Dim>
using PartedFragments = std::vector<PartedFragment<Dim>>;

/// Gives fragments of a body that are near each other to different bodies (Body::fragments_of), so that they
/// have level sets of their own and touch and slide where they meet, instead of welding. A fragment is what
/// the level set has parted, with 4^Dim cells or more and with matter that has not failed; two are near where
/// the boxes along the axes that hold them are within 8 cells. The heaviest choose first: each stays where it
/// is unless a heavier one near it is there; then it goes to the first body without one, or stays if there is
/// none (Counters::fragments_without_body). Level sets are distances from the cells of each body anew where a
/// fragment has come or gone; contents move unchanged. What a body has given to another is booked as what
/// leaves through the edges of the domain is. To be called between steps; looks at every fourth step.
/// @returns the fragments that have moved, on rank 0. Collective.
template <int Dim>
PartedFragments<Dim> part_fragments(State<Dim>& state, Engine& engine);

}  // namespace recoil
