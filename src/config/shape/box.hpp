#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "config/declare/extents.hpp"
#include "config/declare/reading.hpp"
#include "config/shape/bounds.hpp"
#include "config/shape/slabs.hpp"

namespace recoil::config {

struct Box {
  Vector lo{}, hi{};    // m; 1d: an interval; before rotation
  double rotation = 0;  // rad, counter-clockwise about `centre`
  Vector centre{};      // m

  static constexpr const char* kind = "box";
  static constexpr const char* doc =
      "A box along the axes; in 1d an interval, spherical a shell, axisymmetric a ring or a round plate.";
  static std::vector<Alias> aliases() {
    return {{"rectangle", "Another name of box in the plane.", {Geometry::planar, Geometry::axisymmetric}}};
  }
  static Entries<Box> keys() {
    const auto side = extent_along<Box>;
    return {side("x", "extent along x"),
            side("y", "extent along y"),
            side("r", "extent along the radius (axisymmetric, spherical)"),
            side("z", "extent along z"),
            {.name = "rotation",
             .member = &Box::rotation,
             .unit = "rad",
             .doc = "turned by this angle about `centre`, counter-clockwise (planar, axisymmetric)",
             .example = R"("10 deg")",
             .only_in = {Geometry::planar, Geometry::axisymmetric},
             .when = [](const Box& b) { return b.rotation != 0; }},
            {.name = "centre",
             .member = &Box::centre,
             .unit = "m",
             .doc = "centre of rotation; without it the middle",
             .example = R"({ x = "1 mm" })",
             .only_in = {Geometry::planar, Geometry::axisymmetric},
             .when = [](const Box& b) { return b.rotation != 0; }}};
  }
  void check(const TableReading& reading) {
    if (has_radius(reading.in.geometry) && reading.good("r") && lo[0] < 0)
      reading.refuse("r", "'r' begins below r = 0", "let it begin at 0");
    if (!reading.has("centre"))
      for (std::size_t d = 0; d < 3; ++d) centre[d] = 0.5 * (lo[d] + hi[d]);
  }

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& /*domain*/) const {
    const Vec<Dim> y = turned_back(rotation, centre, x);
    std::array<double, Dim> slab{};
    for (int d = 0; d < Dim; ++d) slab[d] = std::max(lo[d] - y[d], y[d] - hi[d]);
    return from_slabs(slab);
  }

  /// With those faces that lie on the edge of the domain pushed far beyond it.
  Box continued(const Domain& domain) const {
    Box s = *this;
    if (rotation != 0) return s;
    for (std::size_t d = 0; d < 3; ++d) continue_beyond(s.lo[d], s.hi[d], domain.lo[d], domain.hi[d]);
    return s;
  }

  /// What reaches the edge of the domain has no surface there.
  double thickness(const Domain& domain) const {
    double least = 1e300;
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimension(domain.geometry)); ++d) {
      const bool through = lo[d] <= domain.lo[d] && hi[d] >= domain.hi[d];
      const bool mirrored = lo[d] <= domain.lo[d] && domain.boundary[d][0] != Boundary::outflow;
      if (!through) least = std::min(least, (hi[d] - lo[d]) * (mirrored ? 2 : 1));
    }
    return least;
  }
  bool along_mesh() const { return rotation == 0; }

  Bounds bounds(const Domain& /*domain*/) const {
    if (rotation == 0) return {lo, hi};
    return Bounds::of_corners({{lo[0], lo[1]}, {hi[0], lo[1]}, {hi[0], hi[1]}, {lo[0], hi[1]}}, rotation,
                              centre);
  }
  Extent extent(Geometry /*geometry*/) const { return rotation == 0 ? Extent{true, lo, hi} : Extent{}; }
};

}  // namespace recoil::config
