#pragma once

#include <vector>

#include "config/declare/entry.hpp"

namespace recoil::config {

struct Body;

/// The velocity of a rigid body at one time.
struct TimedVelocity {
  double time = 0;    // s
  Vector velocity{};  // m/s
};

/// The declaration of Body::velocity_history: [["0 us", { x = "0 m/s" }], ...].
Custom<Body> custom_velocity_history();

}  // namespace recoil::config
