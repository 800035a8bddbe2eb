#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "config/section/limits.hpp"
#include "core/exact_sum.hpp"
#include "parallel/team.hpp"
#include "parallel/world.hpp"
#include "record/validity.hpp"
#include "state/averaged_states.hpp"
#include "state/body.hpp"

namespace recoil {

/// The tension [Pa] beyond which a material counts as torn: its spall strength times what [limits] allows, or
/// a part of its bulk modulus where that is not known. Infinite where it has damage, or no tension.
double borne_tension(const Material& material, const config::Limits& limits);

/// Looks for states that no material has, in all cells of every survey_steps-th step: so it costs nothing
/// that one could measure. What it finds does not depend on the number of ranks or threads.
template <int Dim>
class StateSurvey {
 public:
  /// @param closing_speed of the bodies at the start [m/s]: what noise of the temperature is allowed goes
  /// with it.
  /// @param over_isentrope of each body's state at the start (over_isentrope()); empty: all start at rest.
  StateSurvey(const State<Dim>& state, const config::Limits& limits, double closing_speed = 0,
              const std::vector<double>& over_isentrope = {});

  /// Looks at the state of now, which stands for the steps since the last look. Not collective.
  void look(const State<Dim>& state, parallel::Team* team);
  /// Step of the last look.
  long last() const { return last_; }
  /// Cells with matter, summed over the steps until the last look, of this process; after unpack() those of
  /// all processes are on rank 0.
  double cell_steps() const;
  struct Recent {
    std::int64_t averaged = 0;
    double cell_steps = 0;
  };
  /// Of the last 100 steps, as far as look() has seen them; the steps that are missing count as good.
  /// Collective.
  Recent recent(const State<Dim>& state, const parallel::World& world);
  /// All bodies that are not rigid; complete on rank 0. Collective.
  std::vector<BodyEvidence> evidence(const State<Dim>& state, const AveragedStates* averaged,
                                     const parallel::World& world) const;
  /// The same of this process alone.
  std::vector<BodyEvidence> own_evidence(const State<Dim>& state, const AveragedStates* averaged) const;

  /// For checkpoints: all that has been found, on rank 0; and the same back, on all ranks. Collective.
  void pack(const parallel::World& world, parallel::Bytes& bytes) const;
  void unpack(const parallel::World& world, parallel::Unpacker& from);

 private:
  /// The finding of one body in one block or more.
  struct Finding {
    std::int64_t count = 0;
    ExactSum amount;  // StateFinding::amount
    double first = std::numeric_limits<double>::infinity(), last = -1;
    double excess = -1, worst = 0, bound = 0, time = 0;
    Index<Dim> cell{};
  };
  struct Line {
    std::int64_t cells = 0;  // of the last look
    double cell_steps = 0;
    std::array<Finding, state_checks> found;
    std::int64_t averaged = 0;
    double averaged_first = std::numeric_limits<double>::infinity(), averaged_last = -1;
    std::array<double, 3> averaged_place{};
    std::int64_t averaged_most = 0;  // of one block
    long averaged_order = 0;
  };
  static void merge(Finding& into, const Finding& more);
  static void merge(Line& into, const Line& more);
  /// Those of all ranks together, on rank 0.
  static std::vector<Line> gathered(std::vector<Line> lines, const parallel::World& world);
  std::vector<Line> own_lines(const State<Dim>& state, const AveragedStates* averaged) const;
  std::vector<BodyEvidence> told(const State<Dim>& state, const std::vector<Line>& lines) const;
  /// A look at one block. @param steps that it stands for.
  struct Look {
    const State<Dim>& state;
    int slot;
    double steps;
    std::vector<Line>& lines;
  };
  void look_at_block(const Look& look) const;
  void look_at_cell(const Look& look, int m, const Index<Dim>& cell, std::size_t k) const;
  /// A state of which something is beyond a bound; none where `excess` is not above 0. @param amount that
  /// it adds to StateFinding::amount.
  struct Excess {
    double excess, value, bound, amount = 0;
  };
  static void note(const Look& look, Line& line, StateCheck check, const Index<Dim>& cell, const Excess& e);

  /// What a body's states are held against.
  struct Bounds {
    double tension = 0;        // Pa
    double noise = 0;          // K, that a temperature by energy may be below the isentrope
    double start = 1;          // temperature on the isentrope through the start over that through rest
    bool softens = false;      // the strength model knows the melting temperature
    bool no_strength = false;  // it is a fluid: nothing to lose by melting
  };
  std::vector<Bounds> bounds_;  // of each body
  double most_fill_;
  std::vector<Line> lines_;  // of each body, so far
  long last_ = 0;            // step of the last look
  struct Mark {
    long step = 0;
    std::int64_t averaged = 0;
  };
  std::vector<Mark> marks_;  // of the last 100 steps
};

/// Steps between two looks.
inline constexpr int survey_steps = 20;

}  // namespace recoil
