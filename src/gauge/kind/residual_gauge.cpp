#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "gauge/gauge_watch.hpp"

namespace recoil {

namespace {

/// Sums: mass, kinetic energy, momentum.
template <int Dim>
class ResidualWatch : public GaugeWatch<Dim> {
 public:
  ResidualWatch(const config::ResidualGauge& from, const WatchSetup<Dim>& setup)
      : body_(body_number(setup.state, from.body)),
        at_(first_components<Dim>(from.at)),
        direction_(first_components<Dim>(from.direction)),
        round_(setup.state.grid().radial_power == 1),
        item_(setup.sums.item(2 + Dim)) {}

  void collect(const State<Dim>& state, const parallel::World& /*world*/, bool /*at_rest*/,
               ExactSums& sums) override {
    for_each_part(state, body_, [&](int m) {
      const Body<Dim>& body = state.bodies[m];
      for (int slot = 0; slot < state.mesh.local() && !body.rigid; ++slot)
        if (body.present(slot)) add_block(state, body.at(slot), slot, sums);
    });
  }
  void read(const GaugeReading<Dim>& reading, std::vector<double>& row) override {
    const auto total = reading.sums.total(item_);
    const bool some = total[0] > 0;
    Vec<Dim> u;
    for (int d = 0; d < Dim; ++d) u[d] = some ? total[2 + static_cast<std::size_t>(d)] / total[0] : nothing;
    append(row, u);
    if (round_) u[0] = 0;  // of a ring it has no meaning
    const double speed = norm(u);
    const double cosine = std::clamp(dot(u, direction_) / speed, -1.0, 1.0);
    row.insert(row.end(), {some ? speed : nothing, reading.units.whole * total[0],
                           reading.units.whole * total[1], some && speed > 0 ? std::acos(cosine) : nothing});
  }

 private:
  void add_block(const State<Dim>& state, const BodyBlock<Dim>& b, int slot, ExactSums& sums) const {
    const Grid<Dim>& grid = state.grid(slot);
    const Block<Dim>& block = state.mesh.block(slot);
    const Box<Dim> layout = grid.layout();
    const std::size_t n = b.volume.size();
    const SumRow row = sums.add(item_);
    for_each(block.cells, [&](const Index<Dim>& i) {
      const auto k = static_cast<std::size_t>(layout.at(i - block.cells.lo));
      const double mass = b.contents[k];
      if (!(mass > 0) || !(dot(grid.centre(i) - at_, direction_) > 0)) return;
      double square = 0;
      for (std::size_t d = 0; d < Dim; ++d) {
        const double momentum = b.contents[(Components<Dim>::u + d) * n + k];
        row[2 + d] += momentum;
        square += momentum * momentum;
      }
      row[0] += mass;
      row[1] += 0.5 * square / mass;
    });
  }

  int body_;
  Vec<Dim> at_, direction_;
  bool round_;
  int item_;
};

}  // namespace

RECOIL_WATCH(config::ResidualGauge, ResidualWatch)

}  // namespace recoil
