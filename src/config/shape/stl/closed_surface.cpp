#include "config/shape/stl/closed_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/turn.hpp"

namespace recoil::config {

namespace {

constexpr int leaf = 4;  // triangles

/// One side of a triangle, its ends in the order of their numbers.
struct Edge {
  int low, high;
  bool forward;  // runs from low to high
  int triangle, side;
};

/// All of them, those with the same ends beside each other.
std::vector<Edge> edges_of(const Triangles& surface) {
  std::vector<Edge> edges;
  edges.reserve(3 * surface.corners.size());
  for (std::size_t t = 0; t < surface.corners.size(); ++t)
    for (std::size_t side = 0; side < 3; ++side) {
      const int a = surface.corners[t][side], b = surface.corners[t][(side + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a < b, static_cast<int>(t), static_cast<int>(side)});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return edges;
}

/// Calls f(first, last) for each group of sides with the same ends.
template <class F>
void for_each_edge(const std::vector<Edge>& edges, const F& f) {
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last = std::find_if(
        first, edges.end(), [&](const Edge& e) { return e.low != first->low || e.high != first->high; });
    f(first, last);
    first = last;
  }
}

/// Edges of one kind: how many, and where one is.
struct Counted {
  std::size_t number = 0;
  int point = 0;

  void add(int at) {
    if (number++ == 0) point = at;
  }
};

}  // namespace

double volume_of(const Triangles& surface) {
  double six = 0;
  const Vec<3> origin = surface.points.front();
  for (const auto& [a, b, c] : surface.corners) {
    const auto at = [&](int p) { return surface.points[static_cast<std::size_t>(p)] - origin; };
    six += dot(at(a), cross(at(b), at(c)));
  }
  return six / 6;
}

SurfaceFault fault_of(const Triangles& surface) {
  std::size_t all = 0;
  Counted open, crowded, against;
  const std::vector<Edge> edges = edges_of(surface);
  for_each_edge(edges, [&](auto first, auto last) {
    ++all;
    if (last - first == 1)
      open.add(first->low);
    else if (last - first > 2)
      crowded.add(first->low);
    else if (first->forward == (first + 1)->forward)
      against.add(first->low);
  });
  const auto said = [&](const Counted& bad, const char* what) {
    const Vec<3>& p = surface.points[static_cast<std::size_t>(bad.point)];
    return fmt::format("{} of {} edges {}, one of them at ({:.6g}, {:.6g}, {:.6g}) mm", bad.number, all, what,
                       1e3 * p[0], 1e3 * p[1], 1e3 * p[2]);
  };
  if (open.number > 0)
    return {
        "the surface is not closed: " + said(open, "are open, with a triangle on one side only"),
        "repair it where it was made, so that every edge joins two triangles; corners that meet must have "
        "the same coordinates to the last digit"};
  if (crowded.number > 0)
    return {said(crowded, "join more than two triangles"),
            "where two parts touch along an edge, leave a gap or join them"};
  if (against.number > 0)
    return {"the triangles are not turned alike: " + said(against, "run the same way in both triangles"),
            "make its normals consistent where it was made"};
  if (const double volume = volume_of(surface); !(volume > 0))
    return {fmt::format("the surface is inside out: the volume that it encloses is {:.4g} mm3", 1e9 * volume),
            "flip its normals where it was made"};
  return {};
}

ClosedSurface::ClosedSurface(Triangles surface) : surface_(std::move(surface)) {
  find_normals();
  order_.resize(surface_.corners.size());
  std::iota(order_.begin(), order_.end(), 0);
  build(0, static_cast<int>(order_.size()));
}

void ClosedSurface::find_normals() {
  normals_.resize(surface_.corners.size());
  corner_normals_.resize(surface_.points.size());
  for (std::size_t t = 0; t < surface_.corners.size(); ++t) {
    std::array<Vec<3>, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = surface_.points[static_cast<std::size_t>(surface_.corners[t][k])];
    const Vec<3> normal = unit(cross(p[1] - p[0], p[2] - p[0]));  // none of a triangle without an area
    normals_[t][3] = normal;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec<3> e = p[(k + 1) % 3] - p[k], f = p[(k + 2) % 3] - p[k];
      const double angle = std::atan2(norm(cross(e, f)), dot(e, f));
      corner_normals_[static_cast<std::size_t>(surface_.corners[t][k])] += angle * normal;
    }
  }
  const std::vector<Edge> edges = edges_of(surface_);
  for_each_edge(edges, [&](auto first, auto last) {
    Vec<3> sum;
    for (auto e = first; e != last; ++e) sum += normals_[static_cast<std::size_t>(e->triangle)][3];
    for (auto e = first; e != last; ++e)
      normals_[static_cast<std::size_t>(e->triangle)][static_cast<std::size_t>(e->side)] = sum;
  });
}

