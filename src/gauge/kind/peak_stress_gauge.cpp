#include <cstddef>
#include <vector>

#include "gauge/gauge_watch.hpp"
#include "gauge/stress_line.hpp"

namespace recoil {

namespace {

template <int Dim>
class PeakStressWatch : public GaugeWatch<Dim> {
 public:
  PeakStressWatch(const config::PeakStressGauge& from, const WatchSetup<Dim>& setup)
      : length_(norm(first_components<Dim>(from.to) - first_components<Dim>(from.at))),
        line_(stress_line(body_number(setup.state, from.body), first_components<Dim>(from.at),
                          first_components<Dim>(from.to), from.stations)),
        first_item_(line_items(line_, setup.sums)) {}

  bool reads_every_step() const override { return true; }
  std::vector<double> distances() const override {
    const int stations = static_cast<int>(line_.stations.size());
    std::vector<double> all;
    for (int k = 1; k <= stations; ++k) all.push_back(length_ * k / stations);
    return all;
  }
  void collect(const State<Dim>& state, const parallel::World& /*world*/, bool /*at_rest*/,
               ExactSums& sums) override {
    collect_line(state, line_, first_item_, sums);
  }
  void read(const GaugeReading<Dim>& reading, std::vector<double>& /*row*/) override {
    follow_line(line_, reading.time, reading.dt, first_item_, reading.sums);
  }
  void read_all(std::vector<std::vector<double>>& values) const override {
    for (std::size_t k = 0; k < line_.stations.size(); ++k)
      values[0][k] = line_.stations[k].peak, values[1][k] = line_.stations[k].time;
  }
  void pack(parallel::Bytes& bytes) const override {
    parallel::pack(bytes, line_.stations.data(), line_.stations.size());
  }
  void unpack(parallel::Unpacker& bytes) override {
    bytes.read(line_.stations.data(), line_.stations.size());
  }

 private:
  double length_;  // m
  StressLine<Dim> line_;
  int first_item_;
};

}  // namespace

RECOIL_WATCH(config::PeakStressGauge, PeakStressWatch)

}  // namespace recoil
