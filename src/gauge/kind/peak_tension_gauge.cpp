#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "dynamics/primitives.hpp"
#include "dynamics/stress_invariants.hpp"
#include "gauge/gauge_watch.hpp"
#include "gauge/point_state.hpp"

namespace recoil {

namespace {

/// The largest of something, and where and when; of equal ones the first, then that of the cell which comes
/// first along the last axis.
template <int Dim>
struct Extreme {
  double value = -std::numeric_limits<double>::infinity(), time = nothing;
  Index<Dim> cell{};  // of the finest level
  Vec<Dim> position;

  void merge(const Extreme& b) {
    const bool before =
        std::lexicographical_compare(b.cell.c.rbegin(), b.cell.c.rend(), cell.c.rbegin(), cell.c.rend());
    if (b.value > value || (b.value == value && b.time == time && before)) *this = b;
  }
};

template <int Dim>
class PeakTensionWatch : public GaugeWatch<Dim> {
 public:
  PeakTensionWatch(const config::PeakTensionGauge& from, const WatchSetup<Dim>& setup)
      : body_(body_number(setup.state, from.body)) {}

  bool reads_every_step() const override { return true; }
  void collect(const State<Dim>& state, const parallel::World& world, bool /*at_rest*/,
               ExactSums& /*sums*/) override {
    Both now;
    for_each_part(state, body_, [&](int m) {
      const Body<Dim>& body = state.bodies[m];
      for (int slot = 0; slot < state.mesh.local() && !body.rigid; ++slot)
        if (body.present(slot)) look_at_block(state, body, slot, now);
    });
    parallel::Bytes bytes;
    parallel::pack(bytes, now);
    for (const auto& from : world.gather(bytes)) {
      const auto other = parallel::Unpacker(from).template read<Both>();
      for (std::size_t k = 0; k < so_far_.size(); ++k) so_far_[k].merge(other[k]);
    }
  }
  void read(const GaugeReading<Dim>& /*reading*/, std::vector<double>& row) override {
    for (std::size_t k = 0; k < so_far_.size(); ++k) {
      const Extreme<Dim>& e = so_far_[k];
      const bool some = e.value > -std::numeric_limits<double>::infinity();
      row.push_back(!some ? nothing : k == 0 ? e.value : -e.value);
      row.push_back(e.time);
      for (int d = 0; d < Dim; ++d) row.push_back(some ? e.position[d] : nothing);
    }
  }
  void pack(parallel::Bytes& bytes) const override { parallel::pack(bytes, so_far_); }
  void unpack(parallel::Unpacker& bytes) override { so_far_ = bytes.read<Both>(); }

 private:
  using Both = std::array<Extreme<Dim>, 2>;  // of the principal stress, of the negative pressure

  static void look_at_block(const State<Dim>& state, const Body<Dim>& body, int slot, Both& now) {
    const Grid<Dim>& grid = state.grid(slot);
    const BodyBlock<Dim>& b = body.at(slot);
    const Box<Dim> cells = state.mesh.block(slot).cells, layout = grid.layout();
    for_each(cells, [&](const Index<Dim>& i) {
      const int k = layout.at(i - cells.lo);
      const Contents<Dim> q = contents_of(b, k);
      if (b.volume[k] < shown_fill * grid.full_volume(i) || !(q[0] > 0)) return;
      const PointState<Dim> p = point_state(body, q, b.volume[k]);
      const Index<Dim> finest = state.mesh.finest_index(slot, i);
      now[0].merge({largest_principal(p), state.time, finest, grid.centre(i)});
      now[1].merge({-p.pressure, state.time, finest, grid.centre(i)});
    });
  }

  int body_;
  Both so_far_;  // on rank 0
};

}  // namespace

RECOIL_WATCH(config::PeakTensionGauge, PeakTensionWatch)

}  // namespace recoil
