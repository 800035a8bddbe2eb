#include <cstddef>
#include <vector>

#include "gauge/gauge_watch.hpp"
#include "gauge/probes.hpp"

namespace recoil {

namespace {

template <int Dim>
class PointWatch : public GaugeWatch<Dim> {
 public:
  PointWatch(const config::PointGauge& from, const WatchSetup<Dim>& setup)
      : body_(body_number(setup.state, from.body)),
        at_(first_components<Dim>(from.at)),
        item_(setup.sums.item(point_sums<Dim>)) {}

  void collect(const State<Dim>& state, const parallel::World& /*world*/, bool /*at_rest*/,
               OrderedSums& sums) override {
    probe_point(state, body_, at_, item_, sums);
  }
  void read(const GaugeReading<Dim>& reading, std::vector<double>& row) override {
    const auto found = reading.sums.total(item_);
    const bool there = reading.sums.any(item_);
    // Sums keep the density first; in the file the pressure comes first.
    const auto at = [&](std::size_t k) { row.push_back(there ? found[k] : nothing); };
    at(1 + Dim);
    for (std::size_t d = 0; d < Dim; ++d) at(1 + d);
    for (std::size_t k = 0; k < PointState<Dim>::stresses; ++k) at(2 + Dim + k);
    at(0);
    for (std::size_t k = point_sums<Dim> - 3; k < point_sums<Dim>; ++k) at(k);
  }

 private:
  int body_;
  Vec<Dim> at_;  // m
  int item_;
};

}  // namespace

RECOIL_WATCH(config::PointGauge, PointWatch)

}  // namespace recoil
