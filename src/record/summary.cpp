#include "record/summary.hpp"

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "config/units.hpp"
#include "format/json_files.hpp"

namespace recoil {

namespace {

using Json = nlohmann::ordered_json;

/// JSON has no NaN: what did not happen is null.
Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json budgets_json(const std::vector<Drift>& budgets) {
  Json all = Json::object();
  for (const Drift& d : budgets)
    all[d.name] = {{"mass", number(d.mass)}, {"momentum", number(d.momentum)}, {"energy", number(d.energy)}};
  return all;
}

Json centres_json(const std::vector<CentreOff>& centres) {
  Json all = Json::object();
  for (const CentreOff& c : centres)
    all[c.name] = {
        {"off_mm", number(c.off * 1e3)}, {"way_mm", number(c.way * 1e3)}, {"time_us", number(c.time * 1e6)}};
  return all;
}

Json turning_json(const Summary& s) {
  Json all = Json::object();
  for (const Turning& t : s.turning) {
    Json& one = all[t.name];
    for (std::size_t k = 0; k < s.turns.size(); ++k) {
      const std::size_t c = 3 - s.turns.size() + k;  // planar: the third
      one[s.turns[k]] = {{"now", number(t.now.c[c])}, {"unbalanced", number(t.unbalanced.c[c])}};
    }
    one["unit"] = s.turning_unit;
  }
  return all;
}

Json gauges_json(const std::vector<GaugeSummary>& gauges) {
  Json all = Json::object();
  for (const GaugeSummary& g : gauges)
    all[g.name] = {{"column", g.column},
                   {"unit", g.unit},
                   {"peak", number(g.peak.value * g.to_unit)},
                   {"time_of_peak_us", number(g.peak.time * 1e6)},
                   {"arrival_us", number(g.arrival * 1e6)}};
  return all;
}

Json fragments_json(const std::vector<BodyFragments>& bodies) {
  Json all = Json::object();
  for (const BodyFragments& b : bodies) all[b.body] = {{"pieces", b.pieces}, {"heaps_of_rubble", b.heaps}};
  return all;
}

Json events_json(const std::vector<Event>& events) {
  Json all = Json::array();
  for (const Event& e : events) {
    Json place = Json::array();
    for (const double x : e.place) place.push_back(number(x * 1e3));
    all.push_back({{"time_us", number(e.time * 1e6)},
                   {"event", e.kind},
                   {"bodies", e.bodies},
                   {"place_mm", std::move(place)},
                   {"detail", e.detail}});
  }
  return all;
}

Json reasons_json(const std::vector<Reason>& reasons) {
  Json all = Json::array();
  for (const Reason& r : reasons) {
    Json place = Json::array();
    for (const double x : r.place) place.push_back(number(x * 1e3));
    all.push_back({{"what", r.what},
                   {"body", r.body},
                   {"text", r.text},
                   {"value", number(r.value)},
                   {"limit", number(r.limit)},
                   {"first_us", number(r.first * 1e6)},
                   {"last_us", number(r.last * 1e6)},
                   {"place_mm", std::move(place)}});
  }
  return all;
}

Json check_json(const CheckResult& r) {
  const config::Expectation& e = r.expected;
  Json j;
  if (e.is_flag) {
    j["value"] = r.measured.problem.empty() ? Json(r.measured.flag) : Json(nullptr);
    j["reference"] = e.flag;
  } else {
    const auto shown = [&](double si) { return number(e.unit.empty() ? si : config::in_unit(si, e.unit)); };
    j["value"] = shown(r.measured.value);
    j["reference"] = shown(e.value);
    if (e.at_most || e.at_least)
      j["kind"] = e.at_most ? "at-most" : "at-least";
    else  // a difference: no shift of the zero
      j["tolerance"] = number(e.unit.empty() ? e.tolerance : e.tolerance / config::unit_size(e.unit));
    j["unit"] = e.unit.empty() ? "1" : e.unit;
  }
  j["pass"] = r.pass;
  if (!r.measured.problem.empty()) j["problem"] = r.measured.problem;
  if (!e.source.empty()) j["source"] = e.source;
  if (!e.why.empty()) j["why"] = e.why;
  return j;
}

}  // namespace

void write_summary(const std::filesystem::path& path, const Summary& s) {
  Json j;
  j["version"] = s.version;
  j["case"] = s.case_name;
  j["exit"] = s.exit;
  j["verdict"] = name_of(s.verdict.kind);
  j["reasons"] = reasons_json(s.verdict.reasons);
  j["cures"] = s.verdict.cures;
  j["not_judged"] = s.verdict.notes;
  j["remarks"] = s.verdict.remarks;
  j["time_us"] = number(s.time * 1e6);
  j["steps"] = s.steps;
  j["cells"] = s.cells;
  j["cell_steps"] = static_cast<std::int64_t>(s.cell_steps);
  j["wall_s"] = number(s.wall_s);
  j["cpu_s"] = number(s.cpu_s);
  j["rate_mcell_stage_per_s"] = number(s.rate);
  j["budgets"] = budgets_json(s.budgets);
  j["centre_of_mass"] = centres_json(s.centres);
  if (!s.turns.empty()) j["angular_momentum"] = turning_json(s);
  j["gauges"] = gauges_json(s.gauges);
  j["events"] = events_json(s.events);
  j["fragments"] = fragments_json(s.fragments);
  Json floors = Json::object();
  for (const auto& [name, count] : s.floors) floors[name] = count;
  j["floors"] = std::move(floors);
  Json checks = Json::object();
  for (const CheckResult& r : s.expect) checks[r.expected.quantity] = check_json(r);
  j["expect"] = std::move(checks);
  write_atomically(path, j.dump(2) + "\n");
}

void write_status(const std::filesystem::path& path, const Status& s) {
  Json j;
  j["state"] = s.state;
  j["time_us"] = number(s.time * 1e6);
  j["end_us"] = number(s.end * 1e6);
  j["step"] = s.steps;
  j["dt_ns"] = number(s.dt * 1e9);
  j["wall_s"] = number(s.wall_s);
  j["left_s"] = number(s.left_s);
  j["budgets"] = budgets_json(s.budgets);
  write_atomically(path, j.dump(2) + "\n");
}

}  // namespace recoil
