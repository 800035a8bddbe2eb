#include "app/check/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "problem/shape.hpp"
#include "problem/start.hpp"
#include "state/fields.hpp"

namespace recoil::app {

namespace {

constexpr double samples = 1e6;
/// Wall time of one cell full of matter in one step with one thread [s], measured in
/// 1d, 2d, 3d on small cases, which are mostly surface: large ones are faster.
constexpr double cell_seconds[] = {2e-6, 9e-6, 40e-6};

template <int Dim>
std::vector<double> sample(const config::Case& c) {
  const Grid<Dim> grid = make_grid<Dim>(c);
  double total = 1;
  for (int d = 0; d < Dim; ++d) total *= grid.cells[d];
  const int stride = static_cast<int>(std::max(1.0, std::ceil(std::pow(total / samples, 1.0 / Dim))));
  Box<Dim> points;
  for (int d = 0; d < Dim; ++d) points.hi[d] = (grid.cells[d] + stride - 1) / stride;
  std::vector<double> cells;
  for (const config::Body& body : c.bodies) {
    const auto distance = signed_distance<Dim>(body.shape, c.domain);
    double inside = 0;
    for_each(points, [&](const Index<Dim>& i) {
      Index<Dim> at;
      for (int d = 0; d < Dim; ++d) at[d] = i[d] * stride + stride / 2;
      inside += distance(grid.centre(at)) < 0;
    });
    cells.push_back(inside * std::pow(stride, Dim));
  }
  return cells;
}

template <int Dim>
double cells_of_domain(const config::Case& c) {
  const Grid<Dim> grid = make_grid<Dim>(c);
  double n = 1;
  for (int d = 0; d < Dim; ++d) n *= grid.cells[d];
  return n;
}

template <int Dim>
Estimate make_estimate(const config::Case& c, double fastest) {
  Estimate e;
  e.cells = cells_of_domain<Dim>(c);
  const std::vector<double> cells = cells_of_bodies(c);
  for (std::size_t m = 0; m < cells.size(); ++m)
    if (!c.bodies[m].rigid) e.material_cells += cells[m];
  e.step = c.time.fixed_dt ? *c.time.fixed_dt : c.time.cfl * c.mesh.finest / fastest;
  e.steps = std::ceil(c.time.end / e.step);
  e.memory = 50e6 + e.material_cells * bytes_of_cell(Dim);
  e.seconds = e.steps * e.material_cells * cell_seconds[Dim - 1];
  return e;
}

}  // namespace

std::vector<double> cells_of_bodies(const config::Case& c) {
  switch (config::dimension(c.domain.geometry)) {
    case 1:
      return sample<1>(c);
    case 2:
      return sample<2>(c);
    default:
      return sample<3>(c);
  }
}

Estimate estimate(const config::Case& c, double fastest) {
  switch (config::dimension(c.domain.geometry)) {
    case 1:
      return make_estimate<1>(c, fastest);
    case 2:
      return make_estimate<2>(c, fastest);
    default:
      return make_estimate<3>(c, fastest);
  }
}

double bytes_of_cell(int dim) {
  // Blocks at a surface are partly empty: half as much again.
  return 1.5 * (dim == 1 ? bytes_per_cell<1>() : dim == 2 ? bytes_per_cell<2>() : bytes_per_cell<3>());
}

double fastest_at_start(const config::Case& c, const std::vector<Material>& materials) {
  const int dim = config::dimension(c.domain.geometry);
  double fastest = 0;
  for (std::size_t m = 0; m < c.bodies.size(); ++m) {
    if (c.bodies[m].rigid) continue;
    double speed = dim * longitudinal_speed(materials[m]);
    for (const double u : c.bodies[m].velocity) speed += std::abs(u);
    fastest = std::max(fastest, speed);
  }
  return fastest;
}

}  // namespace recoil::app
