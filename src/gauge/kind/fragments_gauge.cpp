#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "gauge/fragments/fragments.hpp"
#include "gauge/gauge_watch.hpp"

namespace recoil {

namespace {

template <int Dim>
class FragmentsWatch : public GaugeWatch<Dim> {
 public:
  FragmentsWatch(const config::FragmentsGauge& from, const WatchSetup<Dim>& setup)
      : body_(body_number(setup.state, from.body)),
        small_(from.smaller_than > 0 ? from.smaller_than : 2 * setup.state.grid().dx) {}

  void collect(const State<Dim>& state, const parallel::World& world, bool /*at_rest*/,
               ExactSums& /*sums*/) override {
    found_ = find_fragments(state, world).list;
    parts_.clear();
    for_each_part(state, body_, [&](int m) { parts_.push_back(m); });
  }
  void read(const GaugeReading<Dim>& reading, std::vector<double>& row) override {
    double count = 0, small_count = 0, small = 0, rubble = 0;
    const Fragment<Dim>* heaviest = nullptr;
    for (const Fragment<Dim>& f : found_) {
      if (std::ranges::find(parts_, f.body) == parts_.end()) continue;
      if (f.piece && (heaviest == nullptr || f.mass > heaviest->mass)) heaviest = &f;
      if (!f.piece)
        rubble += f.mass;
      else if (f.diameter < small_)
        ++small_count, small += f.mass;
      else
        ++count;
    }
    const double whole = reading.units.whole;
    row.push_back(count);
    row.push_back(heaviest == nullptr ? 0 : whole * heaviest->mass);
    for (int d = 0; d < Dim; ++d) row.push_back(heaviest == nullptr ? nothing : heaviest->velocity[d]);
    row.insert(row.end(), {small_count, whole * small, whole * rubble});
  }

 private:
  int body_;
  std::vector<int> parts_;  // it, and the bodies that take up its fragments
  double small_;            // m
  std::vector<Fragment<Dim>> found_;
};

}  // namespace

RECOIL_WATCH(config::FragmentsGauge, FragmentsWatch)

}  // namespace recoil
