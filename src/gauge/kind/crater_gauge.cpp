#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "gauge/fragments/fragments.hpp"
#include "gauge/gauge_watch.hpp"
#include "gauge/periods.hpp"

namespace recoil {

namespace {

/// A line of cells normal to the surface: its indices on the finest level, 0 along the normal.
template <int Dim>
using Line = std::array<int, Dim>;

template <int Dim>
class CraterWatch : public GaugeWatch<Dim> {
 public:
  CraterWatch(const config::CraterGauge& from, const WatchSetup<Dim>& setup)
      : body_(body_number(setup.state, from.body)),
        at_(first_components<Dim>(from.at)),
        axis_(main_axis(first_components<Dim>(from.direction))),
        out_(from.direction[static_cast<std::size_t>(axis_)] > 0 ? 1 : -1),
        radius_(from.radius),
        grid_(setup.state.grid()) {}

  void collect(const State<Dim>& state, const parallel::World& world, bool /*at_rest*/,
               ExactSums& /*sums*/) override {
    const Fragments<Dim> fragments = find_fragments(state, world);
    std::map<Line<Dim>, double> own;
    const int heaviest = fragments.heaviest[static_cast<std::size_t>(body_)];
    const Body<Dim>& body = state.bodies[body_];
    for (int slot = 0; slot < state.mesh.local() && !body.rigid; ++slot)
      if (body.present(slot) && heaviest >= 0) look_at_block(state, fragments, heaviest, slot, own);
    parallel::Bytes bytes;
    for (const auto& entry : own) {
      parallel::pack(bytes, entry.first);
      parallel::pack(bytes, entry.second);
    }
    depth_.clear();
    for (const auto& from : world.gather(bytes))
      for (parallel::Unpacker reader(from); !reader.empty();) {
        const auto line = reader.template read<Line<Dim>>();
        note(depth_, line, reader.template read<double>());
      }
  }
  void read(const GaugeReading<Dim>& /*reading*/, std::vector<double>& row) override {
    double deepest = nothing, wide = 0, open = 0, volume = 0;
    for_each(lines(), [&](const Index<Dim>& i) {
      const double area = area_of(i);
      if (area == 0) return;
      const Index<Dim> line = mirrored(i);
      const auto found = depth_.find(line.c);
      if (found == depth_.end()) return void((wide += area, open += area));
      const double depth = std::max(found->second, 0.0);
      deepest = std::fmax(deepest, depth);
      if (line == i) volume += area * depth;
      if (depth > 0.5 * grid_.dx) wide += area;
    });
    row.insert(row.end(), {deepest, width(wide), volume, width(open)});
  }

 private:
  static void note(std::map<Line<Dim>, double>& depth, const Line<Dim>& line, double value) {
    const auto [at, fresh] = depth.try_emplace(line, value);
    if (!fresh) at->second = std::min(at->second, value);
  }

  /// Whether lines beyond an edge are images of those within. Those beyond the axis are not: rings are whole.
  bool has_images(int d, int side) const {
    return grid_.edge[d][side] == Edge::reflect && !(grid_.has_radius() && d == 0);
  }
  /// The lines that may be near enough, images beyond planes of symmetry among them.
  Box<Dim> lines() const {
    Box<Dim> box = grid_.domain();
    for (int d = 0; d < Dim; ++d) {
      if (d == axis_) box.hi[d] = 1;
      if (d == axis_ || grid_.periodic(d)) continue;
      const auto place = [&](double x) {
        return static_cast<int>(std::floor((x - grid_.origin[d]) / grid_.dx));
      };
      const int n = grid_.cells[d];
      box.lo[d] = std::max(has_images(d, 0) ? -n : 0, place(at_[d] - radius_));
      box.hi[d] = std::min(has_images(d, 1) ? 2 * n : n, place(at_[d] + radius_) + 1);
    }
    return box;
  }
  /// The line of the domain of which one beyond an edge is the image.
  Index<Dim> mirrored(Index<Dim> i) const {
    for (int d = 0; d < Dim; ++d) {
      if (i[d] < 0) i[d] = -1 - i[d];
      if (i[d] >= grid_.cells[d]) i[d] = 2 * grid_.cells[d] - 1 - i[d];
    }
    return i;
  }
  /// Area that a line stands for [m^(Dim-1), whole rings]; 0 where it is too far away.
  double area_of(const Index<Dim>& i) const {
    Vec<Dim> away = shortest_way(grid_, grid_.centre(i), at_);
    away[axis_] = 0;
    if (norm(away) > radius_) return 0;
    return grid_.dx_power(Dim - 1) * (grid_.has_radius() ? 2 * std::numbers::pi * grid_.weight(i[0]) : 1);
  }
  /// Of an area: planar itself, else the diameter of the circle that has it.
  double width(double area) const {
    return Dim == 2 && !grid_.has_radius() ? area : 2 * std::sqrt(area / std::numbers::pi);
  }

  void look_at_block(const State<Dim>& state, const Fragments<Dim>& fragments, int heaviest, int slot,
                     std::map<Line<Dim>, double>& own) const {
    const Grid<Dim>& grid = state.grid(slot);
    const BodyBlock<Dim>& b = state.bodies[body_].at(slot);
    const Block<Dim>& block = state.mesh.block(slot);
    const Box<Dim> layout = grid.layout();
    for_each(block.cells, [&](const Index<Dim>& i) {
      const int k = layout.at(i - block.cells.lo);
      if (fragments.at(body_, slot, k) != heaviest) return;
      const double phi = b.phi[static_cast<std::size_t>(k)];
      if (phi > 0 && b.volume[static_cast<std::size_t>(k)] < 0.5 * grid.full_volume(i)) return;
      const double reach = std::clamp(-phi, -0.5 * grid.dx, 0.5 * grid.dx);
      const double depth = out_ * (at_[axis_] - grid.centre(i)[axis_]) - reach;
      Box<Dim> narrow;  // the lines of the finest level in this cell
      for (int d = 0; d < Dim; ++d) {
        narrow.lo[d] = d == axis_ ? 0 : i[d] << block.level;
        narrow.hi[d] = d == axis_ ? 1 : (i[d] + 1) << block.level;
      }
      for_each(narrow, [&](const Index<Dim>& j) {
        if (area_of(j) > 0) note(own, j.c, depth);
      });
    });
  }

  int body_;
  Vec<Dim> at_;
  int axis_, out_;
  double radius_;
  Grid<Dim> grid_;                     // of the finest level
  std::map<Line<Dim>, double> depth_;  // m, of the first matter; on rank 0
};

}  // namespace

RECOIL_WATCH(config::CraterGauge, CraterWatch)

}  // namespace recoil
