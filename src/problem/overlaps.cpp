#include "problem/overlaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "problem/shape.hpp"
#include "problem/start.hpp"

namespace recoil {

namespace {

/// f(cell) for the cells of a box but those of parts for which skip(middle, radius) is true: nothing within
/// that distance of the middle matters.
template <int Dim, class Skip, class F>
void for_each_cell_but(const Grid<Dim>& grid, const Box<Dim>& cells, const Skip& skip, const F& f) {
  constexpr int few = 64;
  double n = 1;  // may be more than an int holds
  for (int d = 0; d < Dim; ++d) n *= cells.extent(d);
  if (n <= few) return for_each(cells, f);
  Vec<Dim> middle;
  double radius = 0;
  int longest = 0;
  for (int d = 0; d < Dim; ++d) {
    middle[d] = grid.origin[d] + 0.5 * (cells.lo[d] + cells.hi[d]) * grid.dx;
    radius += std::pow(0.5 * cells.extent(d) * grid.dx, 2);
    if (cells.extent(d) > cells.extent(longest)) longest = d;
  }
  if (skip(middle, std::sqrt(radius))) return;
  Box<Dim> low = cells, high = cells;
  low.hi[longest] = high.lo[longest] = (cells.lo[longest] + cells.hi[longest]) / 2;
  for_each_cell_but(grid, low, skip, f);
  for_each_cell_but(grid, high, skip, f);
}

template <int Dim>
void find_overlaps_in(const config::Case& c, config::Diagnostics& out) {
  const Grid<Dim> grid = make_grid<Dim>(c);
  std::vector<std::function<double(const Vec<Dim>&)>> distance;
  for (const auto& body : c.bodies) distance.push_back(signed_distance<Dim>(body.shape, c.domain));
  const std::size_t n = distance.size();
  std::vector<double> deepest(n * n, 0), inside(n * n, 0), phi(n);
  std::vector<Vec<Dim>> place(n * n);
  const auto apart = [&](const Vec<Dim>& middle, double radius) {
    int near = 0;  // bodies that reach into it
    for (std::size_t m = 0; m < n; ++m) near += distance[m](middle) < radius + 0.5 * grid.dx ? 1 : 0;
    return near < 2;
  };
  for_each_cell_but(grid, grid.domain(), apart, [&](const Index<Dim>& i) {
    const Vec<Dim> x = grid.centre(i);
    for (std::size_t m = 0; m < n; ++m) phi[m] = distance[m](x);
    for (std::size_t m = 0; m < n; ++m)
      for (std::size_t q = m + 1; q < n; ++q) {
        const double overlap = -(phi[m] + phi[q]);
        // Between two flat faces the overlap is everywhere the same: the cell that is deepest in both.
        const double out_of_one = std::max(phi[m], phi[q]), equal = 1e-9 * deepest[m * n + q];
        if (out_of_one > 0.5 * grid.dx || overlap <= deepest[m * n + q] - equal) continue;
        if (overlap <= deepest[m * n + q] + equal && out_of_one >= inside[m * n + q] - equal) continue;
        deepest[m * n + q] = overlap;
        inside[m * n + q] = out_of_one;
        place[m * n + q] = x;
      }
  });
  for (std::size_t m = 0; m < n; ++m)
    for (std::size_t q = m + 1; q < n; ++q) {
      if (deepest[m * n + q] <= 1e-6 * grid.dx) continue;
      std::string at;
      for (int d = 0; d < Dim; ++d) at += fmt::format("{}{:.4g}", d ? ", " : "", place[m * n + q][d] * 1e3);
      out.error(c.bodies[q].shape.place,
                fmt::format("bodies '{}' and '{}' overlap by {:.4g} mm near ({}) mm", c.bodies[m].name,
                            c.bodies[q].name, deepest[m * n + q] * 1e3, at),
                fmt::format("move or cut one of them; bodies may touch, as at a common face"));
    }
}

}  // namespace

void find_overlaps(const config::Case& c, config::Diagnostics& out) {
  switch (config::dimension(c.domain.geometry)) {
    case 1:
      return find_overlaps_in<1>(c, out);
    case 2:
      return find_overlaps_in<2>(c, out);
    default:
      return find_overlaps_in<3>(c, out);
  }
}

}  // namespace recoil
