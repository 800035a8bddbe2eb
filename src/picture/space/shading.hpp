#pragma once

#include "picture/colour_key.hpp"
#include "picture/image.hpp"
#include "picture/space/space_picture.hpp"

namespace recoil {

/// The rays as pixels, two by two: colours of the field under light from above on the left, darker in corners
/// (ambient occlusion from the depths around: M. Mittring, "Finding next gen", SIGGRAPH 2007 courses); faces
/// of cuts without light; dark lines where the body changes, where the depth jumps, and at edges.
/// @param cell width of the finest cells [m]: smaller jumps are no edges.
Image shaded(const SpaceRays& rays, const View& view, const Colours& colours, double cell);

}  // namespace recoil
