#pragma once

#include <map>
#include <utility>
#include <vector>

#include "parallel/world.hpp"
#include "state/body.hpp"

namespace recoil {

/// Looks for places where two surfaces have parted although both are still there: cells in which a body
/// touched a partner, where for `opening_steps` steps neither the cell nor one around it has touched, and
/// where both surfaces are still near. A contact that has only moved on leaves no such place. Cells around
/// are looked for in the same block only.
template <int Dim>
class LiftOffWatch {
 public:
  struct Place {
    int pair = 0;     // pair_number()
    double time = 0;  // s, end of the last step in which they touched there
    Vec<Dim> at;      // m, middle of the cell
  };

  /// Remembers which cells touch; after every step. Not collective.
  void note(const State<Dim>& state);
  /// What has parted since the last call; to be called every `opening_steps` steps. Collective; on rank 0, in
  /// the order of the blocks.
  std::vector<Place> collect(const State<Dim>& state, const parallel::World& world);

  /// For checkpoints: what is known of one block, and the same back.
  void pack(int slot, parallel::Bytes& bytes) const;
  void unpack(int slot, parallel::Unpacker& from);

 private:
  struct Touched {
    int lower = 0, higher = 0;  // bodies
    std::vector<long> step;     // of the last touch, by cell; -1: never
    std::vector<double> time;   // s

    template <class Archive>
    void transfer(Archive& a) {
      a(lower, higher, step, time);
    }
  };
  void scan(const State<Dim>& state, int slot, int pair, Touched& touched, parallel::Bytes& out) const;

  std::map<std::pair<int, int>, Touched> touched_;  // by slot and pair
};

}  // namespace recoil
