#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "config/case.hpp"
#include "format/csv.hpp"
#include "format/run_units.hpp"
#include "gauge/due.hpp"
#include "gauge/gauge_watch.hpp"
#include "gauge/pair_sample.hpp"
#include "gauge/time_series.hpp"
#include "gauge/totals.hpp"

namespace recoil {

/// All gauges of a case: gauges/NAME.csv, and the same in memory. What there is of them is listed in
/// config/gauge/gauge.hpp, what they record in the declarations there.
template <int Dim>
class Gauges {
 public:
  /// Declares what they sum; rank 0 opens the files. @throws EnvironmentError.
  Gauges(const config::Case& case_, const State<Dim>& state, const parallel::World& world,
         const std::filesystem::path& folder, ExactSums& sums);

  /// Whether a gauge reads contents of blocks that touch its own.
  bool reads_contents_around() const;
  /// Whether a gauge needs the sums over whole bodies at this time. The same on all ranks.
  bool needs_totals(double time) const;
  /// Adds this rank's share of all that is due. Collective.
  /// @param all also what is not due, as the last record() needs.
  void collect(const State<Dim>& state, ExactSums& sums, bool at_rest, bool all = false);
  /// Records what is due, on rank 0, after the reduction; then moves the points, on all ranks. Collective.
  /// @param totals of this time where needs_totals(), else null. @param all record also what is not due.
  void record(double time, double dt, const ExactSums& sums, const std::vector<PairSample>& pairs,
              const Totals<Dim>* totals, bool all = false);
  /// Hands what is written to the system.
  void flush();
  /// On rank 0.
  std::vector<TimeSeries> series() const;

  /// For checkpoints: all records so far, and what the next ones depend on. On rank 0.
  void pack(parallel::Bytes& bytes) const;
  /// The same back, on all ranks; rank 0 writes the files anew. Gauges that the case no longer has are left
  /// out, new ones begin now.
  void unpack(parallel::Unpacker& from);

 private:
  struct Gauge {
    Due due;
    std::unique_ptr<GaugeWatch<Dim>> watch;
    TimeSeries series;
    bool over_distance = false;  // instead of over time
    std::optional<CsvWriter> file;
  };
  void open(Gauge& g, std::vector<SeriesColumn> columns);
  void open_file(Gauge& g);
  void write_row(Gauge& g, std::size_t record);
  void write(Gauge& g, double time);
  void write_distances(Gauge& g);
  void share();

  const parallel::World& world_;
  RunUnits units_;
  std::filesystem::path folder_;
  std::vector<Gauge> gauges_;
  std::vector<double> row_, written_;
};

}  // namespace recoil
