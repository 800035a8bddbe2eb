#include "record/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <variant>

#include "config/expected_columns.hpp"
#include "config/geometry.hpp"
#include "core/error.hpp"
#include "gauge/column_list.hpp"
#include "state/body.hpp"

namespace recoil {

namespace {

template <int Dim>
void add_vector(Quantities& q, const RunUnits& units, const std::string& name, const Vec<Dim>& v,
                double scale = 1) {
  for (int d = 0; d < Dim; ++d) q.numbers[name + "." + units.axes[d]] = scale * v[d];
  if (Dim == 1) q.numbers[name] = scale * v[0];
}

template <int Dim>
void add_body(Quantities& q, const RunUnits& u, const std::string& name, const BodyTotals<Dim>& b) {
  q.numbers[name + ".mass"] = u.whole * b.mass;
  q.numbers[name + ".kinetic"] = u.whole * b.kinetic;
  q.numbers[name + ".internal"] = u.whole * b.internal();
  q.numbers[name + ".energy"] = u.whole * b.energy;
  add_vector(q, u, name + ".momentum", b.momentum, u.whole);
  for (std::size_t k = 0; k < u.turns.size(); ++k)
    q.numbers[name + ".angular-momentum." + u.turns[k]] = b.angular_momentum.c[3 - u.turns.size() + k];
}

void add_contacts(Quantities& q, const EventWatch& events) {
  for (const PairStory& s : events.stories())
    for (const std::string& pair : {s.first + "-" + s.second, s.second + "-" + s.first}) {
      const std::string name = "contact." + pair;
      q.numbers[name + ".made"] = s.made;
      q.numbers[name + ".opens"] = s.opens;
      q.numbers[name + ".separates"] = s.separates;
      q.numbers[name + ".first-lift-off"] = s.lift_first;
      q.numbers[name + ".last-lift-off"] = s.lift_last;
      q.numbers[name + ".lasts"] = s.opens - s.made;
      q.numbers[name + ".recloses"] = s.closes_again;
      q.numbers[name + ".reopens"] = s.opens_again;
      q.numbers[name + ".restitution"] = s.restitution;
      q.flags[name + ".made"] = !std::isnan(s.made);
      q.flags[name + ".opens"] = !std::isnan(s.opens);
      q.flags[name + ".separates"] = !std::isnan(s.separates);
      q.flags[name + ".recloses"] = s.recloses;
    }
  for (const char* kind :
       {"contact", "opening", "separation", "reclosure", "ricochet", "lift-off", "failure", "fragment"})
    q.flags[std::string("event.") + kind] = false;
  for (const Event& e : events.events()) q.flags["event." + e.kind] = true;
}

/// Time and place of the first failure of each body that can deform; NaN where it has not failed.
void add_failures(Quantities& q, const std::vector<std::string>& names, const std::vector<bool>& rigid,
                  const RunUnits& units, const EventWatch& events) {
  constexpr double never = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t m = 0; m < names.size(); ++m) {
    if (rigid[m]) continue;
    const auto same = [&](const Event& e) { return e.kind == "failure" && e.bodies == names[m]; };
    const auto event = std::find_if(events.events().begin(), events.events().end(), same);
    const bool failed = event != events.events().end();
    const std::string name = "failure." + names[m];
    q.numbers[name + ".time"] = failed ? event->time : never;
    for (std::size_t d = 0; d < units.axes.size(); ++d)
      q.numbers[name + "." + units.axes[d]] = failed ? event->place[d] : never;
  }
}

/// The unit that files have a number in.
std::string unit_of_number(const std::string& name, const RunUnits& u) {
  const std::size_t group = name.find('.');
  const std::string what = name.substr(std::min(name.find('.', group + 1), name.size() - 1) + 1);
  if (name.starts_with("contact.")) return what == "restitution" ? "1" : "us";
  if (name.starts_with("failure.")) return what == "time" ? "us" : "mm";
  if (name.starts_with("fragments.")) return name.ends_with("mass") ? u.mass : what == "pieces" ? "1" : "m/s";
  if (!name.starts_with("body.")) return "1";
  const std::string quantity = what.substr(0, what.find('.'));
  const std::array<std::pair<const char*, std::string>, 12> units{{{"mass", u.mass},
                                                                   {"failed-mass", u.mass},
                                                                   {"kinetic", u.energy},
                                                                   {"internal", u.energy},
                                                                   {"energy", u.energy},
                                                                   {"volume", u.volume},
                                                                   {"momentum", u.momentum},
                                                                   {"angular-momentum", u.angular_momentum},
                                                                   {"velocity", "m/s"},
                                                                   {"position", "mm"},
                                                                   {"lowest", "mm"},
                                                                   {"highest", "mm"}}};
  for (const auto& [known, unit] : units)
    if (quantity == known) return unit;
  return "1";
}

void add_units(Quantities& q, const RunUnits& units) {
  for (const auto& [name, value] : q.numbers) q.units[name] = unit_of_number(name, units);
}

/// A record of a gauge without entries.
TimeSeries empty_record(const config::Gauge& gauge, const RunUnits& units) {
  TimeSeries record;
  record.name = gauge.name;
  record.columns = column_list(config::written_columns(gauge), units);
  record.values.resize(record.columns.size());
  if (std::holds_alternative<config::PeakStressGauge>(gauge.kind)) record.over = {"distance", "mm", 1e3};
  return record;
}

template <int Dim>
Quantities known_in(const config::Case& c) {
  const RunUnits units = run_units(c.domain.geometry);
  std::vector<std::string> names;
  std::vector<bool> prescribed, rigid;
  for (const config::Body& body : c.bodies) {
    names.push_back(body.name);
    rigid.push_back(body.rigid);
    prescribed.push_back(body.rigid && !(body.mass > 0));
  }
  Totals<Dim> totals;
  totals.bodies.resize(names.size());
  std::vector<std::pair<std::string, std::int64_t>> floors{{"unstable-steps", 0}};
  Counters none;
  for (const auto& [name, count] : none.list()) floors.emplace_back(name, 0);
  Quantities q = find_quantities(totals, names, prescribed, units,
                                 BudgetWatch<Dim>(names, prescribed, units.balanced).worst(),
                                 without_events(names, c.domain.geometry), floors, 0);
  add_fragments(q, FragmentTable<Dim>(names, rigid, units).last(), units);
  for (const config::Gauge& gauge : c.gauges) q.gauges.push_back(empty_record(gauge, units));
  q.folder = std::filesystem::path(c.file).parent_path();
  return q;
}

}  // namespace

