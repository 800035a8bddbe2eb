#include <vector>

#include "gauge/gauge_watch.hpp"
#include "gauge/probes.hpp"

namespace recoil {

namespace {

template <int Dim>
class SurfaceWatch : public GaugeWatch<Dim> {
 public:
  SurfaceWatch(const config::SurfaceVelocityGauge& from, const WatchSetup<Dim>& setup)
      : grid_(setup.state.grid()),
        point_{body_number(setup.state, from.body), first_components<Dim>(from.at), {}},
        item_(setup.sums.item(surface_sums<Dim>)) {}

  bool follows_every_step() const override { return true; }
  double before_end() const override { return 0.5; }  // walls have a mean velocity over the step
  void collect(const State<Dim>& state, const parallel::World& /*world*/, bool at_rest,
               ExactSums& sums) override {
    if (at_rest)
      probe_surface_at_rest(state, point_, item_, sums);
    else
      probe_surface(state, point_, item_, sums);
  }
  void follow(const ExactSums& sums, double dt) override {
    follow_surface(grid_, point_, read_surface<Dim>(sums.total(item_)), dt);
  }
  void read(const GaugeReading<Dim>& reading, std::vector<double>& row) override {
    const auto surface = read_surface<Dim>(reading.sums.total(item_));
    row.push_back(surface.found ? dot(surface.velocity, surface.normal) : nothing);
    for (int d = 0; d < Dim; ++d) row.push_back(surface.found ? surface.velocity[d] : nothing);
    SurfacePoint<Dim> then = point_;
    follow_surface(grid_, then, surface, -reading.before);
    append(row, then.at);
  }
  void pack(parallel::Bytes& bytes) const override { parallel::pack(bytes, point_); }
  void unpack(parallel::Unpacker& bytes) override { point_ = bytes.read<SurfacePoint<Dim>>(); }

 private:
  Grid<Dim> grid_;  // of the finest level
  SurfacePoint<Dim> point_;
  int item_;
};

}  // namespace

RECOIL_WATCH(config::SurfaceVelocityGauge, SurfaceWatch)

}  // namespace recoil
