#include "app/check/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

#include "app/run/stepping.hpp"
#include "problem/shape.hpp"
#include "problem/start.hpp"
#include "record/field_dump.hpp"
#include "state/fields.hpp"

namespace recoil::app {

namespace {

constexpr double samples = 1e6;
/// Processor time of a step of three stages [s] for each cell, for a yield stress that depends on the rate on
/// top of that, and for each cut cell: the median of 85 shipped cases of the conservative scheme, as `recoil
/// verify` runs them, two at a time, is met. 51 of them are met within 30 %. Where matter fails it is 1.6 to
/// 2 times as long, where gas leaves or enters the domain (noh_*, detonation) many times.
struct CellTime {
  double each, rate, cut;
};
constexpr CellTime cell_time[] = {
    {0.26e-6, 0.36e-6, 15.6e-6}, {0.78e-6, 0.65e-6, 12.4e-6}, {2e-6, 0.8e-6, 27e-6}};
constexpr double one_stage = 0.67;      // of the time of three
constexpr double program_bytes = 65e6;  // of a process without cells

/// Cells of one body: with their centre inside, and cut by its surface.
struct BodyCells {
  double inside = 0, cut = 0;
};

template <int Dim>
std::vector<BodyCells> sampled_cells(const config::Case& c) {
  const Grid<Dim> grid = make_grid<Dim>(c);
  double total = 1;
  for (int d = 0; d < Dim; ++d) total *= grid.cells[d];
  const int stride = static_cast<int>(std::max(1.0, std::ceil(std::pow(total / samples, 1.0 / Dim))));
  Box<Dim> points;
  for (int d = 0; d < Dim; ++d) points.hi[d] = (grid.cells[d] + stride - 1) / stride;
  std::vector<BodyCells> cells;
  for (const config::Body& body : c.bodies) {
    const auto distance = signed_distance<Dim>(body.shape, c.domain);
    double inside = 0, cut = 0;
    for_each(points, [&](const Index<Dim>& i) {
      Index<Dim> at;
      for (int d = 0; d < Dim; ++d) at[d] = i[d] * stride + stride / 2;
      const double phi = distance(grid.centre(at));
      inside += phi < 0;
      cut += std::abs(phi) < 0.5 * stride * grid.dx;
    });
    cells.push_back({inside * std::pow(stride, Dim), cut * std::pow(stride, Dim - 1)});
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

/// Of one step [s].
double step_time(const Material& material, const BodyCells& cells, const CellTime& t) {
  double each = t.each;
  if (std::visit([](const auto& model) { return model.rate_dependent; }, material.strength)) each += t.rate;
  return each * cells.inside + t.cut * cells.cut;
}

template <int Dim>
Estimate make_estimate(const config::Case& c, const std::vector<Material>& materials, double fastest) {
  Estimate e;
  e.cells = cells_of_domain<Dim>(c);
  const std::vector<BodyCells> cells = sampled_cells<Dim>(c);
  double each_step = 0;
  for (std::size_t m = 0; m < cells.size(); ++m) {
    if (c.bodies[m].rigid) continue;
    e.material_cells += cells[m].inside;
    e.cut_cells += cells[m].cut;
    each_step += step_time(materials[m], cells[m], cell_time[Dim - 1]);
  }
  e.step = c.time.fixed_dt ? *c.time.fixed_dt : c.time.cfl * c.mesh.finest / fastest;
  e.steps = std::ceil(c.time.end / e.step);
  double held = e.material_cells;
  if (c.mesh.levels > 1) {
    for (const double n : cells_at_start<Dim>(c)) e.start_cells += n;
    held = std::min(held, e.start_cells);
    each_step *= held / e.material_cells;
  }
  // What a run holds from step to step, and on top of it what its field files take while they are written.
  e.memory = program_bytes + held * (bytes_of_cell(c) +
                                     bytes_of_dumped_cell<Dim>(c.output.fields.variables, c.bodies.size()));
  e.seconds = e.steps * each_step * (stepping_of(c).stages == StepStages::one ? one_stage : 1);
  return e;
}

}  // namespace

std::vector<double> cells_of_bodies(const config::Case& c) {
  const int dim = config::dimension(c.domain.geometry);
  std::vector<double> inside;
  for (const BodyCells& b : dim == 1   ? sampled_cells<1>(c)
                            : dim == 2 ? sampled_cells<2>(c)
                                       : sampled_cells<3>(c))
    inside.push_back(b.inside);
  return inside;
}

Estimate estimate(const config::Case& c, const std::vector<Material>& materials, double fastest) {
  switch (config::dimension(c.domain.geometry)) {
    case 1:
      return make_estimate<1>(c, materials, fastest);
    case 2:
      return make_estimate<2>(c, materials, fastest);
    default:
      return make_estimate<3>(c, materials, fastest);
  }
}

double bytes_of_cell(const config::Case& c) {
  const int dim = config::dimension(c.domain.geometry);
  const FieldSet kept =
      stepping_of(c).stages == StepStages::one ? FieldSet() : Field::contents_old | Field::volume_old;
  // Blocks at a surface are partly empty: half as much again.
  return 1.5 * (dim == 1   ? bytes_per_cell<1>(kept)
                : dim == 2 ? bytes_per_cell<2>(kept)
                           : bytes_per_cell<3>(kept));
}

double fastest_at_start(const config::Case& c, const std::vector<Material>& materials) {
  double fastest = 0;
  for (std::size_t m = 0; m < c.bodies.size(); ++m) {
    if (c.bodies[m].rigid) continue;
    double speed = sound_in_step(c) * longitudinal_speed(materials[m]);
    for (const double u : c.bodies[m].velocity) speed += std::abs(u);
    fastest = std::max(fastest, speed);
  }
  return fastest;
}

}  // namespace recoil::app
