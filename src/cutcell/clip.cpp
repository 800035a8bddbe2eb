#include "cutcell/clip.hpp"

#include <algorithm>

namespace recoil {

namespace {

Clip<1> clip_segment(double a, double b) {
  Clip<1> c;
  double lo = 0, hi = 1;
  if ((a < 0) != (b < 0)) {
    const double t = a / (a - b);
    (a < 0 ? hi : lo) = t;
    c.middle[0] = t;
    c.crossings = 1;
  } else if (a >= 0) {
    hi = 0;
  }
  c.fraction = hi - lo;
  c.centroid[0] = 0.5 * (lo + hi);
  return c;
}

/// Corners in the order (0,0) (1,0) (0,1) (1,1). Opposite negative corners are joined.
Clip<2> clip_square(const Corners<2>& v) {
  // Most faces of cut cells lie on one side of the surface: what follows finds just this for them.
  const int negative = (v[0] < 0) + (v[1] < 0) + (v[2] < 0) + (v[3] < 0);
  if (negative == 0) return {};
  if (negative == 4) return {1, {{0.5, 0.5}}, {}, 0};
  constexpr std::array<std::array<double, 2>, 4> corner{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  constexpr std::array<std::size_t, 4> order{0, 1, 3, 2};
  std::array<std::array<double, 2>, 8> p{};
  std::size_t n = 0;
  Clip<2> c;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    const double a = v[order[i]], b = v[order[j]];
    if (a < 0) p[n++] = corner[i];
    if ((a < 0) == (b < 0)) continue;
    const double t = a / (a - b);
    for (int d = 0; d < 2; ++d) {
      const auto e = static_cast<std::size_t>(d);
      p[n][e] = corner[i][e] + t * (corner[j][e] - corner[i][e]);
      c.middle[d] += p[n][e];
    }
    ++n;
    ++c.crossings;
  }
  if (c.crossings > 0) c.middle *= 1.0 / c.crossings;
  double area = 0;
  Vec<2> moment;
  for (std::size_t i = 0; i < n; ++i) {
    const auto &a = p[i], &b = p[(i + 1) % n];
    const double cross = a[0] * b[1] - b[0] * a[1];
    area += cross;
    for (int d = 0; d < 2; ++d) moment[d] += (a[d] + b[d]) * cross;
  }
  c.fraction = 0.5 * area;
  c.centroid = c.fraction > 1e-10 ? moment * (1 / (6 * c.fraction)) : c.middle;
  for (int d = 0; d < 2; ++d) c.centroid[d] = std::clamp(c.centroid[d], 0.0, 1.0);
  return c;
}

/// Mean of the crossings of all edges of a cube.
void cross_edges(const Corners<3>& v, Clip<3>& c) {
  for (int corner = 0; corner < 8; ++corner)
    for (int d = 0; d < 3; ++d) {
      const int other = corner | 1 << d;
      if (other == corner) continue;
      const double a = v[corner], b = v[other];
      if ((a < 0) == (b < 0)) continue;
      for (int e = 0; e < 3; ++e) c.middle[e] += e == d ? a / (a - b) : static_cast<double>(corner >> e & 1);
      ++c.crossings;
    }
  if (c.crossings > 0) c.middle *= 1.0 / c.crossings;
}

/// With m on the surface and x - m along it, only the faces of the cube count in the divergence theorem:
/// 3 V = closed-int (x - m) . n dA and int (4 x_i - m_i) dV = closed-int x_i (x - m) . n dA.
Clip<3> clip_cube(const Corners<3>& v, const FaceClips<3>& faces) {
  Clip<3> c;
  cross_edges(v, c);
  double volume = 0;
  Vec<3> moment;
  for (int d = 0; d < 3; ++d)
    for (int side = 0; side < 2; ++side) {
      const Clip<3>& face = faces[d][side];
      const double flux = (side == 0 ? c.middle[d] : 1 - c.middle[d]) * face.fraction;
      volume += flux / 3;
      moment += flux * face.centroid;
    }
  moment = 0.25 * (volume * c.middle + moment);
  c.fraction = std::clamp(volume, 0.0, 1.0);
  c.centroid = c.fraction > 1e-10 ? moment * (1 / c.fraction) : c.middle;
  for (int d = 0; d < 3; ++d) c.centroid[d] = std::clamp(c.centroid[d], 0.0, 1.0);
  return c;
}

}  // namespace

template <>
Clip<1> clip<1>(const Corners<1>& v, const FaceClips<1>&) {
  return clip_segment(v[0], v[1]);
}

template <>
Clip<2> clip<2>(const Corners<2>& v, const FaceClips<2>&) {
  return clip_square(v);
}

template <>
Clip<3> clip<3>(const Corners<3>& v, const FaceClips<3>& faces) {
  return clip_cube(v, faces);
}

template <>
Clip<1> clip_face<1>(const Corners<1>& v, int, int side) {
  Clip<1> c;
  c.fraction = v[side] < 0 ? 1 : 0;
  c.centroid[0] = side;
  return c;
}

template <>
Clip<2> clip_face<2>(const Corners<2>& v, int d, int side) {
  const auto base = static_cast<std::size_t>(side << d);
  const Clip<1> s = clip_segment(v[base], v[base + (d == 0 ? 2U : 1U)]);
  Clip<2> c;
  c.fraction = s.fraction;
  c.centroid[d] = side;
  c.centroid[1 - d] = s.centroid[0];
  return c;
}

template <>
Clip<3> clip_face<3>(const Corners<3>& v, int d, int side) {
  const int e = d == 0 ? 1 : 0, f = d == 2 ? 1 : 2;
  const auto at = [&](int a, int b) { return v[side << d | a << e | b << f]; };
  const Clip<2> s = clip_square({at(0, 0), at(1, 0), at(0, 1), at(1, 1)});
  Clip<3> c;
  c.fraction = s.fraction;
  c.centroid[d] = side;
  c.centroid[e] = s.centroid[0];
  c.centroid[f] = s.centroid[1];
  return c;
}

}  // namespace recoil
