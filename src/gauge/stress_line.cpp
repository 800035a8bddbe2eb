#include "gauge/stress_line.hpp"

#include <cmath>
#include <cstddef>

#include "dynamics/primitives.hpp"
#include "gauge/corners.hpp"
#include "gauge/periods.hpp"
#include "gauge/point_state.hpp"

namespace recoil {

namespace {

/// Places of the sums of a station: weight, and times that weight velocity and compressive stress.
template <int Dim>
struct At {
  static constexpr std::size_t weight = 0, velocity = 1, stress = 1 + Dim, all = 2 + Dim;
};

/// n . stress . n, with the components in the order of RunUnits::stresses.
template <int Dim>
double along_line(const PointState<Dim>& p, const Vec<Dim>& n) {
  if constexpr (Dim == 1) return p.stress[0];
  if constexpr (Dim == 2)
    return n[0] * n[0] * p.stress[0] + n[1] * n[1] * p.stress[1] + 2 * n[0] * n[1] * p.stress[2];
  if constexpr (Dim == 3)
    return n[0] * n[0] * p.stress[0] + n[1] * n[1] * p.stress[1] + n[2] * n[2] * p.stress[5] +
           2 * (n[0] * n[1] * p.stress[2] + n[0] * n[2] * p.stress[3] + n[1] * n[2] * p.stress[4]);
}

/// The share of a cell of the finest level in a station, if this rank has the block that holds its centre.
template <int Dim>
void add_cell(const State<Dim>& state, const StressLine<Dim>& line, const Index<Dim>& i, double weight,
              int item, ExactSums& sums) {
  const Vec<Dim> x = into_domain(state.grid(), state.grid().centre(i));
  const int slot = state.mesh.find(x);
  const Body<Dim>& body = state.bodies[line.body];
  if (slot < 0 || slot >= state.mesh.local() || !body.present(slot)) return;
  const Grid<Dim>& grid = state.grid(slot);
  const Block<Dim>& block = state.mesh.block(slot);
  const Index<Dim> cell = grid.cell_of(x);
  const int k = grid.layout().at(cell - block.cells.lo);
  const double volume = body.at(slot).volume[k];
  const Contents<Dim> contents = contents_of(body.at(slot), k);
  if (volume < shown_fill * grid.full_volume(cell) || !(contents[0] > 0)) return;
  const PointState<Dim> p = point_state(body, contents, volume);
  const SumRow row = sums.add(item);
  row[At<Dim>::weight] += weight;
  for (int d = 0; d < Dim; ++d)
    row[At<Dim>::velocity + static_cast<std::size_t>(d)] += weight * p.velocity[d];
  row[At<Dim>::stress] += -weight * along_line(p, line.along);
}

}  // namespace

template <int Dim>
StressLine<Dim> stress_line(int body, const Vec<Dim>& from, const Vec<Dim>& to, int stations) {
  StressLine<Dim> line{body, unit(to - from), {}};
  for (int k = 1; k <= stations; ++k) {
    Station<Dim> s;
    s.at = from + (static_cast<double>(k) / stations) * (to - from);
    line.stations.push_back(s);
  }
  return line;
}

template <int Dim>
int line_items(const StressLine<Dim>& line, ExactSums& sums) {
  int first = -1;
  for (std::size_t k = 0; k < line.stations.size(); ++k) {
    const int item = sums.item(At<Dim>::all);
    if (k == 0) first = item;
  }
  return first;
}

template <int Dim>
void collect_line(const State<Dim>& state, const StressLine<Dim>& line, int first_item, ExactSums& sums) {
  const Grid<Dim>& grid = state.grid();
  for (std::size_t k = 0; k < line.stations.size(); ++k) {
    for_corners(grid, line.stations[k].at, [&](const Index<Dim>& i, double weight) {
      add_cell(state, line, i, weight, first_item + static_cast<int>(k), sums);
    });
  }
}

template <int Dim>
void follow_line(StressLine<Dim>& line, double time, double dt, int first_item, const ExactSums& sums) {
  int item = first_item;
  for (Station<Dim>& s : line.stations) {
    const std::span<const double> total = sums.total(item++);
    if (!(total[At<Dim>::weight] > 0)) continue;
    const double stress = total[At<Dim>::stress] / total[At<Dim>::weight];
    for (int d = 0; d < Dim; ++d)
      s.at[d] += dt * total[At<Dim>::velocity + static_cast<std::size_t>(d)] / total[At<Dim>::weight];
    if (s.peak >= stress) continue;
    s.peak = stress;
    s.time = time;
  }
}

#define RECOIL_INSTANTIATE(Dim)                                                                \
  template StressLine<Dim> stress_line<Dim>(int, const Vec<Dim>&, const Vec<Dim>&, int);       \
  template int line_items<Dim>(const StressLine<Dim>&, ExactSums&);                            \
  template void collect_line<Dim>(const State<Dim>&, const StressLine<Dim>&, int, ExactSums&); \
  template void follow_line<Dim>(StressLine<Dim>&, double, double, int, const ExactSums&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
