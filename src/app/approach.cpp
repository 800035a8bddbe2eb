#include "app/approach.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>

#include "config/geometry.hpp"
#include "config/shape/slabs.hpp"
#include "problem/shape.hpp"
#include "problem/start.hpp"

namespace recoil::app {

namespace {

template <int Dim>
using Distance = std::function<double(const Vec<Dim>&)>;

template <int Dim>
Vec<Dim> normal_of(const Distance<Dim>& distance, const Vec<Dim>& x, double h) {
  Vec<Dim> n;
  for (int d = 0; d < Dim; ++d) {
    Vec<Dim> high = x, low = x;
    high[d] += h, low[d] -= h;
    n[d] = distance(high) - distance(low);
  }
  const double size = norm(n);
  return size > 0 ? (1 / size) * n : n;
}

/// A box of space.
template <int Dim>
struct Part {
  Vec<Dim> lo, hi;  // m
};

/// Points of a surface in a box, one for about each cell of width h.
template <int Dim>
std::vector<Vec<Dim>> points_of(const Distance<Dim>& distance, const Part<Dim>& part, double h) {
  Box<Dim> cells;
  for (int d = 0; d < Dim; ++d)
    cells.hi[d] = static_cast<int>(std::ceil((part.hi[d] - part.lo[d]) / h - 1e-9));
  std::vector<Vec<Dim>> points;
  for_each(cells, [&](const Index<Dim>& i) {
    Vec<Dim> x;
    for (int d = 0; d < Dim; ++d) x[d] = part.lo[d] + (i[d] + 0.5) * h;
    if (std::abs(distance(x)) > h) return;
    for (int k = 0; k < 3; ++k) x = x - distance(x) * normal_of(distance, x, 1e-4 * h);
    if (std::abs(distance(x)) < 1e-3 * h) points.push_back(x);
  });
  return points;
}

template <int Dim>
struct FirstHit {
  double way = std::numeric_limits<double>::infinity();  // m
  double cosine = 0;                                     // of the motion with the normal into the other body
  bool facing = false;                                   // the two surfaces have one normal there: no corner
  Vec<Dim> place, start;                                 // of the point when it touches, and before it moves

  /// Of points that arrive together those of surfaces that lie on each other say more than corners, which
  /// have no normal; and of such the one that runs in most squarely.
  bool tells_more_than(const FirstHit& other) const {
    return facing != other.facing ? facing : cosine > other.cosine;
  }
};

/// The surfaces of two bodies.
template <int Dim>
struct Pair {
  const Distance<Dim>&own, &other;
};

/// Normals of surfaces that face each other are this near to opposite.
constexpr double facing_cosine = 0.99;

/// Moves points of a surface along a unit vector until they touch the other one; never farther than to it.
template <int Dim>
FirstHit<Dim> first_hit(const std::vector<Vec<Dim>>& points, const Vec<Dim>& direction, const Pair<Dim>& pair,
                        double farthest, double tolerance) {
  FirstHit<Dim> hit;
  for (const Vec<Dim>& start : points) {
    double way = 0;
    Vec<Dim> x = start;
    for (int k = 0; k < 500 && way < std::min(farthest, hit.way + tolerance); ++k) {
      const double gap = pair.other(x);
      if (gap < tolerance) {
        const Vec<Dim> normal = normal_of(pair.other, x, tolerance);
        const bool facing = dot(normal, normal_of(pair.own, start, tolerance)) < -facing_cosine;
        const FirstHit<Dim> found{std::min(way, hit.way), -dot(direction, normal), facing, x, start};
        if (way < hit.way - tolerance || (way < hit.way + tolerance && found.tells_more_than(hit)))
          hit = found;
        break;
      }
      way += gap;
      x = start + way * direction;
    }
  }
  return hit;
}

template <int Dim>
struct Surfaces {
  const config::Case& c;
  std::vector<Distance<Dim>> distance;
  std::vector<std::vector<Vec<Dim>>> points;
  Part<Dim> all;           // the domain
  double h = 0, size = 0;  // m, of the grid, of the domain

  explicit Surfaces(const config::Case& from) : c(from) {
    constexpr double most = Dim == 1 ? 1e5 : Dim == 2 ? 400 : 60;
    for (std::size_t d = 0; d < Dim; ++d) {
      size += c.domain.hi[d] - c.domain.lo[d];
      all.lo[static_cast<int>(d)] = c.domain.lo[d], all.hi[static_cast<int>(d)] = c.domain.hi[d];
    }
    h = std::max(c.mesh.finest, size / Dim / most);
    for (const config::Body& body : c.bodies) {
      distance.push_back(signed_distance<Dim>(body.shape, c.domain));
      points.push_back(points_of(distance.back(), all, h));
    }
  }

