#include "picture/space/view.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <thread>

#include "core/error.hpp"
#include "parallel/team.hpp"

namespace recoil {

namespace {

/// The part of a ray that can meet something, and the outward normal of the face through which it enters.
struct Stretch {
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
  Vec<3> normal{};
};

/// Leaves what lies on the lower side of the plane normal . x = distance.
void clip(Stretch& s, const Vec<3>& origin, const Vec<3>& forward, const Vec<3>& normal, double distance) {
  const double speed = dot(normal, forward), above = dot(normal, origin) - distance;
  if (std::abs(speed) < 1e-12) {
    if (above > 0) s.to = -std::numeric_limits<double>::infinity();
    return;
  }
  const double at = -above / speed;
  if (speed > 0)
    s.to = std::min(s.to, at);
  else if (at > s.from)
    s.from = at, s.normal = normal;
}

Stretch stretch_of(const Scene& scene, const Vec<3>& origin, const Vec<3>& forward,
                   const std::optional<SpacePlane>& cut) {
  Stretch s;
  const SpaceBox box = scene.box();
  for (int d = 0; d < 3; ++d) {
    Vec<3> axis;
    axis[d] = 1;
    clip(s, origin, forward, axis, box.hi[d]);
    clip(s, origin, forward, -axis, -box.lo[d]);
  }
  if (cut) clip(s, origin, forward, cut->normal, cut->distance);
  return s;
}

Vec<3> gradient(const Scene& scene, const Vec<3>& x) {
  const double h = 0.75 * scene.cell();
  Vec<3> g;
  for (int d = 0; d < 3; ++d) {
    Vec<3> step;
    step[d] = h;
    g[d] = scene.distance(x + step) - scene.distance(x - step);
  }
  return unit(g);
}

/// The surface between a point outside of the matter and one inside.
double refined(const Scene& scene, const Vec<3>& origin, const Vec<3>& forward, double outside,
               double inside) {
  for (int k = 0; k < 12; ++k) {
    const double middle = 0.5 * (outside + inside);
    (scene.distance(origin + forward * middle) < 0 ? inside : outside) = middle;
  }
  return inside;
}

Hit cast(const Scene& scene, const Vec<3>& origin, const Vec<3>& forward,
         const std::optional<SpacePlane>& cut) {
  Hit hit;
  const Stretch s = stretch_of(scene, origin, forward, cut);
  if (!(s.from < s.to)) return hit;
  const double least = 0.05 * scene.cell(), hair = 1e-6 * scene.cell();
  double t = s.from + hair, before = t;
  while (t < s.to) {
    const double distance = scene.distance(origin + forward * t);
    if (distance < 0) break;
    before = t;
    t += std::max(least, distance);
  }
  if (!(t < s.to)) return hit;
  hit.face = t == before;
  hit.depth = hit.face ? s.from : refined(scene, origin, forward, before, t);
  const Vec<3> x = origin + forward * (hit.face ? t : hit.depth);
  hit.normal = hit.face ? s.normal : gradient(scene, x);
  if (dot(hit.normal, forward) > 0) hit.normal = unit(hit.normal - forward * dot(hit.normal, forward));
  // The state of a cut cell is that of its matter: read it half a cell below the surface.
  const Vec<3> inside = x - hit.normal * (hit.face ? 0 : 0.5 * scene.cell());
  hit.body = scene.body(inside);
  hit.value = scene.value(inside, hit.body);
  return hit;
}

/// Whether two neighbours, two rays apart, lie on one smooth surface.
bool alike(const Hit& p, const Hit& q, const Vec<3>& forward, double pixel) {
  if (p.body != q.body || p.face != q.face) return false;
  if (!p.any()) return true;
  const double slope = std::min(-dot(p.normal, forward), -dot(q.normal, forward));
  return slope > 0.15 && dot(p.normal, q.normal) > 0.9 && std::abs(p.depth - q.depth) < 6 * pixel / slope;
}

}  // namespace

View View::from(double azimuth, double elevation, int axis) {
  Vec<3> first, second, top;
  first[(axis + 1) % 3] = second[(axis + 2) % 3] = top[axis] = 1;
  const Vec<3> around = first * std::cos(azimuth) + second * std::sin(azimuth);
  View v;
  v.forward = -(around * std::cos(elevation) + top * std::sin(elevation));
  v.right = second * std::cos(azimuth) - first * std::sin(azimuth);
  v.up = top * std::cos(elevation) - around * std::sin(elevation);
  return v;
}

std::vector<Hit> cast_rays(const Scene& scene, const View& view, const Screen& screen,
                           const std::optional<SpacePlane>& cut) {
  require(screen.nx % 2 == 0 && screen.ny % 2 == 0, "rays of a view come two by two");
  const auto ray = [&](double i, double j) {
    const Vec<3> origin = screen.corner + view.right * (i * screen.pixel) - view.up * (j * screen.pixel);
    return cast(scene, origin, view.forward, cut);
  };
  parallel::Team team(static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 8U)));
  const int nx = screen.nx / 2, ny = screen.ny / 2;
  const auto at = [nx](int i, int j) {
    return static_cast<std::size_t>(i) + static_cast<std::size_t>(nx) * static_cast<std::size_t>(j);
  };
  std::vector<Hit> coarse(at(0, ny));
  team.run(ny, [&](int j, int /*worker*/) {
    for (int i = 0; i < nx; ++i) coarse[at(i, j)] = ray(2 * i + 1, 2 * j + 1);
  });
  std::vector<Hit> hits(4 * coarse.size());
  team.run(ny, [&](int j, int /*worker*/) {
    for (int i = 0; i < nx; ++i) {
      bool even = true;
      for (const auto& [a, b] : {std::array{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        const int p = std::clamp(i + a, 0, nx - 1), q = std::clamp(j + b, 0, ny - 1);
        even = even && alike(coarse[at(i, j)], coarse[at(p, q)], view.forward, screen.pixel);
      }
      for (const int k : {0, 1, 2, 3}) {
        const int x = 2 * i + k % 2, y = 2 * j + k / 2;
        hits[static_cast<std::size_t>(x) +
             static_cast<std::size_t>(screen.nx) * static_cast<std::size_t>(y)] =
            even ? coarse[at(i, j)] : ray(x + 0.5, y + 0.5);
      }
    }
  });
  return hits;
}

}  // namespace recoil
