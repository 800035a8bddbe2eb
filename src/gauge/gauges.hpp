#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "config/case.hpp"
#include "format/csv.hpp"
#include "format/run_units.hpp"
#include "gauge/attitude.hpp"
#include "gauge/bar_shape.hpp"
#include "gauge/due.hpp"
#include "gauge/pair_sample.hpp"
#include "gauge/probes.hpp"
#include "gauge/stress_line.hpp"
#include "gauge/time_series.hpp"
#include "gauge/totals.hpp"

namespace recoil {

/// All gauges of a case: gauges/NAME.csv, and the same in memory. Columns, after `time [us]`, by kind (AXIS:
/// x, or r and z, ...):
///   surface-velocity  velocity (along the outward normal), velocity.AXIS, position.AXIS of the point, which
///   moves
///                     with the surface along its normal
///   point             pressure, velocity.AXIS, stress.COMPONENT, density, von-mises, plastic-strain,
///   temperature: of the body in the
///                     cell that holds the point, NaN where it is not there
///   body              velocity.AXIS (mean by mass), position.AXIS (centre of mass), lowest.AXIS and
///   highest.AXIS (its extent), mass,
///                     kinetic, internal, plastic-strain (largest)
///   contact           traction (mean over the area in contact, positive in tension; 0 when apart), velocity
///   (of the work, along the
///                     normal out of the first body), area, gap (mean), widest-gap, deepest-overlap,
///                     force.AXIS and impulse.AXIS on the first named body, work done on it; normal-force and
///                     tangential-force (their sizes, normal and tangent to the surface cell by cell), the
///                     time integrals of these, normal-impulse and tangential-impulse, and friction, the
///                     second over the first; traction-scatter, the root mean square over the area of the
///                     traction's departure from its mean; with a direction force.along and impulse.along it.
///                     With a radius only cells within it count. Force and work are then integrated over time
///                     from the last stage of each step, which stands in its middle; without, impulse and
///                     work are what was exchanged, to the last bit.
///   bar               length, foot-radius, radius, volume-radius, contact-radius, lift-off, plastic-strain,
///                     axis-plastic-strain, rim-lift-off: see BarReading
///   attitude          inclination, inclination.front-half, inclination.front-third, course, speed,
///                     head.x, head.y, spin: see
///                     Attitude
///   peak-stress       not over time but over the distance from its begin: stress (largest compressive), time
///                     (of it), of points that ride with the matter; the file is written anew at each flush
template <int Dim>
class Gauges {
 public:
  /// Declares what they sum; rank 0 opens the files. @throws EnvironmentError.
  Gauges(const config::Case& case_, const State<Dim>& state, const parallel::World& world,
         const std::filesystem::path& folder, OrderedSums& sums);

  /// Whether a gauge needs the sums over whole bodies at this time. The same on all ranks.
  bool needs_totals(double time) const;
  /// Adds this rank's share of all that is due. Collective.
  /// @param all also what is not due, as the last record() needs.
  void collect(const State<Dim>& state, OrderedSums& sums, bool at_rest, bool all = false);
  /// Records what is due, on rank 0, after the reduction; then moves the points, on all ranks. Collective.
  /// @param totals of this time where needs_totals(), else null. @param all record also what is not due.
  void record(double time, double dt, const OrderedSums& sums, const std::vector<PairSample>& pairs,
              const Totals<Dim>* totals, bool all = false);
  /// Hands what is written to the system.
  void flush();
  /// On rank 0.
  std::vector<TimeSeries> series() const;

 private:
  struct Gauge {
    config::Gauge::Kind kind;
    Due due;
    int item = -1;  // of OrderedSums, or -1
    int body = 0;   // or the first of the pair
    int pair = 0;
    bool turned = false;  // the pair is named the other way round
    double outward = 1;   // -1: the contact's normal points out of the second named body
    SurfacePoint<Dim> point;
    TimeSeries series;
    std::optional<CsvWriter> file;
    double radius = 0;          // of the part of a contact that counts; 0: all
    Vec<Dim> direction;         // or zero
    PairSample part;            // of that part, when it is not all
    double normal_impulse = 0;  // since the start
    double tangential_impulse = 0;
    BarWatch bar{};
    AttitudeFrame frame{};
    StressLine<Dim> line{};
  };
  static bool every_step(const Gauge& g) {
    return g.kind == config::Gauge::Kind::surface_velocity || g.kind == config::Gauge::Kind::peak_stress;
  }
  void declare(Gauge& g, const config::Gauge& from, const std::vector<config::Body>& bodies,
               const State<Dim>& state, OrderedSums& sums);
  void open(Gauge& g, const std::filesystem::path& folder);
  /// What needs every step: follows the contact on rank 0.
  void follow_contact(Gauge& g, double dt, const OrderedSums& sums);
  double along(const Gauge& g, const std::array<double, 3>& v) const;
  void read(Gauge& g, double time, double dt, const OrderedSums& sums, const std::vector<PairSample>& pairs,
            const Totals<Dim>* totals);
  void read_surface_velocity(Gauge& g, double dt, const OrderedSums& sums);
  void read_body(const BodyTotals<Dim>& body);
  void read_contact(const Gauge& g, const PairSample& pair, const OrderedSums& sums);
  void read_shape(Gauge& g, const OrderedSums& sums);
  void write_line(Gauge& g);
  void write(Gauge& g, double time);
  void share_points();

  const parallel::World& world_;
  RunUnits units_;
  Grid<Dim> grid_;
  double dx_;
  std::filesystem::path folder_;
  std::vector<Gauge> gauges_;
  std::vector<double> row_, written_;
};

}  // namespace recoil
