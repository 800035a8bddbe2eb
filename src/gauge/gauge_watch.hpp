#pragma once

#include <memory>
#include <string>
#include <vector>

#include "config/case.hpp"
#include "core/error.hpp"
#include "core/nothing.hpp"
#include "format/run_units.hpp"
#include "gauge/column_list.hpp"
#include "gauge/pair_sample.hpp"
#include "gauge/time_series.hpp"
#include "gauge/totals.hpp"
#include "parallel/exact_sums.hpp"
#include "parallel/world.hpp"
#include "state/body.hpp"

/// What a kind of gauge does. A kind has its declaration in config/gauge/NAME.hpp, and in
/// gauge/kind/NAME_gauge.cpp the class of its watch and a make_watch() of its own.
namespace recoil {

/// What a record is made from: on rank 0, after the reduction.
template <int Dim>
struct GaugeReading {
  double time, dt;  // s, of the end of the step and its length
  const ExactSums& sums;
  const std::vector<PairSample>& pairs;  // by pair_number()
  const Totals<Dim>* totals;             // where needs_totals(), else null
  const RunUnits& units;
  double before = 0;  // s, from the moment of the record to the end of the step
};

/// One gauge at work.
template <int Dim>
class GaugeWatch {
 public:
  virtual ~GaugeWatch() = default;

  /// Whether it is read after each step, not only when a record is due.
  virtual bool reads_every_step() const { return false; }
  /// Whether it is collected and followed at each step, not only when a record is due.
  virtual bool follows_every_step() const { return reads_every_step(); }
  /// From the moment that a record is of to the end of the step, in parts of the step: 0.5 where values are
  /// means over the step. The last record of a run is of its end all the same.
  virtual double before_end() const { return 0; }
  /// Whether a record takes the sums over whole bodies.
  virtual bool needs_totals() const { return false; }
  /// Whether it reads contents of blocks that touch its own.
  virtual bool reads_contents_around() const { return false; }
  /// Over a distance instead of over time: the distances [m] of its records, and what they are; else empty.
  virtual std::vector<double> distances() const { return {}; }

  /// Adds this rank's share. Collective.
  virtual void collect(const State<Dim>& /*state*/, const parallel::World& /*world*/, bool /*at_rest*/,
                       ExactSums& /*sums*/) {}
  /// What happens at each step, on rank 0. @param dt [s]
  virtual void follow(const ExactSums& /*sums*/, double /*dt*/) {}
  /// Appends the values of config::written_columns(), in SI; of a record over a distance nothing. On rank 0.
  virtual void read(const GaugeReading<Dim>& reading, std::vector<double>& row) = 0;
  /// The values of a record over a distance: [column][distance].
  virtual void read_all(std::vector<std::vector<double>>& /*values*/) const {}

  /// What follow() and read() have changed: all ranks need to know it, and checkpoints keep it.
  virtual void pack(parallel::Bytes& /*bytes*/) const {}
  virtual void unpack(parallel::Unpacker& /*bytes*/) {}
};

/// What a watch is made from.
template <int Dim>
struct WatchSetup {
  const config::Case& contents;
  const State<Dim>& state;
  ExactSums& sums;  // in which it declares its own
};

/// Makes the watch of one kind: a specialisation for each, in gauge/kind/NAME_gauge.cpp.
template <int Dim, class Kind>
std::unique_ptr<GaugeWatch<Dim>> make_watch(const Kind& kind, const WatchSetup<Dim>& setup);

/// The place of a body in a state. @throws InternalError where there is none of that name.
template <int Dim>
int body_number(const State<Dim>& state, const std::string& name) {
  for (int m = 0; m < state.count(); ++m)
    if (state.bodies[m].name == name) return m;
  throw InternalError("internal error: a gauge of a body that does not exist: " + name);
}

/// The first components of a case's vector.
using config::first_components;

template <int Dim>
void append(std::vector<double>& row, const Vec<Dim>& v) {
  row.insert(row.end(), v.c.begin(), v.c.end());
}

/// Defines make_watch() of a kind in all dimensions. Watch<Dim> has a constructor (const Kind&, const
/// WatchSetup<Dim>&).
// NOLINTBEGIN(bugprone-macro-parentheses): types and template arguments cannot stand in parentheses
#define RECOIL_WATCH_IN(Dim, Kind, Watch)                                                            \
  template <>                                                                                        \
  std::unique_ptr<GaugeWatch<Dim>> make_watch<Dim>(const Kind& kind, const WatchSetup<Dim>& setup) { \
    return std::make_unique<Watch<Dim>>(kind, setup);                                                \
  }
#define RECOIL_WATCH(Kind, Watch) \
  RECOIL_WATCH_IN(1, Kind, Watch) \
  RECOIL_WATCH_IN(2, Kind, Watch) \
  RECOIL_WATCH_IN(3, Kind, Watch)
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace recoil
