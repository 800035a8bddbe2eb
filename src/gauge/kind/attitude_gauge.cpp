#include <vector>

#include "gauge/attitude.hpp"
#include "gauge/gauge_watch.hpp"

namespace recoil {

namespace {

template <int Dim>
class AttitudeWatch : public GaugeWatch<Dim> {
 public:
  AttitudeWatch(const config::AttitudeGauge& from, const WatchSetup<Dim>& setup)
      : body_(body_number(setup.state, from.body)), item_(setup.sums.item(attitude_sums)) {}

  void collect(const State<Dim>& state, const parallel::World& world, bool /*at_rest*/,
               ExactSums& sums) override {
    frame_ = find_frame(state, body_, world);
    collect_attitude(state, body_, frame_, item_, sums);
  }
  void read(const GaugeReading<Dim>& reading, std::vector<double>& row) override {
    const Attitude a = read_attitude(frame_, reading.sums.total(item_));
    row = {a.inclination, a.front_half, a.front_third, a.course, a.speed, a.head_x, a.head_y, a.spin};
  }

 private:
  int body_, item_;
  AttitudeFrame frame_;
};

}  // namespace

RECOIL_WATCH(config::AttitudeGauge, AttitudeWatch)

}  // namespace recoil
