#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/timers.hpp"
#include "parallel/team.hpp"
#include "state/averaged_states.hpp"
#include "state/body.hpp"

namespace recoil {

/// Parts of a step, as `make bench` and the run log show them; times of threads in their mean.
enum class StepPhase {
  averages,
  geometry,
  fits,
  walls,
  values,
  flux,
  redistribution,
  plasticity,
  level_set,
  moves,
  exchange,
  band,
  waiting,  // of threads for each other, in their mean; in phases that are put off (StepRun) only
  count
};
const char* name_of(StepPhase part);

/// Stages of a step of the conservative scheme.
enum class StepStages { one, three };

/// How often the speed of sound counts in the length of a step, beside sum_d |u_d|. A wave has one direction:
/// sqrt(dim) with three stages. With one stage linear waves are stable while c_L dt is below 1, 0.89 and 0.72
/// of dx in 1-D, 2-D and 3-D (tools/stable_cfl), and surfaces at 45 degrees up to about 0.7 of it. Matter
/// at the centre of a sphere needs 0.70 (decision 0081).
/// @param radial_power as Grid has it.
inline double sound_in_step(int dim, StepStages stages, int radial_power = 0) {
  constexpr std::array one_stage{1.0, 1.4, 1.4};
  if (stages == StepStages::one && radial_power == 2) return 1.4;
  return stages == StepStages::one ? one_stage[static_cast<std::size_t>(dim) - 1]
                                   : std::sqrt(static_cast<double>(dim));
}

/// The CFL number from which on noise grows: 1.435 for linear sound in three stages, 1 in one
/// (docs/decisions/0036, tools/stable_cfl).
inline double largest_stable_cfl(StepStages stages) { return stages == StepStages::one ? 1.0 : 1.4; }

/// What drives the steps of a run.
struct Stepping {
  double cfl = 0.9;                // of min dx/(sum_d |u_d| + sound_in_step c_L)
  std::optional<double> fixed_dt;  // s, instead of the stable step
  double kappa = 0.5;              // [dx] distance at which bodies meet; seed scheme only
  StepStages stages = StepStages::three;
};

/// The processes, threads and clocks that a step works with.
struct Engine {
  const parallel::World& world;
  parallel::Team& team;
  Timers<StepPhase> timers;
  AveragedStates averaged{};  // so far, by body
  bool unstable = false;      // noise has grown in the last step: it was longer than a stable one
  // Whether copies of other processes' blocks hold contents between steps: gauges may read them.
  bool contents_between_steps = true;
  // A step is shared by threads if each gets as much work, in cells without a surface. With less, two take as
  // long as one (340 to 1700 cells in 1-D), and several times as long where other programs run.
  std::size_t least_work = 1000;
};

/// Advances all bodies by one step of the conservative moving-boundary method (docs/theory.md), at most to
/// `until` [s].
/// @returns the step's length [s]. @throws PhysicsError where a state is beyond the equations. Collective.
template <int Dim>
double advance(State<Dim>& state, const Stepping& stepping, double until, Engine& engine);

/// Puts the bands of all bodies in place before the first step: what advance() leaves behind. Collective.
template <int Dim>
void prepare_start(State<Dim>& state, Engine& engine);

}  // namespace recoil
