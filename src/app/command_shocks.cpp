#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/commands.hpp"
#include "app/named_material.hpp"
#include "app/plot/plot_file.hpp"
#include "core/error.hpp"
#include "material/detonation.hpp"
#include "material/hugoniot.hpp"
#include "picture/line_chart.hpp"

namespace recoil::app {

namespace {

constexpr double usual_velocity = 3000;  // m/s, where the user does not say how far
constexpr int rows = 12, points = 120;   // of the table, of a curve

/// The velocity that a table or picture ends at. @throws InputError beyond what the material reaches.
double last_velocity(const Material& m, const std::string& wanted) {
  const double most = largest_velocity(m) * (1 - 1e-6);
  if (wanted.empty()) return std::min(usual_velocity, most);
  const double to = quantity_option(wanted, "m/s", "--to");
  if (!(to > 0)) throw InputError(fmt::format("--to must be above 0, not {}", wanted));
  if (to > most)
    throw InputError(
        fmt::format("the equation of state of {} reaches {:.4g} m/s, --to is {}", m.name, most, wanted));
  return to;
}

void print_header(const Material& m) {
  fmt::print("{}: {}\n", m.name, m.title);
  if (!m.doubt.empty()) fmt::print("  in doubt: {}\n", m.doubt);
  fmt::print("  at rest: {:.5g} kg/m3, bulk sound speed {:.5g} m/s, longitudinal {:.5g} m/s\n", density(m),
             bulk_sound_speed(m), longitudinal_speed(m));
}

void print_elastic_limit(const ShockState& s) {
  if (s.has_precursor)
    fmt::print("  elastic limit {:.4g} GPa at {:.4g} m/s, precursor {:.5g} m/s\n", s.precursor_stress * 1e-9,
               s.precursor_velocity, s.precursor_speed);
}

void print_detonation(const Jwl& products) {
  const ChapmanJouguet s = chapman_jouguet(products);
  fmt::print("  detonation: {:.5g} m/s (measured {:.5g}), {:.4g} GPa, products {:.4g} m/s\n", s.velocity,
             products.detonation_velocity, s.pressure * 1e-9, s.particle);
}

/// The shock in [0, to] from which on more than `part` is molten; none where less is.
std::optional<ShockState> melting_shock(const Material& m, double to, double part) {
  const auto melts = [&](double u) { return shock_at_velocity(m, u).molten > part; };
  if (!melts(to)) return std::nullopt;
  double solid = 0, molten = to;
  while (molten - solid > 1e-4 * to) {
    const double middle = 0.5 * (solid + molten);
    (melts(middle) ? molten : solid) = middle;
  }
  return shock_at_velocity(m, molten);
}

/// @param to the largest velocity that is looked at [m/s].
void print_melting(const Material& m, double to) {
  if (!temperature_law(m).melts()) return;
  const auto begins = melting_shock(m, to, 0), ends = melting_shock(m, to, 1 - 1e-9);
  const auto at = [](const char* what, const ShockState& s) {
    fmt::print("  {} at {:.4g} m/s: {:.4g} GPa, {:.4g} K\n", what, s.velocity, s.stress * 1e-9,
               s.temperature);
  };
  if (!begins) return fmt::print("  not molten by shocks up to {:.4g} m/s\n", to);
  at("begins to melt", *begins);
  if (ends) at("all of it molten", *ends);
}

/// Stress over velocity of a material that starts at `from` and is pushed along `way`, 1 or -1.
Series curve(const Material& m, double to, double from, double way) {
  Series series;
  series.label = m.name;
  for (int k = 0; k <= points; ++k) {
    const double u = to * k / points;
    series.x.push_back(from + way * u);
    series.y.push_back(shock_at_velocity(m, u).stress * 1e-9);
  }
  return series;
}

int save(LineChart chart, const std::string& file) {
  chart.x_title = "velocity of the matter [m/s]";
  chart.y_title = "stress [GPa]";
  PlotOptions options;
  options.file = file;
  return save_picture(options, line_chart(chart), "");
}

void print_state(const char* part, const Material& m, const ShockState& s) {
  fmt::print("  {:<7} {:<28} shock {:.5g} m/s, {:.5g} kg/m3, pressure {:.4g} GPa, {:.4g} K\n", part, m.name,
             s.shock_speed, s.density, s.pressure * 1e-9, s.temperature);
  if (s.has_precursor)
    fmt::print("  {:<36} precursor {:.5g} m/s, elastic limit {:.4g} GPa\n", "", s.precursor_speed,
               s.precursor_stress * 1e-9);
}

}  // namespace

int print_hugoniot(const HugoniotOptions& o) {
  const Material m = named_material(o.name);
  const double to = last_velocity(m, o.to);
  print_header(m);
  if (const auto* products = std::get_if<Jwl>(&m.eos)) print_detonation(*products);
  print_elastic_limit(shock_at_velocity(m, 0.05 * to));
  print_melting(m, to);
  const bool melts = temperature_law(m).melts();
  fmt::print("\n{:>10} {:>10} {:>10} {:>10} {:>10} {:>9}{}\n", "velocity", "shock", "stress", "pressure",
             "density", "temp.", melts ? "   molten" : "");
  fmt::print("{:>10} {:>10} {:>10} {:>10} {:>10} {:>9}\n", "m/s", "m/s", "GPa", "GPa", "kg/m3", "K");
  for (int k = 1; k <= rows; ++k) {
    const ShockState s = shock_at_velocity(m, to * k / rows);
    fmt::print("{:10.5g} {:10.5g} {:10.5g} {:10.5g} {:10.5g} {:9.4g}{}\n", s.velocity, s.shock_speed,
               s.stress * 1e-9, s.pressure * 1e-9, s.density, s.temperature,
               melts ? fmt::format(" {:8.3g}", s.molten) : "");
  }
  if (o.file.empty()) return 0;
  LineChart chart;
  chart.title = m.title;
  chart.series = {curve(m, to, 0, 1)};
  return save(std::move(chart), o.file);
}

namespace {

/// @throws InputError beyond what the equations of state reach: the speed is what the user can change.
Impact impact_at(const Material& flyer, const Material& target, double speed) {
  try {
    return match_impact(flyer, target, speed);
  } catch (const PhysicsError&) {
    throw InputError(
        fmt::format("no shock state at {:.4g} m/s\n   = help: the equation of state of {} ends at a velocity "
                    "of the matter "
                    "of {:.4g} m/s, that of {} at {:.4g} m/s: lower --speed; is its unit right?",
                    speed, flyer.name, largest_velocity(flyer), target.name, largest_velocity(target)));
  }
}

}  // namespace

int match_materials(const MatchOptions& o) {
  const Material flyer = named_material(o.flyer), target = named_material(o.target);
  const double speed = quantity_option(o.speed, "m/s", "--speed");
  if (!(speed > 0)) throw InputError(fmt::format("--speed must be above 0, not {}", o.speed));
  const Impact impact = impact_at(flyer, target, speed);
  fmt::print("{} at {:.6g} m/s on {} at rest\n", flyer.name, speed, target.name);
  fmt::print("  interface {:.5g} m/s, {:.4g} GPa\n", impact.velocity, impact.stress * 1e-9);
  print_state("flyer", flyer, impact.flyer);
  print_state("target", target, impact.target);
  fmt::print("  when the release from the flyer's free rear comes back the plates {}\n",
             flyer_leaves(impact, flyer, target) ? "part" : "stay together");
  if (o.file.empty()) return 0;
  const double most = 1.3 * speed;
  LineChart chart;
  chart.title = fmt::format("{} at {:.6g} m/s on {}", flyer.name, speed, target.name);
  const auto reach = [&](const Material& m) { return std::min(most, largest_velocity(m) * (1 - 1e-6)); };
  chart.series = {curve(target, reach(target), 0, 1), curve(flyer, reach(flyer), speed, -1)};
  chart.series[0].label = "target: " + target.name;
  chart.series[1].label = "flyer: " + flyer.name;
  chart.guides = {{impact.velocity, fmt::format("{:.5g} m/s", impact.velocity), true},
                  {impact.stress * 1e-9, fmt::format("{:.4g} GPa", impact.stress * 1e-9), false}};
  chart.x_range = {0.0, speed};
  chart.y_range = {0.0, 2 * impact.stress * 1e-9};
  return save(std::move(chart), o.file);
}

}  // namespace recoil::app
