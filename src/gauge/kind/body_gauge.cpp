#include <vector>

#include "gauge/gauge_watch.hpp"

namespace recoil {

namespace {

template <int Dim>
class BodyWatch : public GaugeWatch<Dim> {
 public:
  BodyWatch(const config::BodyGauge& from, const WatchSetup<Dim>& setup)
      : body_(body_number(setup.state, from.body)) {}

  bool needs_totals() const override { return true; }
  void read(const GaugeReading<Dim>& reading, std::vector<double>& row) override {
    const BodyTotals<Dim>& b = reading.totals->bodies[body_];
    const double whole = reading.units.whole;
    append(row, b.momentum * (1 / b.mass));
    append(row, b.place * (1 / b.mass));
    append(row, b.lowest);
    append(row, b.highest);
    row.insert(row.end(),
               {whole * b.mass, whole * b.kinetic, whole * b.internal(), b.plastic_strain, whole * b.failed});
  }

 private:
  int body_;
};

}  // namespace

RECOIL_WATCH(config::BodyGauge, BodyWatch)

}  // namespace recoil
