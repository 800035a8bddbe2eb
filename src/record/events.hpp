#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "config/case.hpp"
#include "gauge/pair_sample.hpp"
#include "parallel/world.hpp"

namespace recoil {

/// One thing that happened: a line of events.csv and of the live display.
struct Event {
  double time = 0;            ///< s
  std::string kind;           ///< contact, opening, reclosure, ricochet or lift-off
  std::string bodies;         ///< "flyer-target"
  std::vector<double> place;  ///< m, mean place of the contact; one component per axis, empty: none
  std::string detail;

  template <class Archive>
  void transfer(Archive& a) {
    a(time, kind, bodies, place, detail);
  }
};

/// What became of the contact of one pair of bodies. Times are NaN where it did not come to that.
struct PairStory {
  std::string first, second;
  double made = 0;                       ///< s, start of the first step in which they touched
  double opens = 0;                      ///< s, end of the last step before the first opening
  bool recloses = false;                 ///< touched again after an opening
  bool open = true;                      ///< apart now
  double lift_first = 0, lift_last = 0;  ///< s, first and last local opening while they touched elsewhere
  double closes_again = 0;               ///< s, start of the first step of the first touch after an opening
  double opens_again = 0;                ///< s, as `opens`, of the second opening
  double restitution = 0;  ///< relative velocity of the mean motions along the impulse: after the last
                           ///< opening over before the first touch, turned around

  template <class Archive>
  void transfer(Archive& a) {
    a(first, second, made, opens, recloses, open, lift_first, lift_last, closes_again, opens_again,
      restitution);
  }
};

/// A change of contact is believed when it has lasted this many steps, or to the end of the run.
inline constexpr int opening_steps = 20;

/// Watches the contact of all pairs. A pair touches where its contact area is above zero (1d), or at least
/// half of the largest so far. A touch counts at once; an opening counts when the pair has stayed apart for
/// `opening_steps` steps or until the end of the run, and then has the time at which it began, so that
/// contact that flickers from step to step is one contact. On rank 0 only.
class EventWatch {
 public:
  /// @param names of all bodies in their order; @param geometry decides between the two rules of touching.
  /// @param sided axes with a closed end (a plane of symmetry or slip wall): the velocities found from
  /// impulses of contact do not hold along them and are left out.
  EventWatch(std::vector<std::string> names, config::Geometry geometry, std::array<bool, 3> sided = {});
  ~EventWatch();
  EventWatch(EventWatch&&) noexcept;

  /// Motion of the bodies at the start, from which their later velocities follow by the impulses they
  /// received: mass and momentum [3 components] per body, in any common unit; mass 0 for rigid ones.
  void begin(const std::vector<BodyMotion>& start);
  /// @param time at the end of the step of length dt [s]; @param pairs all pairs, by pair_number().
  void step(double time, double dt, const std::vector<PairSample>& pairs);
  /// A place where the pair's surfaces parted at `time` while the pair touched elsewhere.
  void lift_off(std::size_t pair, double time, const std::vector<double>& place);
  /// Believes the openings that are still on trial; adds lift-offs and ricochets.
  void finish();

  /// In order of time.
  const std::vector<Event>& events() const;
  /// Those since the last call, in the order in which they became known.
  std::vector<Event> take_news();
  std::vector<PairStory> stories() const;

  /// For checkpoints: all that it knows, and the same back in a watch of the same bodies.
  void pack(parallel::Bytes& bytes) const;
  void unpack(parallel::Unpacker& from);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace recoil