int ClosedSurface::build(int first, int count) {
  const auto middle_of = [&](int t, int d) {
    double sum = 0;
    for (const int p : surface_.corners[static_cast<std::size_t>(t)])
      sum += surface_.points[static_cast<std::size_t>(p)][d];
    return sum;
  };
  const auto begin = order_.begin() + first, end = begin + count;
  Node box{surface_.points[static_cast<std::size_t>(surface_.corners[static_cast<std::size_t>(*begin)][0])],
           {}};
  box.hi = box.lo;
  for (auto t = begin; t != end; ++t)
    for (const int p : surface_.corners[static_cast<std::size_t>(*t)])
      for (int d = 0; d < 3; ++d) {
        box.lo[d] = std::min(box.lo[d], surface_.points[static_cast<std::size_t>(p)][d]);
        box.hi[d] = std::max(box.hi[d], surface_.points[static_cast<std::size_t>(p)][d]);
      }
  const auto own = nodes_.size();
  nodes_.push_back(box);
  if (count <= leaf) {
    nodes_[own].first = first;
    nodes_[own].count = count;
    return static_cast<int>(own);
  }
  const int widest = main_axis(box.hi - box.lo), half = count / 2;
  std::nth_element(begin, begin + half, end, [&](int a, int b) {
    return std::pair{middle_of(a, widest), a} < std::pair{middle_of(b, widest), b};
  });
  build(first, half);
  nodes_[own].other = build(first + half, count - half);
  return static_cast<int>(own);
}

/// The cases of Voronoi's regions of a triangle, by the signs of scalar products with its edges.
ClosedSurface::Nearest ClosedSurface::nearest_on(int triangle, const Vec<3>& x) const {
  const auto& corners = surface_.corners[static_cast<std::size_t>(triangle)];
  const auto point = [&](std::size_t k) -> const Vec<3>& {
    return surface_.points[static_cast<std::size_t>(corners[k])];
  };
  const Vec<3>&a = point(0), &b = point(1), &c = point(2);
  const auto at = [&](const Vec<3>& p, int part) { return Nearest{dot(x - p, x - p), p, triangle, part}; };
  const Vec<3> ab = b - a, ac = c - a;
  const double a1 = dot(ab, x - a), a2 = dot(ac, x - a);
  if (a1 <= 0 && a2 <= 0) return at(a, 0);
  const double b1 = dot(ab, x - b), b2 = dot(ac, x - b);
  if (b1 >= 0 && b2 <= b1) return at(b, 1);
  const double in_c = a1 * b2 - b1 * a2;
  if (in_c <= 0 && a1 >= 0 && b1 <= 0) return at(a + (a1 / (a1 - b1)) * ab, 3);
  const double c1 = dot(ab, x - c), c2 = dot(ac, x - c);
  if (c2 >= 0 && c1 <= c2) return at(c, 2);
  const double in_b = c1 * a2 - a1 * c2;
  if (in_b <= 0 && a2 >= 0 && c2 <= 0) return at(a + (a2 / (a2 - c2)) * ac, 5);
  const double in_a = b1 * c2 - c1 * b2, from_b = b2 - b1, from_c = c1 - c2;
  if (in_a <= 0 && from_b >= 0 && from_c >= 0) return at(b + (from_b / (from_b + from_c)) * (c - b), 4);
  const double sum = in_a + in_b + in_c;
  return at(a + (in_b / sum) * ab + (in_c / sum) * ac, face);
}

void ClosedSurface::search(int node, const Vec<3>& x, Nearest& best) const {
  const Node& own = nodes_[static_cast<std::size_t>(node)];
  for (int k = own.first; k < own.first + own.count; ++k)
    if (const Nearest here = nearest_on(order_[static_cast<std::size_t>(k)], x);
        here.distance2 < best.distance2)
      best = here;
  if (own.count > 0) return;
  const auto away2 = [&](int child) {
    const Node& box = nodes_[static_cast<std::size_t>(child)];
    double sum = 0;
    for (int d = 0; d < 3; ++d) {
      const double out = std::max({box.lo[d] - x[d], x[d] - box.hi[d], 0.0});
      sum += out * out;
    }
    return sum;
  };
  std::pair<double, int> near{away2(node + 1), node + 1}, far{away2(own.other), own.other};
  if (far < near) std::swap(near, far);
  if (near.first < best.distance2) search(near.second, x, best);
  if (far.first < best.distance2) search(far.second, x, best);
}

double ClosedSurface::distance(const Vec<3>& x) const {
  Nearest best;
  search(0, x, best);
  const auto t = static_cast<std::size_t>(best.triangle), part = static_cast<std::size_t>(best.part);
  const Vec<3>& normal =
      part < 3 ? corner_normals_[static_cast<std::size_t>(surface_.corners[t][part])] : normals_[t][part - 3];
  const double away = std::sqrt(best.distance2);
  return dot(x - best.point, normal) < 0 ? -away : away;
}

}  // namespace recoil::config
