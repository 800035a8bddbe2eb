#pragma once

#include <cstdint>

namespace recoil::parallel {

/// What this process has sent to others since it began. Collective operations count once each, whatever the
/// library makes of them.
struct Traffic {
  std::int64_t exchanges = 0;   // World::exchange with at least one other process
  std::int64_t messages = 0;    // sent in them
  std::int64_t bytes = 0;       // in these messages
  std::int64_t reductions = 0;  // sums, largest and smallest values over all processes

  friend Traffic operator-(const Traffic& a, const Traffic& b) {
    return {a.exchanges - b.exchanges, a.messages - b.messages, a.bytes - b.bytes,
            a.reductions - b.reductions};
  }
};
Traffic traffic();
/// Where the wrapper of MPI counts.
Traffic& counted_traffic();

}  // namespace recoil::parallel
