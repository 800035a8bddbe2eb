#include "app/report/comparisons.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "app/check/prediction.hpp"
#include "config/units.hpp"
#include "core/error.hpp"
#include "format/csv.hpp"
#include "record/quantities.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

/// Points of a curve over time, in us and the unit of its column.
struct Points {
  std::vector<double> t, y;
  void add(double time_s, double value) {
    t.push_back(time_s * 1e6);
    y.push_back(value);
  }
};

Json curve_json(const std::string& kind, const std::string& label, const std::string& column,
                const std::vector<double>& x, const std::vector<double>& y) {
  Json j = {{"kind", kind}, {"label", label}, {"column", column}, {"x", Json::array()}, {"y", Json::array()}};
  for (const double v : x) j["x"].push_back(number(v));
  for (const double v : y) j["y"].push_back(number(v));
  return j;
}

/// A column of a reference in the unit of the gauge's own.
std::vector<double> in_unit_of(const CsvTable& gauge, const std::string& own, const CsvTable& reference,
                               const std::string& column) {
  std::vector<double> values = reference.numbers(column);
  const std::string to = gauge.unit(own), from = reference.unit(column);
  if (to != from && !to.empty() && !from.empty())
    for (double& v : values) v *= config::unit_size(from) / config::unit_size(to);
  return values;
}

/// What a table says of itself: its first lines of comment up to an empty one, as far as they are short.
std::string note_of(const std::vector<std::string>& comments) {
  constexpr std::size_t longest = 400;
  std::string note;
  for (const std::string& line : comments) {
    if (line.empty() || (!note.empty() && note.size() + line.size() > longest)) break;
    note += (note.empty() ? "" : " ") + line;
  }
  return note;
}

void add_references(Json& all, const config::Gauge& gauge, const LoadedCase& loaded, const fs::path& run) {
  const CsvTable table = read_csv(run / "gauges" / (gauge.name + ".csv"));
  std::set<std::string> seen;
  for (const config::Expectation& e : loaded.contents.expect) {
    const auto named = reference_curve_of(e.quantity);
    if (!named || named->gauge != gauge.name || !fs::exists(run / named->file)) continue;
    if (!seen.insert(named->column + " " + named->file.string()).second) continue;
    const CsvTable reference = read_csv(run / named->file);
    const std::string over = table.columns.front(), column = table.columns[table.index(named->column)];
    all.push_back(curve_json("reference", named->file.string(), named->column,
                             in_unit_of(table, over, reference, reference.columns.front()),
                             in_unit_of(table, column, reference, named->file_column)));
    if (const std::string note = note_of(reference.comments); !note.empty()) all.back()["note"] = note;
  }
}

/// Velocity of a point of the target's rear face, along its outward normal, as far as waves tell it.
Points rear_velocity(const PlatePrediction& p, double before, double end) {
  Points points;
  points.add(0, before);
  const double last = std::min({p.sides, p.release_arrival, end});
  const auto rise = [&](double time, double from, double to) {
    if (time > last) return;
    points.add(time, before + from);
    points.add(time, before + to);
  };
  const double precursor = p.precursor_arrival ? p.precursor_surface_velocity : 0;
  if (p.precursor_arrival) rise(*p.precursor_arrival, 0, precursor);
  rise(p.shock_arrival, precursor, p.plateau_surface_velocity);
  points.add(last, points.y.back());
  return points;
}

/// Mean traction of the contact, negative in compression [GPa].
Points traction(const PlatePrediction& p, double end) {
  Points points;
  const double opens = std::min({p.opens, p.sides, end}), stress = -p.stress * 1e-9;
  if (p.contact > 0) points.add(0, 0);
  if (p.contact > 0) points.add(p.contact, 0);
  points.add(p.contact, stress);
  points.add(opens, stress);
  if (opens == p.opens) points.add(opens, 0);
  return points;
}

/// Whether a gauge lies on the face of the target that the wave reaches last.
bool on_rear_face(const config::SurfaceVelocityGauge& g, const PlatePrediction& p, const config::Case& c) {
  const config::Body& target = c.bodies[static_cast<std::size_t>(p.pair.target)];
  if (g.body != target.name || !(p.shock_arrival > 0)) return false;
  const auto axis = static_cast<std::size_t>(p.pair.axis);
  const config::Extent extent = extent_of(target.shape, c.domain.geometry);
  const double face = p.pair.direction > 0 ? extent.hi[axis] : extent.lo[axis];
  return std::abs(g.at[axis] - face) < c.mesh.finest;
}

bool is_pair(const config::ContactGauge& g, const PlatePrediction& p, const config::Case& c) {
  const std::string &flyer = c.bodies[static_cast<std::size_t>(p.pair.flyer)].name,
                    &target = c.bodies[static_cast<std::size_t>(p.pair.target)].name;
  return (g.pair[0] == flyer && g.pair[1] == target) || (g.pair[0] == target && g.pair[1] == flyer);
}

void add_prediction(Json& all, const config::Gauge& gauge, const PlatePrediction& p, const config::Case& c) {
  if (const auto* surface = std::get_if<config::SurfaceVelocityGauge>(&gauge.kind);
      surface && on_rear_face(*surface, p, c)) {
    const config::Vector& velocity = c.bodies[static_cast<std::size_t>(p.pair.target)].velocity;
    const double before = p.pair.direction * velocity[static_cast<std::size_t>(p.pair.axis)];
    const Points points = rear_velocity(p, before, c.time.end);
    all.push_back(curve_json("prediction", p.plateau_is_bound ? "1-D waves, at most" : "1-D waves",
                             "velocity", points.t, points.y));
  }
  if (const auto* contact = std::get_if<config::ContactGauge>(&gauge.kind);
      contact && is_pair(*contact, p, c)) {
    const Points points = traction(p, c.time.end);
    all.push_back(curve_json("prediction", "1-D waves", "traction", points.t, points.y));
  }
}

}  // namespace

Json comparisons(const config::Gauge& gauge, const LoadedCase& loaded, const fs::path& run) {
  Json all = Json::array();
  add_references(all, gauge, loaded, run);
  try {
    for (const PlatePair& pair : find_plate_pairs(loaded.contents))
      add_prediction(all, gauge, predict(pair, loaded.contents, loaded.materials), loaded.contents);
  } catch (const PhysicsError&) {
    return all;  // no shock state: nothing is predicted, as the page says in words
  }
  return all;
}

}  // namespace recoil::app
