#pragma once

#include <map>
#include <utility>
#include <vector>

#include "parallel/world.hpp"
#include "state/body.hpp"

namespace recoil {

/// Lift-off is looked for in every so many steps.
inline constexpr int lift_off_steps = 20;

/// Looks for places where two surfaces have parted although both are still there: cells in which a body
/// touched a partner, where for the pair's hold time neither the cell nor one around it has touched, and
/// where both surfaces are still near. A contact that has only moved on leaves no such place.
template <int Dim>
class LiftOffWatch {
 public:
  struct Place {
    int pair = 0;     // pair_number()
    double time = 0;  // s, end of the last step in which they touched there
    Vec<Dim> at;      // m, middle of the cell
  };

  /// @param hold [s] by pair_number(), as in ContactRule.
  explicit LiftOffWatch(std::vector<double> hold) : hold_(std::move(hold)) {}

  /// Remembers which cells touch; after every step. Not collective.
  void note(const State<Dim>& state);
  /// What has parted since the last call; to be called every `lift_off_steps` steps. Collective; on rank 0,
  /// in the order of time, then of place along the last axis.
  std::vector<Place> collect(const State<Dim>& state, const parallel::World& world);

  /// After the blocks have changed: what is known of each goes where it is now. Where there are coarser cells
  /// now, no surface is near. Collective.
  void follow_blocks(const State<Dim>& state, const parallel::World& world);
  /// For checkpoints: what is known of one block, and the same back.
  void pack(int slot, parallel::Bytes& bytes) const;
  void unpack(int slot, parallel::Unpacker& from);

 private:
  struct Touched {
    int lower = 0, higher = 0;  // bodies
    Index<Dim> at;              // place of the block, of the finest level
    std::vector<double> time;   // s, of the last touch, by cell; -1: never

    template <class Archive>
    void transfer(Archive& a) {
      a(lower, higher, at.c, time);
    }
  };
  /// The cells of copies of other processes' blocks that have touched lately, by slot and pair.
  using Copies = std::map<std::pair<int, int>, std::vector<int>>;

  bool lately(double now, int pair, double touch) const { return touch >= 0 && now - touch < hold_[pair]; }
  Copies look_at_copies(const State<Dim>& state, const parallel::World& world) const;
  void scan(const State<Dim>& state, int slot, int pair, Touched& touched, const Copies& copies,
            std::vector<Place>& out) const;

  std::vector<double> hold_;
  std::map<std::pair<int, int>, Touched> touched_;  // by slot and pair
};

}  // namespace recoil
