#include "picture/space/surface_net.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/turn.hpp"

namespace recoil {

namespace {

using Place = std::array<int, 3>;

/// Signed distances at the points of a lattice, of which the outermost lie outside of the scene's box.
class Lattice {
 public:
  Lattice(const Scene& scene, double spacing) : box_(scene.box()), spacing_(spacing) {
    for (std::size_t d = 0; d < 3; ++d) {
      const int k = static_cast<int>(d);
      count_[d] = 1 + static_cast<int>(std::ceil((box_.hi[k] - box_.lo[k]) / spacing + 0.5));
    }
    distance_.resize(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
                     static_cast<std::size_t>(count_[2]));
    each_place(count_, [&](const Place& p) { distance_[index(p)] = distance_in_box(scene, point(p)); });
  }

  template <class F>
  static void each_place(const Place& count, F&& f) {
    for (int k = 0; k < count[2]; ++k)
      for (int j = 0; j < count[1]; ++j)
        for (int i = 0; i < count[0]; ++i) f(Place{i, j, k});
  }

  const Place& count() const { return count_; }
  Place cells() const { return {count_[0] - 1, count_[1] - 1, count_[2] - 1}; }
  std::size_t index(const Place& p) const {
    return static_cast<std::size_t>(p[0] + count_[0] * (p[1] + count_[1] * p[2]));
  }
  double at(const Place& p) const { return distance_[index(p)]; }
  Vec<3> point(const Place& p) const {
    Vec<3> x;
    for (int d = 0; d < 3; ++d) x[d] = box_.lo[d] + (p[static_cast<std::size_t>(d)] - 0.5) * spacing_;
    return x;
  }
  /// Where the surface crosses an edge between two neighbours of different sign.
  Vec<3> crossing(const Place& p, const Place& q) const {
    const double a = at(p), b = at(q);
    return point(p) + (a / (a - b)) * (point(q) - point(p));
  }

 private:
  /// Of what the box holds of the bodies.
  double distance_in_box(const Scene& scene, const Vec<3>& x) const {
    Vec<3> inside = x;
    double beyond = -1e300;
    for (int d = 0; d < 3; ++d) {
      inside[d] = std::clamp(x[d], box_.lo[d], box_.hi[d]);
      beyond = std::max({beyond, box_.lo[d] - x[d], x[d] - box_.hi[d]});
    }
    return std::max(scene.distance(inside), beyond);
  }

  SpaceBox box_;
  double spacing_;
  Place count_{};
  std::vector<double> distance_;
};

Place moved(Place p, std::size_t axis, int by) {
  p[axis] += by;
  return p;
}

/// Calls f(p, q) for the twelve edges of a cell.
template <class F>
void each_edge(const Place& cell, F&& f) {
  for (std::size_t d = 0; d < 3; ++d)
    for (int n = 0; n < 4; ++n) {
      const Place p = moved(moved(cell, (d + 1) % 3, n % 2), (d + 2) % 3, n / 2);
      f(p, moved(p, d, 1));
    }
}

/// Numbers of the points by the lower corner of their cell; -1: none.
std::vector<std::int32_t> place_points(const Lattice& lattice, std::vector<Vec<3>>& points) {
  const Place& count = lattice.count();
  std::vector<std::int32_t> number(lattice.index({count[0] - 1, count[1] - 1, count[2] - 1}) + 1, -1);
  Lattice::each_place(lattice.cells(), [&](const Place& cell) {
    Vec<3> sum{};
    int crossings = 0;
    each_edge(cell, [&](const Place& p, const Place& q) {
      if ((lattice.at(p) < 0) == (lattice.at(q) < 0)) return;
      sum += lattice.crossing(p, q);
      ++crossings;
    });
    if (crossings == 0) return;
    number[lattice.index(cell)] = static_cast<std::int32_t>(points.size());
    points.push_back((1.0 / crossings) * sum);
  });
  return number;
}

}  // namespace

SurfaceNet surface_net(const Scene& scene, double spacing) {
  const Lattice lattice(scene, spacing);
  SurfaceNet net;
  const std::vector<std::int32_t> number = place_points(lattice, net.points);
  Lattice::each_place(lattice.cells(), [&](const Place& p) {
    for (std::size_t d = 0; d < 3; ++d) {
      const std::size_t u = (d + 1) % 3, v = (d + 2) % 3;
      const bool inside = lattice.at(p) < 0;
      if (p[u] == 0 || p[v] == 0 || inside == (lattice.at(moved(p, d, 1)) < 0)) continue;
      const auto at = [&](const Place& cell) { return number[lattice.index(cell)]; };
      std::array<std::int32_t, 4> face{at(moved(moved(p, u, -1), v, -1)), at(moved(p, v, -1)), at(p),
                                       at(moved(p, u, -1))};
      if (!inside) std::ranges::reverse(face);
      net.faces.push_back(face);
    }
  });
  return net;
}

std::vector<Vec<3>> points_below(const SurfaceNet& net, double depth) {
  std::vector<Vec<3>> normals(net.points.size());
  for (const auto& face : net.faces) {
    const auto corner = [&](std::size_t n) { return net.points[static_cast<std::size_t>(face[n])]; };
    const Vec<3> normal = cross(corner(2) - corner(0), corner(3) - corner(1));
    for (const std::int32_t n : face) normals[static_cast<std::size_t>(n)] += normal;
  }
  std::vector<Vec<3>> below(net.points.size());
  for (std::size_t n = 0; n < below.size(); ++n) {
    const double length = norm(normals[n]);
    below[n] = length > 0 ? net.points[n] - (depth / length) * normals[n] : net.points[n];
  }
  return below;
}

}  // namespace recoil
