#include "picture/space/surface_net.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/turn.hpp"

namespace recoil {

namespace {

using Place = std::array<int, 3>;

/// Signed distances at the points of a lattice (far from the surface their signs only), of which the
/// outermost lie outside of the box.
class Lattice {
 public:
  Lattice(const std::function<double(const Vec<3>&)>& distance, const SpaceBox& box, double spacing)
      : box_(box), spacing_(spacing) {
    for (std::size_t d = 0; d < 3; ++d) {
      const int k = static_cast<int>(d);
      count_[d] = 1 + static_cast<int>(std::ceil((box_.hi[k] - box_.lo[k]) / spacing + 0.5));
    }
    distance_.resize(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
                     static_cast<std::size_t>(count_[2]));
    const Place bricks{(count_[0] + brick - 1) / brick, (count_[1] + brick - 1) / brick,
                       (count_[2] + brick - 1) / brick};
    each_place(bricks, [&](const Place& b) {
      fill_brick(distance, {b[0] * brick, b[1] * brick, b[2] * brick});
    });
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
  static constexpr int brick = 4;  // points along each axis that are looked at together

  /// Points far from the surface get the distance of the middle of their brick, whose sign they have.
  void fill_brick(const std::function<double(const Vec<3>&)>& distance, const Place& first) {
    const double half = 0.5 * (brick - 1) * spacing_;
    const double middle = distance_in_box(distance, point(first) + Vec<3>{{half, half, half}});
    const bool far = std::abs(middle) > 1.5 * (std::sqrt(3.0) * half + spacing_);
    Place size;
    for (std::size_t d = 0; d < 3; ++d) size[d] = std::min(brick, count_[d] - first[d]);
    each_place(size, [&](const Place& p) {
      const Place at{first[0] + p[0], first[1] + p[1], first[2] + p[2]};
      distance_[index(at)] = far ? middle : distance_in_box(distance, point(at));
    });
  }
  /// Of what the box holds.
  double distance_in_box(const std::function<double(const Vec<3>&)>& distance, const Vec<3>& x) const {
    Vec<3> inside = x;
    double beyond = -1e300;
    for (int d = 0; d < 3; ++d) {
      inside[d] = std::clamp(x[d], box_.lo[d], box_.hi[d]);
      beyond = std::max({beyond, box_.lo[d] - x[d], x[d] - box_.hi[d]});
    }
    return std::max(distance(inside), beyond);
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

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

SurfaceNet surface_net(const std::function<double(const Vec<3>&)>& distance, const SpaceBox& box,
                       double spacing) {
  const Lattice lattice(distance, box, spacing);
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

std::string stl_bytes(const SurfaceNet& net, const std::string& name) {
  std::string bytes = name.substr(0, 79);
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(2 * net.faces.size()));
  const auto triangle = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    const auto at = [&](std::int32_t n) { return net.points[static_cast<std::size_t>(n)]; };
    for (const Vec<3>& v : {unit(cross(at(b) - at(a), at(c) - at(a))), at(a), at(b), at(c)})
      for (int d = 0; d < 3; ++d) append(bytes, static_cast<float>(v[d]));
    append(bytes, std::uint16_t{0});
  };
  for (const auto& face : net.faces) {
    triangle(face[0], face[1], face[2]);
    triangle(face[0], face[2], face[3]);
  }
  return bytes;
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
