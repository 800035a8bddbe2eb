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
  double time = 0;     ///< s
  std::string kind;    ///< contact, opening, separation, reclosure, ricochet, lift-off, failure, fragment
  std::string bodies;  ///< "flyer-target"; of a failure or a fragment "target"
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
  double made = 0;                       ///< s, when they first touched
  double opens = 0;                      ///< s, end of the last step with force before the first opening
  double separates = 0;                  ///< s, when their gap was first open everywhere after a touch
  bool recloses = false;                 ///< pressed again after an opening
  bool open = true;                      ///< apart now
  double lift_first = 0, lift_last = 0;  ///< s, first and last local opening while they touched elsewhere
  double closes_again = 0;               ///< s, when they first touched after an opening
  double opens_again = 0;                ///< s, as `opens`, of the second opening
  double restitution = 0;                ///< relative velocity of the mean motions along the impulse: at the
                                         ///< last opening over before the first touch, turned around

  template <class Archive>
  void transfer(Archive& a) {
    a(first, second, made, opens, separates, recloses, open, lift_first, lift_last, closes_again, opens_again,
      restitution);
  }
};

/// From when on a change of contact is believed.
struct ContactRule {
  std::vector<double> hold;   ///< s, by pair_number(): so long it must last, or to the end of the run
  double gap = 0;             ///< m: surfaces farther apart than this everywhere are separate
  double stand_off = 0;       ///< m: surfaces as near as this touch (scheme of the paper)
  double gap_at = 0;          ///< part of a step after which the gaps of its contacts are taken
  std::vector<bool> glued{};  ///< by pair_number(), empty: none; such a pair is in contact while it has area
};

/// A force below this part of the largest so far is none.
inline constexpr double least_force = 1e-3;

/// Watches the contact of all pairs. A pair presses in a step that has contact area and at least
/// `least_force` of the largest force so far.
///   contact     the first such step; the time within it follows from the gap where the surfaces touch and
///   its rate opening     the end of the last such step, once the pair has not pressed for the hold time
///   separation  the gap is wider than ContactRule::gap everywhere, and stays so for the hold time
///   reclosure   after an opening the pair presses again: at once where it had separated, else once it has
///               pressed for the hold time
///   ricochet    at the last opening a body's velocity towards its partner is reversed
/// All have the time at which they began, and the velocities of that time. So contact that flickers from step
/// to step is one contact, and so are bodies that fly on in touch. On rank 0 only.
class EventWatch {
 public:
  /// @param names of all bodies in their order.
  /// @param sided axes with a closed end (a plane of symmetry or slip wall), along which a body is but half
  /// of one: its velocity along them is left out.
  EventWatch(std::vector<std::string> names, config::Geometry geometry, ContactRule rule,
             std::array<bool, 3> sided = {});
  ~EventWatch();
  EventWatch(EventWatch&&) noexcept;

  /// @param samples of all pairs at the start: their gaps.
  void begin(const std::vector<PairSample>& samples);
  /// Whether the next step() takes the motion of the bodies: a contact or an opening has begun.
  bool needs_motion(const std::vector<PairSample>& samples) const;
  /// @param time at the end of the step of length dt [s]; @param samples of all pairs, by pair_number();
  /// @param motion of all bodies at that time where needs_motion(), else anything.
  void step(double time, double dt, const std::vector<PairSample>& samples,
            const std::vector<BodyMotion>& motion);
  /// A place where the pair's surfaces parted at `time` while the pair touched elsewhere.
  void lift_off(std::size_t pair, double time, const std::vector<double>& place);
  /// The first failure of a body's matter; later calls for the same body do nothing.
  void failure(const std::string& body, double time, std::vector<double> place);
  /// A fragment of `body`, with its centre of mass at `place`, goes on as a part of the body `by`.
  void fragment(const std::string& body, const std::string& by, double time, std::vector<double> place);
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
