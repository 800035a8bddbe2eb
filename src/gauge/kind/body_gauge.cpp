#include <vector>

#include "gauge/gauge_watch.hpp"

namespace recoil {

namespace {

template <int Dim>
class BodyWatch : public GaugeWatch<Dim> {
 public:
  BodyWatch(const config::BodyGauge& from, const WatchSetup<Dim>& setup)
      : body_(body_number(setup.state, from.body)) {
    for_each_part(setup.state, body_, [&](int m) {
      if (m != body_) fragments_.push_back(m);
    });
  }

  bool needs_totals() const override { return true; }
  void read(const GaugeReading<Dim>& reading, std::vector<double>& row) override {
    BodyTotals<Dim> b = reading.totals->bodies[body_];
    for (const int m : fragments_) b += reading.totals->bodies[m];
    const double whole = reading.units.whole;
    const double per_mass = b.mass > 0 ? 1 / b.mass : nothing;  // of an empty body
    append(row, b.momentum * per_mass);
    append(row, b.place * per_mass);
    append(row, b.lowest);
    append(row, b.highest);
    row.insert(row.end(),
               {whole * b.mass, whole * b.kinetic, whole * b.internal(), b.plastic_strain, whole * b.failed});
  }

 private:
  int body_;
  std::vector<int> fragments_;  // bodies that take up fragments of it
};

}  // namespace

RECOIL_WATCH(config::BodyGauge, BodyWatch)

}  // namespace recoil
