#include <cstddef>
#include <vector>

#include "gauge/gauge_watch.hpp"
#include "gauge/point_probe.hpp"

namespace recoil {

namespace {

template <int Dim>
class PointWatch : public GaugeWatch<Dim> {
 public:
  PointWatch(const config::PointGauge& from, const WatchSetup<Dim>& setup)
      : point_{.body = body_number(setup.state, from.body),
               .follows = from.follows,
               .at = first_components<Dim>(from.at),
               .velocity = {}},
        item_(setup.sums.item(point_sums<Dim>)) {}

  bool reads_contents_around() const override { return true; }
  bool follows_every_step() const override { return point_.follows; }
  void collect(const State<Dim>& state, const parallel::World& /*world*/, bool /*at_rest*/,
               ExactSums& sums) override {
    probe_point(state, point_, item_, sums);
  }
  void follow(const ExactSums& sums, double dt) override {
    follow_point(point_, point_.time + dt, sums.any(item_), sums.total(item_));
  }
  void read(const GaugeReading<Dim>& reading, std::vector<double>& row) override {
    const auto found = reading.sums.total(item_);
    const bool there = reading.sums.any(item_);
    // Sums keep the density first; in the file the pressure comes first.
    const auto at = [&](std::size_t k) { row.push_back(there ? found[k] : nothing); };
    constexpr std::size_t von_mises = 2 + Dim + PointState<Dim>::stresses;
    at(1 + Dim);
    for (std::size_t d = 0; d < Dim; ++d) at(1 + d);
    for (std::size_t k = 2 + Dim; k < von_mises; ++k) at(k);
    at(0);
    for (std::size_t k = von_mises; k + Dim < point_sums<Dim>; ++k) at(k);
    if (point_.follows) append(row, point_.at);
  }
  void pack(parallel::Bytes& bytes) const override { parallel::pack(bytes, point_); }
  void unpack(parallel::Unpacker& bytes) override { point_ = bytes.read<BodyPoint<Dim>>(); }

 private:
  BodyPoint<Dim> point_;
  int item_;
};

}  // namespace

RECOIL_WATCH(config::PointGauge, PointWatch)

}  // namespace recoil
