#include "problem/shape.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace recoil {

namespace {

using config::Geometry;
using config::Shape;

template <int Dim>
Vec<Dim> cut(const config::Vector& v) {
  Vec<Dim> x;
  for (int d = 0; d < Dim; ++d) x[d] = v[d];
  return x;
}

/// From the signed distances to pairs of parallel planes: outside, the distance to the corner or face.
template <std::size_t N>
double from_slabs(const std::array<double, N>& slab) {
  double outside = 0, inside = -1e300;
  for (const double s : slab) {
    inside = std::max(inside, s);
    if (s > 0) outside += s * s;
  }
  return inside > 0 ? std::sqrt(outside) : inside;
}

template <int Dim>
double box_distance(const Vec<Dim>& lo, const Vec<Dim>& hi, const Vec<Dim>& x) {
  std::array<double, Dim> slab{};
  for (int d = 0; d < Dim; ++d) slab[d] = std::max(lo[d] - x[d], x[d] - hi[d]);
  return from_slabs(slab);
}

/// x turned back by the shape's rotation about its centre, into the frame in which the shape is given.
template <int Dim>
Vec<Dim> turned_back(const Shape& s, const Vec<Dim>& x) {
  if constexpr (Dim == 1) return x;
  if (s.rotation == 0) return x;
  const double c = std::cos(s.rotation), n = std::sin(s.rotation);
  const double a = x[0] - s.centre[0], b = x[1] - s.centre[1];
  Vec<Dim> y = x;
  y[0] = s.centre[0] + a * c + b * n;
  y[1] = s.centre[1] - a * n + b * c;
  return y;
}

/// Whether both ends of an edge lie on or beyond the same edge of the domain.
bool on_edge(const std::array<double, 2>& a, const std::array<double, 2>& b, const config::Domain& domain) {
  for (std::size_t d = 0; d < 2; ++d) {
    const double near = 1e-9 * (domain.hi[d] - domain.lo[d]);
    if ((a[d] <= domain.lo[d] + near && b[d] <= domain.lo[d] + near) ||
        (a[d] >= domain.hi[d] - near && b[d] >= domain.hi[d] - near))
      return true;
  }
  return false;
}

/// Edges on the edge of the domain do not count, and points on or beyond it are inside where the domain next
/// to them is.
double polygon_distance(const std::vector<std::array<double, 2>>& v, const config::Domain& domain,
                        bool turned, const Vec<2>& x) {
  Vec<2> within = x;
  for (int d = 0; d < 2 && !turned; ++d) {
    const double lo = domain.lo[d], hi = domain.hi[d];
    within[d] = std::clamp(x[d], lo + 1e-9 * (hi - lo), hi - 1e-9 * (hi - lo));
  }
  double nearest2 = 1e300;
  bool inside = false;
  for (std::size_t i = 0, j = v.size() - 1; i < v.size(); j = i++) {
    const double ex = v[j][0] - v[i][0], ey = v[j][1] - v[i][1], wx = x[0] - v[i][0], wy = x[1] - v[i][1];
    const double length2 = ex * ex + ey * ey;
    const double t = length2 > 0 ? std::clamp((wx * ex + wy * ey) / length2, 0.0, 1.0) : 0.0;
    const double dx = wx - t * ex, dy = wy - t * ey;
    if (turned || !on_edge(v[i], v[j], domain)) nearest2 = std::min(nearest2, dx * dx + dy * dy);
    if ((v[i][1] > within[1]) != (v[j][1] > within[1]) &&
        within[0] < v[i][0] + ex * (within[1] - v[i][1]) / ey)
      inside = !inside;
  }
  return (inside ? -1 : 1) * std::sqrt(nearest2);
}

template <int Dim>
double ball_distance(const Shape& s, const Vec<Dim>& x) {
  return norm(x - cut<Dim>(s.centre)) - s.radius;
}

template <int Dim>
double cylinder_distance(const Shape& s, Geometry geometry, const Vec<Dim>& x) {
  if constexpr (Dim == 2) {
    if (geometry == Geometry::axisymmetric)
      return from_slabs(
          std::array<double, 2>{x[0] - s.radius, std::max(s.length_lo - x[1], x[1] - s.length_hi)});
  }
  if constexpr (Dim == 3) {
    const Vec<3> r = x - cut<3>(s.centre), axis = cut<3>(s.axis);
    const double along = dot(r, axis);
    return from_slabs(std::array<double, 2>{norm(r - along * axis) - s.radius,
                                            std::max(s.length_lo - along, along - s.length_hi)});
  }
  return ball_distance(s, x);
}

template <int Dim>
double distance(const Shape& s, const config::Domain& domain, const Vec<Dim>& x) {
  switch (s.kind) {
    case Shape::Kind::box:
      return box_distance(cut<Dim>(s.lo), cut<Dim>(s.hi), turned_back(s, x));
    case Shape::Kind::sphere:
      return ball_distance(s, x);
    case Shape::Kind::cylinder:
      return cylinder_distance(s, domain.geometry, x);
    case Shape::Kind::half_space:
      return dot(x - cut<Dim>(s.point), cut<Dim>(s.normal));
    case Shape::Kind::polygon:
      if constexpr (Dim == 2) return polygon_distance(s.vertices, domain, s.rotation != 0, turned_back(s, x));
      break;
    case Shape::Kind::combined: {
      double d = 1e300;
      for (const Shape& part : s.parts) d = std::min(d, distance(part, domain, x));
      return d;
    }
    case Shape::Kind::difference: {
      double d = distance(s.parts.front(), domain, x);
      for (std::size_t i = 1; i < s.parts.size(); ++i) d = std::max(d, -distance(s.parts[i], domain, x));
      return d;
    }
  }
  require(false, "a shape of a kind that this dimension has");
  return 0;
}

/// The shape with those faces of its boxes that lie on the edge of the domain pushed far beyond it.
Shape continued(Shape s, const config::Domain& domain) {
  constexpr double far = 1e6;  // m
  for (Shape& part : s.parts) part = continued(part, domain);
  if (s.kind != Shape::Kind::box || s.rotation != 0) return s;
  for (std::size_t d = 0; d < 3; ++d) {
    const double near = 1e-9 * (domain.hi[d] - domain.lo[d]);
    if (s.lo[d] <= domain.lo[d] + near) s.lo[d] = domain.lo[d] - far;
    if (s.hi[d] >= domain.hi[d] - near) s.hi[d] = domain.hi[d] + far;
  }
  return s;
}

/// A cell is decided where the surface is farther than its corners; else it is halved, down to 1/64.
template <int Dim>
double refine(const std::function<double(const Vec<Dim>&)>& distance, const Vec<Dim>& centre, double width,
              int depth, bool axisymmetric) {
  const double s = distance(centre), weight = axisymmetric ? std::abs(centre[0]) : 1;
  if (std::abs(s) >= 0.5 * width * std::sqrt(static_cast<double>(Dim))) return s < 0 ? weight : 0;
  if (depth == 0) return weight * std::clamp(0.5 - s / width, 0.0, 1.0);
  double sum = 0;
  for (int c = 0; c < 1 << Dim; ++c) {
    Vec<Dim> x = centre;
    for (int d = 0; d < Dim; ++d) x[d] += ((c >> d & 1) != 0 ? 0.25 : -0.25) * width;
    sum += refine(distance, x, 0.5 * width, depth - 1, axisymmetric);
  }
  return sum / (1 << Dim);
}

}  // namespace

template <int Dim>
std::function<double(const Vec<Dim>&)> signed_distance(const Shape& shape, const config::Domain& domain) {
  return [shape = continued(shape, domain), domain](const Vec<Dim>& x) { return distance(shape, domain, x); };
}

template <int Dim>
double inside_part(const std::function<double(const Vec<Dim>&)>& distance, const Vec<Dim>& centre, double dx,
                   bool axisymmetric) {
  return refine(distance, centre, dx, Dim == 3 ? 4 : 6, axisymmetric);
}

#define RECOIL_INSTANTIATE(Dim)                                                                            \
  template std::function<double(const Vec<Dim>&)> signed_distance<Dim>(const config::Shape&,               \
                                                                       const config::Domain&);             \
  template double inside_part<Dim>(const std::function<double(const Vec<Dim>&)>&, const Vec<Dim>&, double, \
                                   bool);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
