#include "picture/outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "core/error.hpp"

namespace recoil {
namespace {

using Edge = std::int64_t;  // 2 * node + (0: towards +x, 1: towards +y)

/// A step of a curve from one cut edge to the next.
struct Step {
  Edge from, to;
};

/// Values at the nodes of a grid with any spacing.
struct NodeGrid {
  std::vector<double> xs, ys;
  std::vector<double> values;

  std::size_t node(std::size_t i, std::size_t j) const { return i + xs.size() * j; }
  Edge edge(std::size_t i, std::size_t j, int axis) const { return 2 * static_cast<Edge>(node(i, j)) + axis; }
  Point2 cut(Edge edge) const {
    const auto n = static_cast<std::size_t>(edge / 2);
    const std::size_t i = n % xs.size(), j = n / xs.size();
    const bool along_x = edge % 2 == 0;
    const double a = values[n], b = values[along_x ? n + 1 : n + xs.size()];
    const double t = a / (a - b);
    if (along_x) return {xs[i] + t * (xs[i + 1] - xs[i]), ys[j]};
    return {xs[i], ys[j] + t * (ys[j + 1] - ys[j])};
  }
};

/// The steps through the square with lower left node (i, j), negative side to the left.
void add_steps(const NodeGrid& grid, std::size_t i, std::size_t j, std::vector<Step>& steps) {
  const double corner[4] = {grid.values[grid.node(i, j)], grid.values[grid.node(i + 1, j)],
                            grid.values[grid.node(i + 1, j + 1)], grid.values[grid.node(i, j + 1)]};
  for (const double v : corner)
    if (std::isnan(v)) return;
  // Edge k runs from corner k to corner k + 1, anticlockwise: bottom, right, top, left.
  const Edge edges[4] = {grid.edge(i, j, 0), grid.edge(i + 1, j, 1), grid.edge(i, j + 1, 0),
                         grid.edge(i, j, 1)};
  const auto inside = [&corner](int k) { return corner[k % 4] < 0; };
  int in[2] = {0, 0}, out[2] = {0, 0}, n_in = 0, n_out = 0;
  for (int k = 0; k < 4; ++k) {
    if (inside(k) && !inside(k + 1)) in[n_in++] = k;    // the curve comes in where we leave the inside
    if (!inside(k) && inside(k + 1)) out[n_out++] = k;  // and goes out where we enter it again
  }
  if (n_in == 1) steps.push_back({edges[in[0]], edges[out[0]]});
  if (n_in != 2) return;
  // Saddle. in and out alternate around the square; the next `out` after `in` cuts off an outside corner.
  const bool joined = corner[0] + corner[1] + corner[2] + corner[3] < 0;
  for (const int k : in) {
    const int next = (k + 1) % 4, previous = (k + 3) % 4;
    steps.push_back({edges[k], edges[joined ? next : previous]});
  }
}

/// Joins steps to curves: first the open ones from their beginning, then the closed ones.
std::vector<Outline> chained(const NodeGrid& grid, const std::vector<Step>& steps) {
  std::unordered_map<Edge, std::size_t> leaving;
  std::unordered_map<Edge, bool> entered;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    leaving[steps[k].from] = k;
    entered[steps[k].to] = true;
  }
  std::vector<bool> used(steps.size(), false);
  std::vector<Outline> outlines;
  const auto follow = [&](std::size_t k) {
    Outline outline;
    const Edge start = steps[k].from;
    outline.points.push_back(grid.cut(start));
    while (true) {
      used[k] = true;
      const Edge end = steps[k].to;
      outline.closed = end == start;
      if (outline.closed) break;
      outline.points.push_back(grid.cut(end));
      const auto next = leaving.find(end);
      if (next == leaving.end() || used[next->second]) break;
      k = next->second;
    }
    outlines.push_back(std::move(outline));
  };
  for (std::size_t k = 0; k < steps.size(); ++k)
    if (!used[k] && !entered.contains(steps[k].from)) follow(k);
  for (std::size_t k = 0; k < steps.size(); ++k)
    if (!used[k]) follow(k);
  return outlines;
}

std::vector<Outline> outlines_of(const NodeGrid& grid) {
  std::vector<Step> steps;
  for (std::size_t j = 0; j + 1 < grid.ys.size(); ++j)
    for (std::size_t i = 0; i + 1 < grid.xs.size(); ++i) add_steps(grid, i, j, steps);
  return chained(grid, steps);
}

void check(const PlaneArray& phi) {
  require(phi.nx > 0 && phi.ny > 0 &&
              phi.values.size() == static_cast<std::size_t>(phi.nx) * static_cast<std::size_t>(phi.ny),
          "a plane array has nx * ny values");
}

/// Places of the cell centres with both ends of the array added.
std::vector<double> centres_and_ends(double x0, double dx, int n) {
  std::vector<double> xs{x0};
  for (int i = 0; i < n; ++i) xs.push_back(x0 + (i + 0.5) * dx);
  xs.push_back(x0 + n * dx);
  return xs;
}

}  // namespace

std::vector<Outline> zero_outlines(const PlaneArray& phi) {
  if (phi.values.empty()) return {};
  check(phi);
  NodeGrid grid{centres_and_ends(phi.x0, phi.dx, phi.nx), centres_and_ends(phi.y0, phi.dy, phi.ny), {}};
  for (int j = -1; j <= phi.ny; ++j)
    for (int i = -1; i <= phi.nx; ++i)
      grid.values.push_back(phi.at(std::clamp(i, 0, phi.nx - 1), std::clamp(j, 0, phi.ny - 1)));
  return outlines_of(grid);
}

std::vector<Outline> zero_outlines_of_nodes(const PlaneArray& phi) {
  check(phi);
  NodeGrid grid{{}, {}, phi.values};
  for (int i = 0; i < phi.nx; ++i) grid.xs.push_back(phi.x0 + i * phi.dx);
  for (int j = 0; j < phi.ny; ++j) grid.ys.push_back(phi.y0 + j * phi.dy);
  return outlines_of(grid);
}

double length(const Outline& outline) {
  double sum = 0;
  const auto& p = outline.points;
  const auto distance = [](Point2 a, Point2 b) { return std::hypot(b.x - a.x, b.y - a.y); };
  for (std::size_t k = 1; k < p.size(); ++k) sum += distance(p[k - 1], p[k]);
  if (outline.closed && p.size() > 1) sum += distance(p.back(), p.front());
  return sum;
}

double signed_area(const Outline& outline) {
  if (!outline.closed) return 0;
  double twice = 0;
  const auto& p = outline.points;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const Point2 a = p[k], b = p[(k + 1) % p.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return 0.5 * twice;
}

}  // namespace recoil
