#pragma once

#include <optional>
#include <string>
#include <vector>

#include "picture/canvas.hpp"
#include "picture/colour_key.hpp"
#include "picture/space/view.hpp"

namespace recoil {

/// A part of a view [m]: coordinates along its `right`, `up` and `forward`.
struct ViewWindow {
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  double nearest = 0;
};

/// The window that holds both.
ViewWindow joined(const ViewWindow& a, const ViewWindow& b);

/// What is seen of the scene, with a margin; nothing where the view is empty.
std::optional<ViewWindow> window_of(const Scene& scene, const View& view,
                                    const std::optional<SpacePlane>& cut);

/// A dot or an arrow at a place in space.
struct SpaceMark {
  Vec<3> at{};   ///< m
  Vec<3> way{};  ///< m/s: the fastest has the longest arrow
  std::string label{};
  bool arrow = false;
};

/// A shaded view of bodies in space, coloured by a field.
struct SpacePicture {
  View view{};
  /// What the picture holds: along `right` and `up`, and from where rays start along `forward` [m].
  ViewWindow window{};
  std::optional<SpacePlane> cut{};         ///< its viewer's side is taken away
  std::string title{}, note{};             ///< heading on the left; on the right, e.g. the time
  std::string label{};                     ///< of the colour bar, with unit: "pressure [GPa]"
  std::vector<SpaceMark> marks{};          ///< those behind matter are hollow
  int max_width = 1200, max_height = 900;  ///< of the whole picture [pixels]
};

/// The rays of a picture, two by two for each of its pixels.
struct SpaceRays {
  Screen screen;
  std::vector<Hit> hits;
  double cell = 0;  ///< width of the finest cells [m]

  /// The values that are seen.
  std::vector<double> values() const;
};

/// Follows the rays.
SpaceRays rays_of(const SpacePicture& picture, const Scene& scene);

/// Draws what the rays have met: surfaces shaded, faces of cuts in the plain colours of the key, dark lines
/// at outlines and edges of bodies, the axes and a scale.
Canvas space_picture(const SpacePicture& picture, const SpaceRays& rays, const Colours& colours);

}  // namespace recoil
