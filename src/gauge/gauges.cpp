#include "gauge/gauges.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>

#include "parallel/archive.hpp"

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
                    const std::filesystem::path& folder, ExactSums& sums)
    : world_(world), units_(run_units(c.domain.geometry)), folder_(folder) {
  const WatchSetup<Dim> setup{c, state, sums};
  for (const config::Gauge& from : c.gauges) {
    Gauge& g = gauges_.emplace_back();
    g.due = Due(every(from.kind));
    g.series.name = from.name;
    g.watch = std::visit([&](const auto& kind) { return make_watch<Dim>(kind, setup); }, from.kind);
    if (world.rank() == 0) open(g, column_list(config::written_columns(from), units_));
  }
}

template <int Dim>
void Gauges<Dim>::open(Gauge& g, std::vector<SeriesColumn> columns) {
  g.series.columns = std::move(columns);
  g.series.time = g.watch->distances();
  g.over_distance = !g.series.time.empty();
  if (g.over_distance) g.series.over = {"distance", "mm", 1e3};
  g.series.values.assign(g.series.columns.size(), std::vector<double>(g.series.time.size(), nothing));
  open_file(g);
}

template <int Dim>
void Gauges<Dim>::open_file(Gauge& g) {
  std::vector<std::string> names{g.series.over.name + " [" + g.series.over.unit + "]"};
  for (const SeriesColumn& c : g.series.columns) names.push_back(c.name + " [" + c.unit + "]");
  g.file.emplace(folder_ / (g.series.name + ".csv"), names);
}

template <int Dim>
bool Gauges<Dim>::reads_contents_around() const {
  return std::any_of(gauges_.begin(), gauges_.end(),
                     [](const Gauge& g) { return g.watch->reads_contents_around(); });
}

template <int Dim>
bool Gauges<Dim>::needs_totals(double time) const {
  for (const Gauge& g : gauges_)
    if (g.watch->needs_totals() && g.due.at(time)) return true;
  return false;
}

template <int Dim>
void Gauges<Dim>::collect(const State<Dim>& state, ExactSums& sums, bool at_rest, bool all) {
  for (Gauge& g : gauges_)
    if (all || g.watch->follows_every_step() || g.due.at(state.time))
      g.watch->collect(state, world_, at_rest, sums);
}

template <int Dim>
void Gauges<Dim>::write(Gauge& g, double time) {
  if (g.over_distance) return;
  if (!g.series.time.empty() && !(time > g.series.time.back())) return;
  g.series.time.push_back(time);
  for (std::size_t c = 0; c < row_.size(); ++c) g.series.values[c].push_back(row_[c]);
  write_row(g, g.series.time.size() - 1);
}

template <int Dim>
void Gauges<Dim>::write_row(Gauge& g, std::size_t record) {
  written_.assign(1, g.series.time[record] * 1e6);
  for (std::size_t c = 0; c < g.series.columns.size(); ++c)
    written_.push_back(g.series.values[c][record] * g.series.columns[c].to_unit + 0.0);  // no -0 in files
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
void Gauges<Dim>::record(double time, double dt, const ExactSums& sums, const std::vector<PairSample>& pairs,
                         const Totals<Dim>* totals, bool all) {
  for (Gauge& g : gauges_) {
    const bool due = all || g.due.at(time);
    if (world_.rank() == 0) {
      const GaugeReading<Dim> reading{time, dt, sums, pairs, totals, units_, g.watch->before_end() * dt};
      if (g.watch->follows_every_step()) g.watch->follow(sums, dt);
      row_.clear();
      if (due || g.watch->reads_every_step()) g.watch->read(reading, row_);
      if (due) write(g, time - reading.before);
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

template <int Dim>
void Gauges<Dim>::pack(parallel::Bytes& bytes) const {
  parallel::ArchiveWriter archive(bytes);
  archive(static_cast<std::uint64_t>(gauges_.size()));
  for (const Gauge& g : gauges_) {
    parallel::Bytes watch;
    g.watch->pack(watch);
    archive(g.series.name, static_cast<std::uint64_t>(g.series.columns.size()), g.due, watch, g.series.time,
            g.series.values);
  }
}

template <int Dim>
void Gauges<Dim>::unpack(parallel::Unpacker& from) {
  parallel::ArchiveReader archive(from);
  std::uint64_t count = 0;
  archive(count);
  for (; count > 0; --count) {
    std::string name;
    std::uint64_t columns = 0;
    Due due;
    parallel::Bytes watch;
    std::vector<double> time;
    std::vector<std::vector<double>> values;
    archive(name, columns, due, watch, time, values);
    for (Gauge& g : gauges_) {
      const bool same = g.series.name == name && (world_.rank() != 0 || g.series.columns.size() == columns);
      if (!same) continue;
      g.due.go_on(due);
      parallel::Unpacker reader(watch);
      g.watch->unpack(reader);
      if (world_.rank() != 0 || g.over_distance) continue;
      g.series.time = time;
      g.series.values = values;
      open_file(g);
      for (std::size_t k = 0; k < time.size(); ++k) write_row(g, k);
    }
  }
}

template class Gauges<1>;
template class Gauges<2>;
template class Gauges<3>;

}  // namespace recoil
