#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "config/section/limits.hpp"
#include "record/balance/budget.hpp"
#include "record/balance/centre_watch.hpp"

namespace recoil {

/// What is looked for in the states of cells. In the order of StateFinding::kind. `molten` is told only.
enum class StateCheck {
  density,
  tension,
  melting,
  negative_strain,
  negative_heat,
  overfilled,
  molten,
  count
};
inline constexpr auto state_checks = static_cast<std::size_t>(StateCheck::count);
/// Its name in [limits] and in summary.json.
const char* name_of(StateCheck check);

/// States of one body beyond one bound.
struct StateFinding {
  std::int64_t count = 0;  ///< cell states, of those looked at
  double amount = 0;       ///< over the steps: cells of matter without room, or J of heat that are missing
  double first = 0, last = 0;     ///< s
  double worst = 0;               ///< the state farthest beyond, SI
  double bound = 0;               ///< what it is beyond, SI
  double worst_time = 0;          ///< s
  std::array<double, 3> place{};  ///< of the worst, m
};

/// What is known of one deformable body.
struct BodyEvidence {
  std::string name;
  double cell_steps = 0;  ///< cells with matter, summed over the steps
  double looked_at = 0;   ///< those whose states were looked at
  std::int64_t averaged = 0;
  double averaged_first = 0, averaged_last = 0;  ///< s
  std::array<double, 3> averaged_place{};        ///< of the last one, m
  std::array<StateFinding, state_checks> states;
  bool by_energy = false;  ///< its temperature follows from the internal energy
  double thickness = 0;    ///< cells across the thinnest part at the start; 0: not known
};

/// All that a verdict rests on.
struct Evidence {
  int dimensions = 3;
  bool conservative = true;  ///< the scheme keeps mass, momentum and energy
  std::vector<BodyEvidence> bodies;
  std::vector<std::pair<std::string, std::int64_t>> counters;
  std::vector<Drift> budgets;
  std::vector<CentreOff> centres;
  double cell = 0;                             ///< width of the finest [m]
  double converted = 0;                        ///< J, BudgetWatch::converted()
  std::int64_t recent_averaged = 0;            ///< in the last 100 steps
  double recent_cell_steps = 0;                ///< of 100 steps with the present cells
  std::int64_t steps = 0, unstable_steps = 0;  ///< the latter longer than a stable one
  std::string failure;                         ///< the error that ended the run; empty: none
};

struct Reason {
  std::string what;  ///< name in [limits], or `error`
  std::string body;  ///< empty: all
  std::string text;  ///< for people
  double value = 0, limit = 0;
  double first = 0, last = 0;  ///< s; NaN: not known
  std::vector<double> place;   ///< m; empty: not known
  bool stops = false;
};

struct Verdict {
  enum class Kind { valid, doubtful, stopped };
  Kind kind = Kind::valid;
  std::vector<Reason> reasons;
  std::vector<std::string> notes;    ///< what was not judged, and why
  std::vector<std::string> remarks;  ///< what is told without being judged
  std::vector<std::string> cures{};  ///< what helps against some of the reasons
};
const char* name_of(Verdict::Kind kind);

/// Judges a run by its evidence alone.
Verdict judge(const Evidence& evidence, const config::Limits& limits);

}  // namespace recoil
