#include <string>
#include <vector>

#include "gauge/bar_shape.hpp"
#include "gauge/gauge_watch.hpp"

namespace recoil {

namespace {

/// The velocity along z at the start [m/s].
double falling(const std::string& name, const config::Case& c, int dim) {
  for (const config::Body& b : c.bodies)
    if (b.name == name) return b.velocity[dim - 1];
  return 0.0;
}

template <int Dim>
class BarShapeWatch : public GaugeWatch<Dim> {
 public:
  BarShapeWatch(const config::BarGauge& from, const WatchSetup<Dim>& setup)
      : grid_(setup.state.grid()), item_(bar_item(grid_, setup.sums)) {
    bar_.body = body_number(setup.state, from.body);
    bar_.wall = body_number(setup.state, from.wall);
    bar_.foot_low = !(falling(from.body, setup.contents, Dim) > falling(from.wall, setup.contents, Dim));
  }

  void collect(const State<Dim>& state, const parallel::World& /*world*/, bool /*at_rest*/,
               ExactSums& sums) override {
    collect_bar(state, bar_, item_, sums);
  }
  void read(const GaugeReading<Dim>& reading, std::vector<double>& row) override {
    const BarReading r = read_bar(grid_, bar_, reading.sums.total(item_));
    row = {r.length,         r.foot_radius,         r.radius,
           r.volume_radius,  r.contact_radius,      r.lift_off,
           r.plastic_strain, r.axis_plastic_strain, r.rim_lift_off};
  }

 private:
  Grid<Dim> grid_;
  int item_;
  BarWatch bar_;
};

}  // namespace

RECOIL_WATCH(config::BarGauge, BarShapeWatch)

}  // namespace recoil
