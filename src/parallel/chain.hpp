#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "parallel/team.hpp"

namespace recoil::parallel {

/// Phases of work on the same items, one after the other, by all threads of a team. An item goes on to its
/// next phase as soon as the items beside it have come as far as it has: nobody waits for all. So while an
/// item is in phase k, none beside it is before or behind phase k.
///
/// Each thread has items that lie one after the other, so that most of what lies beside an item is its own,
/// and takes items of others where it finds nothing to do among those.
class Chain {
 public:
  /// @param beside by item: the items that it reads from or that read from it; both name each other.
  /// @param cost by item, in any unit: each thread gets as much of it.
  /// @param urgent by item: others wait for it, so a thread does it first among its own. Empty: none is.
  /// @param shared whether all threads of the team work, not the first alone.
  Chain(Team& team, const std::vector<std::vector<int>>& beside, const std::vector<std::size_t>& cost,
        std::vector<std::uint8_t> urgent = {}, bool shared = true);

  int items() const { return static_cast<int>(first_beside_.size()) - 1; }
  int threads() const { return static_cast<int>(first_of_.size()) - 1; }
  /// The first item of a thread; of thread threads(): the end.
  int first_of(int thread) const { return first_of_[static_cast<std::size_t>(thread)]; }

  using Work = std::function<void(int item, int phase, int worker)>;
  /// Whether what comes from elsewhere is there that an item needs in a phase; asked until it is. The first
  /// thread asks again and again, so that what it waits for may depend on the asking.
  using Ready = std::function<bool(int item, int phase, int worker)>;
  /// Calls work(item, phase, worker) once for each item in each of the phases. Where something is thrown, the
  /// phases up to it are done for all items, later ones perhaps for some; the exception of the earliest
  /// phase, and there of the lowest item, is thrown again here.
  void run(int phases, const Work& work, const Ready& ready = {});

 private:
  struct Failures;
  struct Choice {
    int item, phase;
  };
  void take_part(int worker, const Work& work, Failures& failures);
  bool find(int worker, Choice& found);
  bool claim(int item, int worker, Choice& found);
  bool is_done() const;

  Team& team_;
  std::vector<int> first_beside_, beside_;          // by item, and the end
  std::vector<int> first_of_;                       // by thread, and the end
  std::vector<std::uint8_t> urgent_;                // by item
  const Ready* ready_ = nullptr;                    // of this run, if any
  static constexpr std::size_t cursor_stride = 16;  // each in a cache line of its own
  std::vector<int> cursor_;                         // by thread: where it looks first
  std::unique_ptr<std::atomic<int>[]> progress_;    // by item: twice the phases done, and 1 in one
  std::atomic<int> end_{0};                         // phases to be done
  std::atomic<unsigned> done_{0};                   // items that have left a phase
  std::atomic<int> asleep_{0};
};

}  // namespace recoil::parallel
