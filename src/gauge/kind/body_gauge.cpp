#include <array>
#include <cstddef>
#include <vector>

#include "gauge/gauge_watch.hpp"

namespace recoil {

namespace {

template <int Dim>
class BodyWatch : public GaugeWatch<Dim> {
 public:
  BodyWatch(const config::BodyGauge& from, const WatchSetup<Dim>& setup)
      : body_(body_number(setup.state, from.body)), rigid_(from.rigid) {
    for_each_part(setup.state, body_, [&](int m) {
      if (m != body_) fragments_.push_back(m);
    });
  }

  bool needs_totals() const override { return true; }
  void collect(const State<Dim>& state, const parallel::World& /*world*/, bool /*at_rest*/,
               ExactSums& /*sums*/) override {
    if (rigid_) see(*state.bodies[body_].rigid, state.grid());
  }
  void read(const GaugeReading<Dim>& reading, std::vector<double>& row) override {
    BodyTotals<Dim> b = reading.totals->bodies[body_];
    for (const int m : fragments_) b += reading.totals->bodies[m];
    const double whole = reading.units.whole;
    const double per_mass = b.mass > 0 ? 1 / b.mass : nothing;  // of an empty body
    append(row, massless_ ? velocity_ : b.momentum * per_mass);
    append(row, massless_ ? position_ : b.place * per_mass);
    append(row, b.lowest);
    append(row, b.highest);
    const std::array held{whole * b.mass, whole * b.kinetic, whole * b.internal(), b.plastic_strain,
                          whole * b.failed};
    for (const double value : held) row.push_back(massless_ ? nothing : value);
    if (!rigid_) return;
    const std::size_t turns = reading.units.turns.size();
    for (std::size_t k = 3 - turns; k < 3; ++k) row.push_back(spin_[static_cast<int>(k)]);
  }

 private:
  /// How a rigid body moves. Along a periodic axis it has no one place (gauge/totals.hpp).
  void see(const RigidMotion<Dim>& motion, const Grid<Dim>& grid) {
    massless_ = !motion.mass;
    spin_ = motion.spin;
    position_ = middle_at(motion, {motion.centre, motion.turn});
    Vec<3> arm;
    for (int d = 0; d < Dim; ++d) arm[d] = position_[d] - motion.centre[d];
    const Vec<3> turning = cross(motion.spin, arm);
    for (int d = 0; d < Dim; ++d) {
      velocity_[d] = motion.velocity[d] + turning[d];
      if (grid.periodic(d)) position_[d] = nothing;
    }
  }

  int body_;
  std::vector<int> fragments_;  // bodies that take up fragments of it
  bool rigid_, massless_ = false;
  Vec<Dim> velocity_, position_;  // of a rigid one's middle
  Vec<3> spin_;
};

}  // namespace

RECOIL_WATCH(config::BodyGauge, BodyWatch)

}  // namespace recoil
