#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "picture/space/scene.hpp"

namespace recoil {

/// From where bodies are looked at: in parallel projection, so that lengths across the view can be measured.
struct View {
  Vec<3> forward{{0, 1, 0}};  ///< from the viewer to the bodies, of length 1
  Vec<3> right{{1, 0, 0}};
  Vec<3> up{{0, 0, 1}};

  /// From a direction [rad]: azimuth from the first axis behind `axis` (x for z) to the next, elevation above
  /// the plane across it. `axis` (0, 1, 2) points up in the picture.
  static View from(double azimuth, double elevation, int axis);
};

/// What a ray met first.
struct Hit {
  double depth = std::numeric_limits<double>::infinity();  ///< along the ray [m]; infinite: nothing
  Vec<3> normal{};                                         ///< out of the matter, of length 1
  double value = std::numeric_limits<double>::quiet_NaN();
  int body = -1;
  bool face = false;  ///< of a cut or of the box, not a surface

  bool any() const { return body >= 0; }
};

/// Where the rays start: pixel (i, j) of nx times ny, rows from the top, at
/// corner + (i + 1/2) pixel right - (j + 1/2) pixel up. Both counts are even.
struct Screen {
  int nx = 0, ny = 0;
  double pixel = 0;  ///< m
  Vec<3> corner{};   ///< upper left, in front of everything
};

/// The hits of all rays, [i + nx * j]. The rays are followed by steps of the signed distance (J. C. Hart,
/// "Sphere tracing", The Visual Computer 12, 1996) to the first change of its sign. Where four rays that are
/// side by side meet one smooth surface, the ray in their middle stands for them.
/// @param cut what lies on its viewer's side is taken away.
std::vector<Hit> cast_rays(const Scene& scene, const View& view, const Screen& screen,
                           const std::optional<SpacePlane>& cut);

}  // namespace recoil