  /// Where points of body a touch body b first. Around the one that does, ever closer ones are asked, until
  /// they are closer than a part of a cell of the mesh: on a coarse grid none is where round bodies touch.
  FirstHit<Dim> hit_by_points(std::size_t a, std::size_t b, const Vec<Dim>& direction) const {
    constexpr double finer = 4, close = 16;
    const Pair<Dim> pair{distance[a], distance[b]};
    FirstHit<Dim> best = first_hit(points[a], direction, pair, 2 * size, 2e-3 * h);
    double spacing = h;
    while (std::isfinite(best.way) && spacing > c.mesh.finest / close) {
      Part<Dim> around;
      for (int d = 0; d < Dim; ++d) {
        around.lo[d] = std::max(all.lo[d], best.start[d] - 1.5 * spacing);
        around.hi[d] = std::min(all.hi[d], best.start[d] + 1.5 * spacing);
      }
      spacing /= finer;
      const FirstHit<Dim> closer =
          first_hit(points_of(distance[a], around, spacing), direction, pair, best.way, 2e-3 * spacing);
      if (closer.way < best.way) best = closer;
    }
    return best;
  }

  /// Both bodies' points, so that corners of either are seen.
  FirstHit<Dim> hit(std::size_t a, std::size_t b, const Vec<Dim>& direction) const {
    const FirstHit<Dim> there = hit_by_points(a, b, direction), back = hit_by_points(b, a, -direction);
    const bool together = std::abs(there.way - back.way) < 0.01 * h;
    return together ? (there.tells_more_than(back) ? there : back) : there.way < back.way ? there : back;
  }

  Approach approach(std::size_t a, std::size_t b) const {
    Approach p;
    p.first = static_cast<int>(a), p.second = static_cast<int>(b);
    if (c.bodies[a].spin != config::Vector{} || c.bodies[b].spin != config::Vector{}) return p;
    if (c.bodies[a].radial_velocity != 0 || c.bodies[b].radial_velocity != 0) return p;
    if (c.bodies[a].velocity_field.is_given() || c.bodies[b].velocity_field.is_given()) return p;
    const Vec<Dim> w = config::first_components<Dim>(c.bodies[a].velocity) -
                       config::first_components<Dim>(c.bodies[b].velocity);
    const double speed = norm(w);
    Vec<Dim> direction;
    direction[0] = 1;
    if (speed > 0) direction = (1 / speed) * w;
    const FirstHit<Dim> ahead = hit(a, b, direction);
    const bool touches = ahead.way < 0.01 * h;
    if (speed > 0 && std::isfinite(ahead.way) && ahead.cosine > 1e-6) {
      p.meeting = Meeting::close;
      p.time = ahead.way / speed;
      p.closing = speed * std::min(ahead.cosine, 1.0);
      p.sliding = speed * std::sqrt(std::max(0.0, 1 - ahead.cosine * ahead.cosine));
      for (int d = 0; d < Dim; ++d) p.place[static_cast<std::size_t>(d)] = ahead.place[d];
    } else if (speed == 0) {
      p.meeting = touches ? Meeting::rest : Meeting::pass;
    } else if (std::isfinite(hit(a, b, -direction).way)) {
      p.meeting = touches && ahead.cosine > -1e-6 ? Meeting::rest : Meeting::part;
    }
    return p;
  }
};

template <int Dim>
std::vector<Approach> find_all(const config::Case& c) {
  const Surfaces<Dim> surfaces(c);
  std::vector<Approach> all;
  for (std::size_t a = 0; a < c.bodies.size(); ++a)
    for (std::size_t b = a + 1; b < c.bodies.size(); ++b) all.push_back(surfaces.approach(a, b));
  return all;
}

}  // namespace

std::vector<Approach> first_meetings(const std::vector<Approach>& all) {
  std::vector<Approach> first;
  for (const Approach& p : all) {
    const bool later = std::any_of(all.begin(), all.end(), [&](const Approach& q) {
      const bool shared =
          q.first == p.first || q.first == p.second || q.second == p.first || q.second == p.second;
      return shared && q.meeting == Meeting::close && q.time < p.time * (1 - 1e-6);
    });
    if (p.meeting == Meeting::close && !later) first.push_back(p);
  }
  return first;
}

std::vector<Approach> find_approaches(const config::Case& c) {
  switch (config::dimension(c.domain.geometry)) {
    case 1:
      return find_all<1>(c);
    case 2:
      return find_all<2>(c);
    default:
      return find_all<3>(c);
  }
}

}  // namespace recoil::app
