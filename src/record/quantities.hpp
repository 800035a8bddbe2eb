#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "config/case.hpp"
#include "gauge/time_series.hpp"

namespace recoil {

/// What a run found out, by the names that expectations use. All in SI.
///   numbers  contact.A-B.opens, contact.A-B.made [s]; body.NAME.mass, body.NAME.velocity.x, ...;
///   budget.NAME.mass|momentum|energy flags    contact.A-B.recloses, contact.A-B.opens; event.ricochet, ...
///   gauges   gauge.NAME.COLUMN followed by one of
///              @3.8us             the value then, linear between records; also .at@3.8us
///              .peak              the value of the largest magnitude, with its sign
///              .last              the last value
///              .pullback          the fall from the largest value to the first minimum behind it
///              .max, .min         the largest and the smallest value; also over a time: .max@0.2us..0.5us
///              .mean@0.2us..0.5us the mean over that time
///              .rms@0.2us..0.5us  the root of the mean squared deviation from that mean
///              .slope@0.2us..0.5us  that of the straight line that fits best over that time
///              .until@100m/s      the last time at which the column crosses that level
///              .arrival@100m/s    the first time at which the column reaches that level, in its direction
///              from the first value .error@3us..5us:FILE:COLUMN  the mean of |column - reference| over that
///              time; FILE is a CSV table beside the case
struct Quantities {
  std::map<std::string, double> numbers;
  std::map<std::string, bool> flags;
  std::map<std::string, std::string> units;  ///< of `numbers`, in which files have them: "us", "kg/m2", "1"
  std::vector<TimeSeries> gauges;
  std::filesystem::path folder;  ///< of the case, where reference curves lie
};

/// A quantity's value. Where there is none (`contact.A-B.opens` of a pair that stayed together), `value` is
/// NaN.
struct Measured {
  double value = 0;
  bool is_flag = false, flag = false;
  std::string problem;  ///< why there is no value, in words; empty: there is one
};

/// Looks a quantity up. Pairs may be named in either order.
/// @throws InputError for a name that this run does not have (with the nearest ones) or a reference that
/// cannot be read.
Measured measure(const Quantities& quantities, const std::string& name, bool as_flag = false);

/// The unit in which a quantity is shown: "us", "GPa"; "1" of a plain number or a flag.
std::string unit_of(const Quantities& quantities, const std::string& name);

/// The record that a quantity gauge.NAME.COLUMN... is read from, and the curve that
/// gauge.NAME.COLUMN.error@FROM..TO:FILE:COLUMN compares it with.
struct ReferenceCurve {
  std::string gauge, column;
  std::filesystem::path file;  ///< as named: beside the case; empty: none
  std::string file_column;
};

/// Nothing for a quantity of no gauge. @throws InputError for one that does not say which value of the
/// record.
std::optional<ReferenceCurve> record_of(const std::string& quantity);

/// Nothing for a quantity that names no curve.
std::optional<ReferenceCurve> reference_curve_of(const std::string& quantity);

/// One expectation and what came out.
struct CheckResult {
  config::Expectation expected;
  Measured measured;
  bool pass = false;
};

/// Checks one expectation; a quantity that cannot be found is a failure with its reason in
/// `measured.problem`.
CheckResult check(const Quantities& quantities, const config::Expectation& expected);

}  // namespace recoil
