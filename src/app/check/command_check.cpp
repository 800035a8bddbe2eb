#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/check/case_picture.hpp"
#include "app/check/count_text.hpp"
#include "app/check/estimate.hpp"
#include "app/check/prediction.hpp"
#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/load_case.hpp"
#include "app/run/stepping.hpp"
#include "core/error.hpp"

namespace recoil::app {

namespace {

using Json = nlohmann::ordered_json;

/// What `check` finds out about one case.
struct Report {
  std::string file;
  LoadedCase loaded;
  std::vector<PlatePrediction> predictions;
  std::vector<TouchPrediction> touches;
  Estimate cost;
  bool good() const { return !loaded.found.has_errors(); }
};

/// The largest speed that limits a step, at the start and behind the predicted shocks.
double fastest_of(const Report& r) {
  const double sound = sound_in_step(r.loaded.contents);
  double fastest = fastest_at_start(r.loaded.contents, r.loaded.materials);
  for (const PlatePrediction& p : r.predictions)
    for (const ShockState* s : {&p.flyer_shock, &p.target_shock})
      fastest = std::max(fastest, std::abs(p.velocity) + sound * s->release_speed);
  return fastest;
}

/// The case, with all that is wrong with it. An error that leaves no case to look at is one of the file.
LoadedCase load_and_check(const std::string& file, const std::vector<std::string>& overrides) {
  LoadedCase loaded;
  try {
    loaded = load_case(file, overrides);
    if (!loaded.found.has_errors()) check_logic(loaded);
  } catch (const InputError& e) {
    loaded.found.error({file}, e);
  }
  return loaded;
}

Report look_at(const std::string& file, const std::vector<std::string>& overrides) {
  Report r;
  r.file = file;
  r.loaded = load_and_check(file, overrides);
  if (!r.good()) return r;
  const std::vector<PlatePair> pairs = find_plate_pairs(r.loaded.contents);
  for (const PlatePair& pair : pairs) {
    try {
      r.predictions.push_back(predict(pair, r.loaded.contents, r.loaded.materials));
    } catch (const PhysicsError& e) {
      r.loaded.found.warning(r.loaded.contents.bodies[pair.flyer].place,
                             fmt::format("no impact state can be predicted: {}", e.what()));
    }
  }
  r.touches = predict_touches(r.loaded.contents, r.loaded.materials, pairs);
  r.cost = estimate(r.loaded.contents, r.loaded.materials, fastest_of(r));
  return r;
}

std::string duration(double seconds) {
  if (seconds < 100) return fmt::format("{:.2g} s", seconds);
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  return seconds < 3600e4 ? fmt::format("{:.1f} h", seconds / 3600) : fmt::format("{:.2g} h", seconds / 3600);
}

/// A note on a scheme other than the default.
std::string scheme_note(const config::Case& c) {
  if (c.method.scheme == "conservative") return {};
  std::string note = fmt::format(
      "scheme\n  {}: mass, momentum and energy are not conserved at surfaces; the run reports the "
      "errors\n",
      c.method.scheme);
  if (c.method.scheme == "seed")
    note += fmt::format("  bodies touch when the gap is {:.3g} mm (kappa = {:.3g} cells)\n",
                        c.method.kappa * c.mesh.finest * 1e3, c.method.kappa);
  return note;
}

void print_report(const Report& r) {
  const config::Case& c = r.loaded.contents;
  if (!r.loaded.found.list().empty()) fmt::print(stderr, "{}", r.loaded.found.text());
  if (!r.good()) {
    const auto errors = std::ranges::count(r.loaded.found.list(), config::Diagnostic::Severity::error,
                                           &config::Diagnostic::severity);
    fmt::print("{}: {} error{}; it cannot be run\n", r.file, errors, errors == 1 ? "" : "s");
    return;
  }
  fmt::print("{}: {}\n", r.file, c.title.empty() ? "no errors found" : c.title);
  if (!r.predictions.empty() || !r.touches.empty())
    fmt::print("predicted (one-dimensional waves, no rate dependence)\n");
  for (const PlatePrediction& p : r.predictions) fmt::print("{}", describe(p, c));
  for (const TouchPrediction& p : r.touches) fmt::print("{}", describe(p, c));
  for (const std::string& why : not_predicted(c)) fmt::print("  {}\n", why);
  fmt::print("{}", scheme_note(c));
  fmt::print(
      "cost\n  {} cells, {} of them with matter; {} steps of about {:.3g} ns\n"
      "  memory {:.3g} MB, time about {} with one thread\n",
      count_text(r.cost.cells), count_text(r.cost.material_cells), count_text(r.cost.steps),
      r.cost.step * 1e9, r.cost.memory * 1e-6, duration(r.cost.seconds));
  if (c.mesh.levels > 1)
    fmt::print(
        "  {} levels: {} cells at the start, to which memory and time apply; waves and new surfaces add "
        "some\n",
        c.mesh.levels, count_text(r.cost.start_cells));
}

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(); }

Json shock_json(const ShockState& s) {
  return {{"velocity", s.velocity},
          {"stress", s.stress},
          {"pressure", s.pressure},
          {"density", s.density},
          {"temperature", s.temperature},
          {"shock_speed", s.shock_speed},
          {"precursor_speed", s.has_precursor ? Json(s.precursor_speed) : Json()},
          {"elastic_limit", s.has_precursor ? Json(s.precursor_stress) : Json()}};
}

Json prediction_json(const PlatePrediction& p, const config::Case& c) {
  constexpr const char* partings[] = {"flyer-release", "target-release", "neutral",
                                      "unknown",       "sides",          "never"};
  Json j{{"flyer", c.bodies[p.pair.flyer].name},
         {"target", c.bodies[p.pair.target].name},
         {"contact", p.contact},
         {"closing", p.pair.closing},
         {"interface_velocity", p.velocity},
         {"interface_stress", p.stress},
         {"opens", number(p.opens)},
         {"opens_is_bound", p.opens_is_bound},
         {"opens_by", partings[static_cast<int>(p.parting)]},
         {"sides", number(p.sides)}};
  if (!p.flyer_rigid) j["flyer_shock"] = shock_json(p.flyer_shock);
  if (!p.target_rigid) j["target_shock"] = shock_json(p.target_shock);
  if (p.shock_arrival > 0)
    j["rear"] = {{"precursor_arrival", p.precursor_arrival ? Json(*p.precursor_arrival) : Json()},
                 {"precursor_velocity", p.precursor_surface_velocity},
                 {"shock_arrival", p.shock_arrival},
                 {"plateau_velocity", p.plateau_surface_velocity},
                 {"plateau_is_bound", p.plateau_is_bound},
                 {"release_arrival", number(p.release_arrival)},
                 {"overtaking_depth", number(p.overtaking_depth)}};
  return j;
}

Json touch_json(const TouchPrediction& p, const config::Case& c) {
  const Approach& a = p.approach;
  return {{"bodies", {c.bodies[a.first].name, c.bodies[a.second].name}},
          {"time", a.time},
          {"closing", a.closing},
          {"sliding", a.sliding},
          {"stress", p.stress}};
}

Json report_json(const Report& r) {
  Json j{{"case", r.file}, {"good", r.good()}, {"found", Json::array()}};
  for (const config::Diagnostic& d : r.loaded.found.list())
    j["found"].push_back(
        {{"severity", d.severity == config::Diagnostic::Severity::error ? "error" : "warning"},
         {"file", d.place.file},
         {"line", d.place.line},
         {"column", d.place.column},
         {"message", d.message},
         {"help", d.help}});
  if (!r.good()) return j;
  j["predicted"] = Json::array();
  for (const PlatePrediction& p : r.predictions)
    j["predicted"].push_back(prediction_json(p, r.loaded.contents));
  j["touches"] = Json::array();
  for (const TouchPrediction& p : r.touches) j["touches"].push_back(touch_json(p, r.loaded.contents));
  j["not_predicted"] = not_predicted(r.loaded.contents);
  j["cost"] = {{"cells", r.cost.cells},
               {"material_cells", r.cost.material_cells},
               {"start_cells", r.cost.start_cells},
               {"cut_cells", r.cost.cut_cells},
               {"step", r.cost.step},
               {"steps", r.cost.steps},
               {"memory", r.cost.memory},
               {"seconds", r.cost.seconds}};
  return j;
}

}  // namespace

int check(const CheckOptions& options) {
  if (!options.png.empty() && options.files.size() > 1) throw InputError("--png draws one case at a time");
  if (options.png.empty() && !(options.view.empty() && options.up.empty() && options.cut.empty()))
    throw InputError("--view, --up and --cut say how --png draws\n   = help: add --png FILE, or omit them");
  int code = exit_finished;
  Json all = Json::array();
  for (const std::string& file : options.files) {
    const Report r = look_at(file, options.overrides);
    if (options.json)
      all.push_back(report_json(r));
    else
      print_report(r);
    if (!r.good()) code = r.loaded.too_large && code == exit_finished ? exit_environment : exit_bad_input;
    if (options.png.empty() || !r.good()) continue;
    const std::string view =
        draw_case(r.loaded.contents, {options.png, options.view, options.up, options.cut});
    if (!options.json)
      fmt::print("picture {}{}\n", options.png,
                 view.empty() ? "" : ": --view=" + view + " shows more of the bodies than the usual view");
  }
  if (options.json) fmt::print("{}\n", all.dump(2, ' ', false, Json::error_handler_t::replace));
  return code;
}

}  // namespace recoil::app
