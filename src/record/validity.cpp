#include "record/validity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/nothing.hpp"

namespace recoil {

namespace {

/// A counter that replaces or drops something, its limit, and what it did. `averaged-states` is judged body
/// by body.
struct CounterLimit {
  const char* name;
  double config::Limits::*limit;
  const char* text;
};
using L = config::Limits;
constexpr std::array counter_limits{
    CounterLimit{"first-order-faces", &L::first_order_faces, "faces took the state of their cell"},
    CounterLimit{"faces-without-value", &L::faces_without_value, "faces lacked a value"},
    CounterLimit{"faces-at-open-edges", &L::faces_at_open_edges, "faces at open edges lacked a value"},
    CounterLimit{"cuts-without-donor", &L::cuts_without_donor, "cut cells had no fit"},
    CounterLimit{"ghosts-without-wall", &L::ghosts_without_wall, "cells beyond a surface had no wall"},
    CounterLimit{"averages-kept", &L::averages_kept, "averages of the start of the step were kept"},
    CounterLimit{"fragments-too-thin", &L::fragments_too_thin, "fragments were too thin to be used"},
    CounterLimit{"real-cells-without-contents", &L::real_cells_without_contents,
                 "cells inside a body held nothing of it"},
    CounterLimit{"uncovered-cells-without-value", &L::uncovered_cells_without_value,
                 "uncovered cells had no value"},
    CounterLimit{"clamped-fit-densities", &L::clamped_fit_densities, "densities at surfaces were clamped"},
    CounterLimit{"clamped-ghost-densities", &L::clamped_ghost_densities, "densities of ghosts were clamped"},
    CounterLimit{"unmerged-fragments", &L::unmerged_fragments, "small fragments had no partner"},
    CounterLimit{"lone-fragments-moved", &L::lone_fragments_moved,
                 "lone fragments were moved to the nearest large one"},
    CounterLimit{"capped-speeds", &L::capped_speeds, "speeds of surfaces were capped"},
    CounterLimit{"volume-bounds", &L::volume_bounds, "volumes of cut cells passed their bounds"},
    CounterLimit{"volume-bounds-left", &L::volume_bounds_left, "volumes stayed beyond their bounds"},
    CounterLimit{"floored-sound-speeds", &L::floored_sound_speeds, "speeds of sound were floored"},
    CounterLimit{"cleared-strains", &L::cleared_strains,
                 "negative plastic strains or heatings were set to zero"}};

/// What a finding about states is called, how a value of it is written, and what limits it.
enum class PartOf : std::uint8_t { states, matter, energy };
struct StateText {
  const char *name, *text, *unit;
  double factor;
  double config::Limits::*limit;
  PartOf of = PartOf::states;  // what is limited
};
constexpr std::array<StateText, state_checks> state_texts{
    {{"density", "had a density that its equation of state does not describe", "kg/m3", 1, &L::density},
     {"tension", "were under more tension than the material bears", "GPa", 1e-9, &L::tension},
     {"melting", "were hotter by their energy than the melting temperature, which the strength does not feel",
      "K", 1, &L::melting},
     {"negative-plastic-strain", "had a plastic strain below zero", "", 1, &L::negative_plastic_strain},
     {"negative-heating", "colder than at the start", "K", 1, &L::negative_heating, PartOf::energy},
     {"overfilled-cells", "had no room in its cells", "cells", 1, &L::overfilled_cells, PartOf::matter},
     {"molten", "were molten, and without strength", "K", 1, nullptr}}};

/// What helps against a reason, where that is known.
struct Cure {
  const char *what, *text;
};
constexpr const char* unstable_cure =
    "a shorter time.fixed-dt; without it the step follows the state (time.cfl)";
constexpr std::array cures{
    Cure{"tension",
         "matter breaks if its material has damage (`recoil explain "
         "'material.*.damage'`; `recoil new spall` writes an "
         "example); without it the states after the tension are those of no material"},
    Cure{"melting",
         "a material of the case that shocks heat, so that it melts: e.g. [material.al] with base = "
         "\"aluminium/6061-t6\" and thermal = { temperature = \"energy\" }, and material = \"al\" in the "
         "body"},
    Cure{"thickness", "a finer mesh.finest"}, Cure{"unstable-steps", unstable_cure},
    Cure{"unstable-steps-stop", unstable_cure}};

constexpr double small_part_of_way = 0.01;  // by which a centre of mass may be off on a long way
constexpr double told_part = 1e-5;          // of matter or energy: less is not told

std::string percent(double part) { return fmt::format("{:.{}g} %", 100 * part, part >= 0.995 ? 3 : 2); }

std::string place_text(const std::array<double, 3>& at, int dimensions) {
  std::string text;
  for (int d = 0; d < dimensions; ++d) text += fmt::format("{}{:.4g}", d > 0 ? ", " : "", at[d] * 1e3);
  return "(" + text + ") mm";
}

std::string span_text(double first, double last) {
  if (first == last) return fmt::format("at {:.4g} us", first * 1e6);
  return fmt::format("from {:.4g} to {:.4g} us", first * 1e6, last * 1e6);
}

std::vector<double> coordinates(const std::array<double, 3>& at, int dimensions) {
  return {at.begin(), at.begin() + dimensions};
}

double part_of(double count, double all) { return all > 0 ? count / all : count > 0 ? 1 : 0; }

void judge_averages(const Evidence& e, const config::Limits& limits, Verdict& v) {
  std::int64_t all = 0;
  for (const BodyEvidence& b : e.bodies) all += b.averaged;
  for (const BodyEvidence& b : e.bodies) {
    const double part = part_of(static_cast<double>(b.averaged), b.cell_steps);
    if (!(part > limits.averaged_states)) continue;
    v.reasons.push_back(
        {"averaged-states", b.name,
         fmt::format(
             "{} of the cell states of {} replaced (averaged-states {}, {}), {}, last at {}", percent(part),
             b.name, b.averaged, b.averaged == all ? "all of them" : "of " + std::to_string(all),
             span_text(b.averaged_first, b.averaged_last), place_text(b.averaged_place, e.dimensions)),
         part, limits.averaged_states, b.averaged_first, b.averaged_last,
         coordinates(b.averaged_place, e.dimensions)});
  }
  const double recent = part_of(static_cast<double>(e.recent_averaged), e.recent_cell_steps);
  if (recent > limits.averaged_states_stop)
    v.reasons.push_back({"averaged-states-stop",
                         "",
                         fmt::format("{} of the cell states of the last 100 steps replaced, the limit is {}",
                                     percent(recent), percent(limits.averaged_states_stop)),
                         recent,
                         limits.averaged_states_stop,
                         nothing,
                         nothing,
                         {},
                         true});
}

/// Noise grows from step to step, so a small part of the steps is enough to spoil a run.
void judge_steps(const Evidence& e, const config::Limits& limits, Verdict& v) {
  const double part =
      part_of(static_cast<double>(e.unstable_steps), static_cast<double>(std::max<std::int64_t>(e.steps, 1)));
  if (!(part > limits.unstable_steps)) return;
  const bool stops = part > limits.unstable_steps_stop;
  const double limit = stops ? limits.unstable_steps_stop : limits.unstable_steps;
  v.reasons.push_back(
      {stops ? "unstable-steps-stop" : "unstable-steps",
       "",
       fmt::format("{} of {} steps were longer than a stable one (unstable-steps, {}; the limit is "
                   "{}): noise grows in each of them",
                   e.unstable_steps, e.steps, percent(part), percent(limit)),
       part,
       limit,
       nothing,
       nothing,
       {},
       stops});
}

void judge_counters(const Evidence& e, const config::Limits& limits, Verdict& v) {
  double cell_steps = 0;
  for (const BodyEvidence& b : e.bodies) cell_steps += b.cell_steps;
  for (const CounterLimit& c : counter_limits) {
    const auto found = std::find_if(e.counters.begin(), e.counters.end(),
                                    [&](const auto& counter) { return counter.first == c.name; });
    if (found == e.counters.end()) continue;
    const double part = part_of(static_cast<double>(found->second), cell_steps);
    if (!(part > limits.*c.limit)) continue;
    v.reasons.push_back({c.name,
                         "",
                         fmt::format("{} ({} {}, {} of the cell states; the limit is {})", c.text, c.name,
                                     found->second, percent(part), percent(limits.*c.limit)),
                         part,
                         limits.*c.limit,
                         nothing,
                         nothing,
                         {}});
  }
}

void judge_budgets(const Evidence& e, const config::Limits& limits, Verdict& v) {
  if (!e.conservative) {
    v.notes.emplace_back(
        "budgets are not judged: this scheme does not keep mass, momentum and energy at surfaces");
    return;
  }
  for (const Drift& d : e.budgets)
    for (const auto& [name, error] :
         {std::pair{"mass", d.mass}, {"momentum", d.momentum}, {"energy", d.energy}}) {
      const bool stops = !(error <= limits.budget_stop);  // NaN is no closed budget
      if (error <= limits.budget && !stops) continue;
      v.reasons.push_back({stops ? "budget-stop" : "budget",
                           d.name == "total" ? "" : d.name,
                           fmt::format("the {} of {} is off by {:.1e}, the limit is {:.1e}", name,
                                       d.name == "total" ? "all bodies together" : d.name, error,
                                       stops ? limits.budget_stop : limits.budget),
                           error,
                           stops ? limits.budget_stop : limits.budget,
                           nothing,
                           nothing,
                           {},
                           stops});
    }
}

void judge_centres(const Evidence& e, const config::Limits& limits, Verdict& v) {
  if (!e.conservative) return;  // as the budgets
  for (const CentreOff& c : e.centres) {
    const double cells = e.cell > 0 ? c.off / e.cell : 0;
    if (!(cells > limits.centre_of_mass && c.off > small_part_of_way * c.way)) continue;
    v.reasons.push_back(
        {"centre-of-mass",
         c.name,
         fmt::format(
             "the centre of mass of {} is {:.3g} mm ({:.3g} cells, the limit is {:.3g}) away from where its "
             "momentum has carried it on a way of {:.4g} mm, at {:.4g} us",
             c.name, c.off * 1e3, cells, limits.centre_of_mass, c.way * 1e3, c.time * 1e6),
         cells,
         limits.centre_of_mass,
         c.time,
         c.time,
         {}});
  }
}

const char* text_of(StateCheck check, const BodyEvidence& b) {
  if (check == StateCheck::negative_heat && b.by_energy) return "colder than the isentrope through the start";
  return state_texts[static_cast<std::size_t>(check)].text;
}

double part_of(const Evidence& e, const BodyEvidence& b, const StateFinding& f, PartOf of) {
  switch (of) {
    case PartOf::states:
      return part_of(static_cast<double>(f.count), b.looked_at);
    case PartOf::matter:
      return part_of(f.amount, b.looked_at);
    case PartOf::energy:  // on average over the steps
      return part_of(f.amount, e.converted * static_cast<double>(e.steps));
  }
  return 0;
}

/// What a finding says. @param part that is beyond the bound.
std::string text_of(const Evidence& e, const BodyEvidence& b, StateCheck check, double part) {
  const auto k = static_cast<std::size_t>(check);
  const StateFinding& f = b.states[k];
  const StateText& t = state_texts[k];
  const std::string where = fmt::format(
      "({}, {}; worst {:.4g}{}{} at {}, {:.4g} us)", t.name, span_text(f.first, f.last), f.worst * t.factor,
      *t.unit != 0 ? " " : "", t.unit, place_text(f.place, e.dimensions), f.worst_time * 1e6);
  if (t.of == PartOf::energy)
    return fmt::format(
        "{} had states {}: the heat that they lack is {} of the internal energy that all bodies "
        "took up {}",
        b.name, text_of(check, b), percent(part), where);
  return fmt::format("{} of the {} of {} {} {}", percent(part),
                     t.of == PartOf::matter ? "matter" : "cell states", b.name, text_of(check, b), where);
}

void judge_states(const Evidence& e, const config::Limits& limits, Verdict& v) {
  for (const BodyEvidence& b : e.bodies)
    for (std::size_t k = 0; k < state_checks; ++k) {
      const StateFinding& f = b.states[k];
      const StateText& t = state_texts[k];
      const double part = part_of(e, b, f, t.of), limit = t.limit != nullptr ? limits.*t.limit : 0;
      // Single states that weigh little are told where they are.
      const bool told = t.of != PartOf::states && part > told_part;
      if (!(part > limit) && !told) continue;
      const std::string text = text_of(e, b, static_cast<StateCheck>(k), part);
      if (t.limit == nullptr)
        v.remarks.push_back(text);
      else if (!(part > limit))
        v.remarks.push_back(text + "; the limit is " + percent(limit));
      else
        v.reasons.push_back(
            {t.name, b.name, text, part, limit, f.first, f.last, coordinates(f.place, e.dimensions)});
    }
}

void judge_thickness(const Evidence& e, const config::Limits& limits, Verdict& v) {
  for (const BodyEvidence& b : e.bodies) {
    if (!(b.thickness > 0 && b.thickness < limits.thickness * (1 - 1e-9))) continue;
    v.reasons.push_back({"thickness",
                         b.name,
                         fmt::format("{} is {:.3g} cells thick at the start, at least {:.3g} are needed",
                                     b.name, b.thickness, limits.thickness),
                         b.thickness,
                         limits.thickness,
                         0,
                         0,
                         {}});
  }
}

}  // namespace

const char* name_of(StateCheck check) { return state_texts[static_cast<std::size_t>(check)].name; }

const char* name_of(Verdict::Kind kind) {
  constexpr std::array names{"valid", "doubtful", "stopped"};
  return names[static_cast<std::size_t>(kind)];
}

Verdict judge(const Evidence& e, const config::Limits& limits) {
  Verdict v;
  if (!e.failure.empty())
    v.reasons.push_back({"error",
                         "",
                         e.failure.substr(0, e.failure.find('\n')),
                         nothing,
                         nothing,
                         nothing,
                         nothing,
                         {},
                         true});
  judge_steps(e, limits, v);
  judge_averages(e, limits, v);
  judge_budgets(e, limits, v);
  judge_centres(e, limits, v);
  judge_states(e, limits, v);
  judge_counters(e, limits, v);
  judge_thickness(e, limits, v);
  std::stable_sort(v.reasons.begin(), v.reasons.end(),
                   [](const Reason& a, const Reason& b) { return a.stops && !b.stops; });
  for (const Cure& cure : cures)
    if (std::ranges::any_of(v.reasons, [&](const Reason& r) { return r.what == cure.what; }))
      v.cures.emplace_back(cure.text);
  if (!v.reasons.empty()) v.kind = v.reasons[0].stops ? Verdict::Kind::stopped : Verdict::Kind::doubtful;
  return v;
}

}  // namespace recoil
