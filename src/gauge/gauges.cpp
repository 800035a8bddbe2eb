#include "gauge/gauges.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <variant>

namespace recoil {

namespace {

/// Time between two records [s]; 0: every step.
double every(const config::GaugeKind& kind) {
  return std::visit(
      [](const auto& k) {
        if constexpr (requires { k.every; }) return k.every;
        return 0.0;
      },
      kind);
}

}  // namespace

template <int Dim>
Gauges<Dim>::Gauges(const config::Case& c, const State<Dim>& state, const parallel::World& world,
                    const std::filesystem::path& folder, OrderedSums& sums)
    : world_(world), units_(run_units(c.domain.geometry)), folder_(folder) {
  const WatchSetup<Dim> setup{c, state, sums};
  for (const config::Gauge& from : c.gauges) {
    Gauge& g = gauges_.emplace_back();
    g.due = Due(every(from.kind));
    g.series.name = from.name;
    std::visit(
        [&](const auto& kind) {
          g.watch = make_watch<Dim>(kind, setup);
          if (world.rank() == 0) open(g, column_list(kind.columns(), units_));
        },
        from.kind);
  }
}

template <int Dim>
void Gauges<Dim>::open(Gauge& g, std::vector<SeriesColumn> columns) {
  g.watch->choose_columns(columns);
  g.series.columns = std::move(columns);
  g.series.time = g.watch->distances();
  g.over_distance = !g.series.time.empty();
  if (g.over_distance) g.series.over = {"distance", "mm", 1e3};
  g.series.values.assign(g.series.columns.size(), std::vector<double>(g.series.time.size(), nothing));
  std::vector<std::string> names{g.series.over.name + " [" + g.series.over.unit + "]"};
  for (const SeriesColumn& c : g.series.columns) names.push_back(c.name + " [" + c.unit + "]");
  g.file.emplace(folder_ / (g.series.name + ".csv"), names);
}

template <int Dim>
bool Gauges<Dim>::needs_totals(double time) const {
  for (const Gauge& g : gauges_)
    if (g.watch->needs_totals() && g.due.at(time)) return true;
  return false;
}

template <int Dim>
void Gauges<Dim>::collect(const State<Dim>& state, OrderedSums& sums, bool at_rest, bool all) {
  for (Gauge& g : gauges_)
    if (all || g.watch->follows_every_step() || g.due.at(state.time))
      g.watch->collect(state, world_, at_rest, sums);
}

template <int Dim>
void Gauges<Dim>::write(Gauge& g, double time) {
  if (g.over_distance) return;
  if (!g.series.time.empty() && !(time > g.series.time.back())) return;
  g.series.time.push_back(time);
  written_.assign(1, time * 1e6);
  for (std::size_t c = 0; c < row_.size(); ++c) {
    g.series.values[c].push_back(row_[c]);
    written_.push_back(row_[c] * g.series.columns[c].to_unit + 0.0);  // no -0 in files
  }
  g.file->row(written_);
}

template <int Dim>
void Gauges<Dim>::write_distances(Gauge& g) {
  std::vector<std::string> names = g.file->columns();
  g.file.emplace(folder_ / (g.series.name + ".csv"), std::move(names));
  g.watch->read_all(g.series.values);
  for (std::size_t k = 0; k < g.series.time.size(); ++k) {
    written_.assign(1, g.series.time[k] * g.series.over.to_unit);
    for (std::size_t c = 0; c < g.series.columns.size(); ++c)
      written_.push_back(g.series.values[c][k] * g.series.columns[c].to_unit);
    g.file->row(written_);
  }
}

template <int Dim>
void Gauges<Dim>::share() {
  if (world_.size() == 1) return;
  parallel::Bytes bytes;
  for (const Gauge& g : gauges_) g.watch->pack(bytes);
  if (bytes.empty()) return;
  world_.broadcast(bytes);
  parallel::Unpacker reader(bytes);
  for (Gauge& g : gauges_) g.watch->unpack(reader);
}

template <int Dim>
void Gauges<Dim>::record(double time, double dt, const OrderedSums& sums,
                         const std::vector<PairSample>& pairs, const Totals<Dim>* totals, bool all) {
  const GaugeReading<Dim> reading{time, dt, sums, pairs, totals, units_};
  for (Gauge& g : gauges_) {
    const bool due = all || g.due.at(time);
    if (world_.rank() == 0) {
      if (g.watch->follows_every_step()) g.watch->follow(sums, dt);
      row_.clear();
      if (due || g.watch->reads_every_step()) g.watch->read(reading, row_);
      if (due) write(g, time);
    }
    if (due) g.due.done(time);
  }
  share();
}

template <int Dim>
void Gauges<Dim>::flush() {
  for (Gauge& g : gauges_) {
    if (!g.file) continue;
    if (g.over_distance) write_distances(g);
    g.file->flush();
  }
}

template <int Dim>
std::vector<TimeSeries> Gauges<Dim>::series() const {
  std::vector<TimeSeries> all;
  for (const Gauge& g : gauges_) {
    TimeSeries& s = all.emplace_back(g.series);
    if (g.over_distance) g.watch->read_all(s.values);
  }
  return all;
}

template class Gauges<1>;
template class Gauges<2>;
template class Gauges<3>;

}  // namespace recoil
