#include <algorithm>
#include <cstddef>
#include <vector>

#include "gauge/due.hpp"
#include "gauge/gauge_watch.hpp"
#include "gauge/kind/pullback_signal.hpp"
#include "gauge/periods.hpp"
#include "gauge/probes.hpp"
#include "parallel/archive.hpp"

namespace recoil {

namespace {

template <int Dim>
class PullbackWatch : public GaugeWatch<Dim> {
 public:
  PullbackWatch(const config::PullbackGauge& from, const WatchSetup<Dim>& setup)
      : grid_(setup.state.grid()),
        point_{body_number(setup.state, from.body), first_components<Dim>(from.at), {}},
        item_(setup.sums.item(surface_sums<Dim>)),
        scab_item_(setup.sums.item(0, 1)),
        due_(from.every) {
    const Body<Dim>& body = setup.state.bodies[point_.body];
    if (body.rigid) return;
    density_ = density(body.material), sound_ = bulk_sound_speed(body.material);
    longitudinal_ = longitudinal_speed(body.material);
    may_fail_ = can_fail(body.material.damage);
  }

  bool reads_every_step() const override { return true; }
  void collect(const State<Dim>& state, const parallel::World& /*world*/, bool at_rest,
               ExactSums& sums) override {
    if (at_rest)
      probe_surface_at_rest(state, point_, item_, sums);
    else
      probe_surface(state, point_, item_, sums);
    if (may_fail_ && due_.at(state.time)) look_for_failed(state, sums);
    if (due_.at(state.time)) due_.done(state.time);
  }
  void read(const GaugeReading<Dim>& reading, std::vector<double>& row) override {
    const auto surface = read_surface<Dim>(reading.sums.total(item_));
    follow_surface(grid_, point_, surface, reading.dt);
    if (surface.found) signal_.add(reading.time - 0.5 * reading.dt, dot(surface.velocity, surface.normal));
    if (reading.sums.any(scab_item_)) scab_ = -reading.sums.total(scab_item_)[0];
    const double fall = signal_.fall();
    row.insert(row.end(), {fall, 0.5 * density_ * sound_ * fall, 0.5 * signal_.slope() / sound_,
                           signal_.peak(), signal_.peak_time(), signal_.low(), signal_.low_time(), scab_,
                           0.5 * longitudinal_ * signal_.period()});
  }
  void pack(parallel::Bytes& bytes) const override {
    parallel::ArchiveWriter archive(bytes);
    archive(point_, signal_, scab_, due_);
  }
  void unpack(parallel::Unpacker& bytes) override {
    parallel::ArchiveReader archive(bytes);
    archive(point_, signal_, scab_, due_);
  }

 private:
  /// The smallest distance from the surface, against its normal, to the near side of a failed cell.
  void look_for_failed(const State<Dim>& state, ExactSums& sums) const {
    if (point_.normal == Vec<Dim>{}) return;
    double length = 0;
    for (int d = 0; d < Dim; ++d) length += grid_.cells[d] * grid_.dx;
    for (int n = 0; n * grid_.dx < length; ++n) {
      const Vec<Dim> x = into_domain(grid_, point_.at - (n + 0.5) * grid_.dx * point_.normal);
      const int slot = state.mesh.find(x);
      if (slot < 0 || slot >= state.mesh.local()) continue;
      const Grid<Dim>& own = state.grid(slot);
      const Index<Dim> i = own.cell_of(x);
      const auto k = static_cast<std::size_t>(own.layout().at(i - state.mesh.block(slot).cells.lo));
      bool failed = false;
      for_each_part(state, point_.body, [&](int m) {
        if (!state.bodies[m].present(slot)) return;
        const BodyBlock<Dim>& b = state.bodies[m].at(slot);
        const double damage = b.contents[Components<Dim>::damage * b.volume.size() + k];
        failed = failed || (damage > 0 && damage >= failed_damage * b.contents[k]);
      });
      if (!failed) continue;
      const double near =
          std::max(0.0, dot(shortest_way(grid_, point_.at, own.centre(i)), point_.normal) - 0.5 * own.dx);
      sums.add(scab_item_).raise(0, -near);
    }
  }

  Grid<Dim> grid_;  // of the finest level
  SurfacePoint<Dim> point_;
  int item_, scab_item_;
  Due due_;  // of the look along the normal
  double density_ = nothing, sound_ = nothing, longitudinal_ = nothing, scab_ = nothing;
  bool may_fail_ = false;
  PullbackSignal signal_;
};

}  // namespace

RECOIL_WATCH(config::PullbackGauge, PullbackWatch)

}  // namespace recoil