template <int Dim>
Quantities find_quantities(const Totals<Dim>& totals, const std::vector<std::string>& names,
                           const std::vector<bool>& rigid, const RunUnits& units,
                           const std::vector<Drift>& budgets, const EventWatch& events,
                           const std::vector<std::pair<std::string, std::int64_t>>& floors, long steps) {
  Quantities q;
  BodyTotals<Dim> all;
  for (std::size_t m = 0; m < names.size(); ++m) {
    if (rigid[m]) continue;
    const BodyTotals<Dim>& b = totals.bodies[m];
    const std::string name = "body." + names[m];
    add_body(q, units, name, b);
    q.numbers[name + ".volume"] = units.whole * b.volume;
    q.numbers[name + ".plastic-strain"] = b.plastic_strain;
    q.numbers[name + ".failed-mass"] = units.whole * b.failed;
    const double per_mass = b.mass > 0 ? 1 / b.mass : std::numeric_limits<double>::quiet_NaN();
    add_vector(q, units, name + ".velocity", b.momentum, per_mass);
    add_vector(q, units, name + ".position", b.place, per_mass);
    add_vector(q, units, name + ".lowest", b.lowest);
    add_vector(q, units, name + ".highest", b.highest);
    all.mass += b.mass, all.kinetic += b.kinetic, all.energy += b.energy, all.momentum += b.momentum;
    all.angular_momentum += b.angular_momentum;
  }
  add_body(q, units, "body.total", all);
  for (const Drift& d : budgets) {
    q.numbers["budget." + d.name + ".mass"] = d.mass;
    q.numbers["budget." + d.name + ".momentum"] = d.momentum;
    q.numbers["budget." + d.name + ".energy"] = d.energy;
  }
  for (const auto& [name, count] : floors) q.numbers["floor." + name] = static_cast<double>(count);
  q.numbers["run.steps"] = static_cast<double>(steps);
  add_contacts(q, events);
  add_failures(q, names, rigid, units, events);
  add_units(q, units);
  return q;
}

void add_fragments(Quantities& q, const std::vector<BodyFragments>& fragments, const RunUnits& units) {
  for (const BodyFragments& b : fragments) {
    const std::string name = "fragments." + b.body;
    q.numbers[name + ".pieces"] = b.pieces;
    q.numbers[name + ".rubble-mass"] = b.rubble;
    for (std::size_t k = 0; k < b.heaviest.size(); ++k) {
      const std::string piece = fmt::format("{}.{}", name, k + 1);
      const BodyFragments::Piece& p = b.heaviest[k];
      q.numbers[piece + ".mass"] = p.mass;
      for (std::size_t d = 0; d < p.velocity.size(); ++d)
        q.numbers[piece + ".velocity." + units.axes[d]] = p.velocity[d];
      if (p.velocity.size() == 1) q.numbers[piece + ".velocity"] = p.velocity[0];
    }
  }
  add_units(q, units);
}

EventWatch without_events(const std::vector<std::string>& names, config::Geometry geometry) {
  ContactRule rule;
  rule.hold.assign(names.size() * (names.size() - 1) / 2, 0);
  return {names, geometry, rule};
}

Quantities known_quantities(const config::Case& c) {
  switch (config::dimension(c.domain.geometry)) {
    case 1:
      return known_in<1>(c);
    case 2:
      return known_in<2>(c);
    default:
      return known_in<3>(c);
  }
}

std::vector<GaugeSummary> summarise(const std::vector<TimeSeries>& gauges) {
  std::vector<GaugeSummary> all;
  for (const TimeSeries& s : gauges) {
    if (s.over.unit != "us") continue;  // a peak and an arrival have a time
    const Curve main = curve_of(s, 0);
    const SeriesColumn& c = s.columns[0];
    all.push_back({s.name, c.name, c.unit, c.to_unit, peak_of(main), arrival_of(main)});
  }
  return all;
}

void check_known(const Quantities& quantities, const std::vector<config::Expectation>& expect,
                 config::Diagnostics& out) {
  for (const config::Expectation& e : expect) try {
      measure(quantities, e.quantity, e.is_flag);
      if (!e.is_flag) config::check_dimension(e, unit_of(quantities, e.quantity), out);
    } catch (const InputError& error) {
      out.error(e.place, error);
    }
}

void check_known(const Quantities& quantities, const std::vector<config::Expectation>& expect) {
  config::Diagnostics found;
  check_known(quantities, expect, found);
  found.throw_if_errors();
}

#define RECOIL_INSTANTIATE(Dim)                                                                 \
  template Quantities find_quantities<Dim>(const Totals<Dim>&, const std::vector<std::string>&, \
                                           const std::vector<bool>&, const RunUnits&,           \
                                           const std::vector<Drift>&, const EventWatch&,        \
                                           const std::vector<std::pair<std::string, std::int64_t>>&, long);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
