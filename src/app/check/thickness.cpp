#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <type_traits>
#include <variant>
#include <vector>

#include "app/check/checks.hpp"
#include "config/geometry.hpp"
#include "problem/shape.hpp"
#include "problem/start.hpp"

namespace recoil::app {

namespace {

constexpr double most_samples = 1e5;
constexpr double unending = 1e300;

/// Climbs from a point to the nearest place in the domain that is deepest inside: the depth there [m]. Bodies
/// go on beyond the edges of the domain, where there is no end to climbing.
template <int Dim>
double climb(const Grid<Dim>& grid, const std::function<double(const Vec<Dim>&)>& distance, Vec<Dim> x,
             double step, double smallest) {
  const auto low = [&](int d) { return grid.origin[d]; };
  const auto high = [&](int d) { return grid.origin[d] + grid.cells[d] * grid.dx; };
  double depth = -distance(x);
  while (step > smallest) {
    const double before = depth;
    for (int d = 0; d < Dim; ++d)
      for (const double side : {-1.0, 1.0}) {
        Vec<Dim> y = x;
        y[d] = std::clamp(y[d] + side * step, low(d), high(d));
        if (const double there = -distance(y); there > depth) depth = there, x = y;
      }
    if (depth == before) step *= 0.5;
  }
  return depth;
}

template <int Dim>
double largest_ball(const config::Shape& shape, const config::Case& c) {
  const Grid<Dim> grid = make_grid<Dim>(c);
  const auto distance = signed_distance<Dim>(shape, c.domain);
  double total = 1;
  for (int d = 0; d < Dim; ++d) total *= grid.cells[d];
  const int stride = static_cast<int>(std::max(1.0, std::ceil(std::pow(total / most_samples, 1.0 / Dim))));
  Box<Dim> points;
  for (int d = 0; d < Dim; ++d) points.hi[d] = (grid.cells[d] + stride - 1) / stride;
  double depth = -std::numeric_limits<double>::infinity();
  Vec<Dim> deepest;
  for_each(points, [&](const Index<Dim>& i) {
    Index<Dim> at;
    for (int d = 0; d < Dim; ++d) at[d] = i[d] * stride + stride / 2;
    const Vec<Dim> x = grid.centre(at);
    if (const double there = -distance(x); there > depth) depth = there, deepest = x;
  });
  // Outside of all samples a shape may still be thinner than what lies between them.
  return depth < -stride * grid.dx
             ? unending
             : 2 * std::max(0.0, climb(grid, distance, deepest, stride * grid.dx, 1e-3 * grid.dx));
}

}  // namespace

namespace {

/// Whether a shape cannot tell its smallest extent, and ends somewhere.
bool is_sampled(const config::Shape& shape) {
  const auto any = [](const std::vector<config::Shape>& shapes) {
    return std::ranges::any_of(shapes, is_sampled);
  };
  return std::visit(
      [&]<class T>(const T& s) {
        if constexpr (requires { s.shape; }) return any(s.shape);
        if constexpr (std::is_same_v<T, config::Union>) return any(s.parts);
        return !std::is_same_v<T, config::HalfSpace> && !requires { s.thickness(config::Domain{}); };
      },
      shape.form);
}

}  // namespace

double least_thickness(const config::Shape& shape, const config::Case& c) {
  if (const double told = thickness(shape, c.domain); told < unending) return told;
  if (const auto* whole = std::get_if<config::Union>(&shape.form)) {
    double least = unending;
    for (const config::Shape& part : whole->parts) least = std::min(least, least_thickness(part, c));
    return least;
  }
  if (!is_sampled(shape)) return unending;
  switch (config::dimension(c.domain.geometry)) {
    case 1:
      return largest_ball<1>(shape, c);
    case 2:
      return largest_ball<2>(shape, c);
    default:
      return largest_ball<3>(shape, c);
  }
}

}  // namespace recoil::app
